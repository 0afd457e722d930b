import type { Camera, Silhouette } from "../api";
import { ChoiceField } from "../controls/fields";
import { NumberField } from "../controls/number_field";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { viewCamera } from "../shell/view_access";
import { changeSilhouette, patched, silhouettesOf } from "../store/scene";

export function SilhouetteSettings({ index }: { index: number }) {
  const studio = useStudio();
  const silhouette = silhouettesOf(studio.scene.value)[index]!;
  const project = studio.document.value!.project.id;
  const name = `silhouette ${index + 1}`;
  const set = <K extends keyof Silhouette>(key: K, value: Silhouette[K] | undefined, gesture?: string) =>
    studio.setScene(`Set ${key} of ${name}`, changeSilhouette(studio.scene.value, index, { [key]: value }), gesture && `${gesture} ${index}`);
  const camera = silhouette.camera ?? { fit: true };
  const setCamera = (changes: { [K in keyof Camera]?: Camera[K] | undefined }, gesture?: string) => set("camera", patched(camera, changes), gesture);
  const image = silhouette.image ?? silhouette.want_image ?? silhouette.avoid_image;
  const aroundModel = camera.eye === undefined;
  const fromView = () => {
    const seen = viewCamera();
    if (seen !== null) set("camera", seen);
  };
  return (
    <div role="group" aria-label={`Settings of ${name}`} class="settings">
      <h3>Silhouette {index + 1}</h3>
      {image !== undefined && <img class="silhouette-image" src={studio.files.url(project, image)} alt={`What ${name} wants: ${image}`} />}
      <NumberField
        label="Want" min={0} step={0.1} value={silhouette.want ?? 1} standard={silhouette.want === undefined} title="For each pixel that is wanted and covered."
        onChange={(value, gesture) => set("want", value, gesture)} onReset={() => set("want", undefined)}
      />
      <NumberField
        label="Avoid" min={0} step={0.1} value={silhouette.avoid ?? 1} standard={silhouette.avoid === undefined} title="For each pixel that is covered and should not be."
        onChange={(value, gesture) => set("avoid", value, gesture)} onReset={() => set("avoid", undefined)}
      />
      <NumberField
        label="Weight" min={0} step={0.1} value={silhouette.weight ?? 1} standard={silhouette.weight === undefined} title="Among other targets."
        onChange={(value, gesture) => set("weight", value, gesture)} onReset={() => set("weight", undefined)}
      />
      <ChoiceField
        label="Form" value={silhouette.form ?? "linear"} choices={["linear", "smootherstep"]} standard={silhouette.form === undefined}
        onChange={(form) => set("form", form)}
      />
      <ChoiceField
        label="Looks at" value={silhouette.view ?? "full"} choices={["parts", "full"]} names={{ parts: "parts of rules", full: "parts and details" }}
        standard={silhouette.view === undefined} onChange={(view) => set("view", view)}
      />
      <h3>Camera</h3>
      {aroundModel && (
        <>
          <Slider label="Around" unit="°" min={-180} max={180} step={1} value={camera.azimuth_deg ?? 0} onChange={(value, gesture) => setCamera({ azimuth_deg: value }, gesture)} />
          <Slider label="Above" unit="°" min={-90} max={90} step={1} value={camera.elevation_deg ?? 0} onChange={(value, gesture) => setCamera({ elevation_deg: value }, gesture)} />
        </>
      )}
      {!aroundModel && camera.tall !== undefined && (
        <NumberField label="Height" unit="m" min={0.01} step={0.1} value={camera.tall} onChange={(value, gesture) => setCamera({ tall: value }, gesture)} />
      )}
      {!aroundModel && camera.tall === undefined && (
        <NumberField label="Angle of view" unit="°" min={1} max={170} step={1} value={camera.fov_deg ?? 45} onChange={(value, gesture) => setCamera({ fov_deg: value }, gesture)} />
      )}
      <button type="button" class="text-button" onClick={fromView}>Take the view's camera</button>
    </div>
  );
}
