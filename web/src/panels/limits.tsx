import type { Density, Limit, Vec3 } from "../api";
import { CheckField } from "../controls/fields";
import { NumberField, VectorField } from "../controls/number_field";
import { readNumber, showNumber } from "../controls/number";
import { useStudio } from "../shell/studio_context";
import { changeCurves, changeLimit, curvesOf, DENSITY_DEFAULTS, LIMIT_NAMES, type LimitName } from "../store/scene";
import { Panel } from "./panel";

const kColumns: readonly { key: keyof Limit; title: string }[] = [
  { key: "min", title: "Never less" },
  { key: "max", title: "Never more" },
  { key: "from", title: "Begins to cost" },
  { key: "to", title: "Costs all of the weight" },
  { key: "weight", title: "What it costs" },
];
const kUnits: Partial<Record<LimitName, string>> = { height: "m", spread: "m", volume: "m³" };

/** How large and how regular a model may be. */
export function LimitsPanel() {
  const studio = useStudio();
  const limits = studio.scene.value.limits ?? {};
  const count = LIMIT_NAMES.filter((name) => limits[name] !== undefined).length;
  const set = (name: LimitName, key: keyof Limit, text: string) => {
    const old = limits[name] ?? {};
    const value = readNumber(text);
    if ((value ?? undefined) === old[key]) return;
    const { [key]: _, ...others } = old;
    const limit: Limit = value === null ? others : { ...others, [key]: value };
    studio.setScene(`Limit ${name}`, changeLimit(studio.scene.value, name, Object.keys(limit).length === 0 ? undefined : limit));
  };
  return (
    <Panel id="limits" title="Limits" note={count || ""}>
      <table class="limits">
        <thead>
          <tr>
            <th scope="col"><span class="unseen">Measure</span></th>
            {kColumns.map(({ key, title }) => <th key={key} scope="col" title={title}>{key}</th>)}
          </tr>
        </thead>
        <tbody>
          {LIMIT_NAMES.map((name) => (
            <tr key={name}>
              <th scope="row">{name}{kUnits[name] && <span class="unit"> {kUnits[name]}</span>}</th>
              {kColumns.map(({ key, title }) => {
                const value = limits[name]?.[key];
                return (
                  <td key={key}>
                    <input
                      class="number" type="text" inputMode="decimal" autocomplete="off" title={title} aria-label={`${name} ${key}`}
                      value={value === undefined ? "" : showNumber(value)}
                      onChange={(event) => set(name, key, event.currentTarget.value)}
                    />
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
      <p class="hint">min and max are kept. Between from and to the score falls by weight.</p>
    </Panel>
  );
}

/** How many bones are wanted in a box. */
export function DensityPanel() {
  const studio = useStudio();
  const scene = studio.scene.value;
  const density = scene.curves?.density;
  const set = (changes: Partial<Density> | null, gesture?: string) =>
    studio.setScene("Set density", changeCurves(studio.scene.value, { density: changes === null ? undefined : { ...studio.scene.value.curves!.density!, ...changes } }), gesture);
  if (curvesOf(scene).length === 0)
    return <Panel id="density" title="Density"><p class="hint">Bones can be spread evenly once there is a curve.</p></Panel>;
  return (
    <Panel id="density" title="Density" note={density === undefined ? "" : "on"}>
      <CheckField
        label="Spread bones" value={density !== undefined}
        onChange={(on) => studio.setScene("Density", changeCurves(scene, { density: on ? boxAround(scene.curves!.curve.flatMap((one) => one.points)) : undefined }))}
      />
      {density !== undefined && (
        <>
          <VectorField label="From" names={["x", "y", "z"]} step={0.1} value={density.min} onChange={(min, gesture) => set({ min: min as Vec3 }, gesture)} />
          <VectorField label="To" names={["x", "y", "z"]} step={0.1} value={density.max} onChange={(max, gesture) => set({ max: max as Vec3 }, gesture)} />
          <NumberField label="Cell" unit="m" min={0.01} step={0.05} value={density.cell ?? DENSITY_DEFAULTS.cell} onChange={(cell, gesture) => set({ cell }, gesture)} />
          <NumberField label="Wanted" unit="per m³" min={0} step={1} value={density.wanted ?? DENSITY_DEFAULTS.wanted} onChange={(wanted, gesture) => set({ wanted }, gesture)} />
          <NumberField label="Cost" min={0} max={1e6} step={1} value={density.cost ?? DENSITY_DEFAULTS.cost} onChange={(cost, gesture) => set({ cost }, gesture)} />
        </>
      )}
    </Panel>
  );
}

/** A box half a metre around points, in full decimetres. */
export function boxAround(points: readonly Vec3[]): Density {
  const axis = (k: 0 | 1 | 2) => points.map((point) => point[k]);
  const low = (k: 0 | 1 | 2) => Math.floor((Math.min(...axis(k)) - 0.5) * 10) / 10;
  const high = (k: 0 | 1 | 2) => Math.ceil((Math.max(...axis(k)) + 0.5) * 10) / 10;
  return { min: [low(0), low(1), low(2)], max: [high(0), high(1), high(2)] };
}
