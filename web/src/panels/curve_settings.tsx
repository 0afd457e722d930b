import type { Curve } from "../api";
import { NumberField, VectorField } from "../controls/number_field";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { changeCurve, CURVE_DEFAULTS, curvesOf } from "../store/scene";

export function CurveSettings({ index }: { index: number }) {
  const studio = useStudio();
  const curve = curvesOf(studio.scene.value)[index]!;
  const name = `curve ${index + 1}`;
  const set = <K extends keyof Curve>(key: K, value: Curve[K] | undefined, gesture?: string) =>
    studio.setScene(`Set ${key} of ${name}`, changeCurve(studio.scene.value, index, { [key]: value }), gesture && `${gesture} ${index}`);
  const of = <K extends Exclude<keyof Curve, "points">>(key: K) => ({
    value: (curve[key] ?? CURVE_DEFAULTS[key]) as NonNullable<Curve[K]>,
    standard: curve[key] === undefined,
    onReset: () => set(key, undefined),
  });
  const paste = () => {
    // The same settings for all curves: as the pictures of docs/guiding.md have them.
    let scene = studio.scene.value;
    curvesOf(scene).forEach((other, i) => {
      const { points: _, ...settings } = curve;
      scene = { ...scene, curves: { ...scene.curves!, curve: curvesOf(scene).map((old, k) => (k === i ? { points: other.points, ...settings } : old)) } };
    });
    studio.setScene("Settings for all curves", scene);
  };
  return (
    <div role="group" aria-label={`Settings of ${name}`} class="settings">
      <h3>Curve {index + 1}</h3>
      <Slider
        label="Offset" min={-1} max={1} step={0.01} {...of("offset")}
        title="How well a bone must point along the curve to be worth anything: -1 lenient, 1 strict. Lower is bushier."
        onChange={(value, gesture) => set("offset", value, gesture)}
      />
      <NumberField
        label="Alignment" min={0} max={1e6} {...of("alignment")} title="How much it matters that a bone points along the curve."
        onChange={(value, gesture) => set("alignment", value, gesture)}
      />
      <NumberField
        label="Utilisation" min={0} max={1e6} {...of("utilisation")} title="What each segment is worth that bones reach: how far."
        onChange={(value, gesture) => set("utilisation", value, gesture)}
      />
      <VectorField
        label="Distance" names={["a", "b", "c"]} min={-1e6} max={1e6} {...of("distance")}
        title="Cost of a bone d metres away: a + b d + c d². How near."
        onChange={(value, gesture) => set("distance", value as [number, number, number], gesture)}
      />
      <NumberField
        label="Segment" unit="m" min={0.001} step={0.01} {...of("segment")} title="Length of a segment; about half a bone is good."
        onChange={(value, gesture) => set("segment", value, gesture)}
      />
      <VectorField
        label="Thickness" names={["start", "end"]} min={0} step={0.05} {...of("thickness")}
        title="Radius at the start and at the end within which distance costs nothing, metres."
        onChange={(value, gesture) => set("thickness", value as [number, number], gesture)}
      />
      <VectorField
        label="Start" names={["x", "y", "z"]} step={0.1} value={curve.points[0]}
        onChange={(value, gesture) => set("points", withPoint(curve, 0, value), gesture)}
      />
      <VectorField
        label="End" names={["x", "y", "z"]} step={0.1} value={curve.points[3]}
        onChange={(value, gesture) => set("points", withPoint(curve, 3, value), gesture)}
      />
      {curvesOf(studio.scene.value).length > 1 && <button type="button" class="text-button" onClick={paste}>Use these for all curves</button>}
    </div>
  );
}

function withPoint(curve: Curve, index: number, point: number[]): Curve["points"] {
  return curve.points.map((old, i) => (i === index ? point : old)) as Curve["points"];
}
