import type { Vec3, VolumeMesh } from "../api";
import { ChoiceField } from "../controls/fields";
import { NumberField, VectorField } from "../controls/number_field";
import { useStudio } from "../shell/studio_context";
import { changeMesh, changeVolume, meshesOf } from "../store/scene";

export function MeshSettings({ index }: { index: number }) {
  const studio = useStudio();
  const scene = studio.scene.value;
  const mesh = meshesOf(scene)[index]!;
  const volume = scene.volume!;
  const name = `mesh ${index + 1}`;
  const set = <K extends keyof VolumeMesh>(key: K, value: VolumeMesh[K] | undefined, gesture?: string) =>
    studio.setScene(`Set ${key} of ${name}`, changeMesh(studio.scene.value, index, { [key]: value }), gesture && `${gesture} ${index}`);
  const setAll = (changes: Parameters<typeof changeVolume>[1], gesture?: string) =>
    studio.setScene("Set the volume", changeVolume(studio.scene.value, changes), gesture);
  const linear = (volume.form ?? "linear") === "linear";
  return (
    <div role="group" aria-label={`Settings of ${name}`} class="settings">
      <h3>{mesh.file}</h3>
      <NumberField
        label="Fill" step={0.1} value={mesh.fill ?? 1} standard={mesh.fill === undefined} title="Reward for what is inside; negative: avoid."
        onChange={(value, gesture) => set("fill", value, gesture)} onReset={() => set("fill", undefined)}
      />
      <NumberField
        label="Spill" step={0.1} value={mesh.spill ?? (linear ? -1 : 1)} standard={mesh.spill === undefined}
        title={linear ? "Added for what is outside of all meshes." : "Weight of what is wrong."}
        onChange={(value, gesture) => set("spill", value, gesture)} onReset={() => set("spill", undefined)}
      />
      <VectorField
        label="Position" names={["x", "y", "z"]} step={0.1} value={mesh.position ?? [0, 0, 0]} standard={mesh.position === undefined}
        onChange={(value, gesture) => set("position", value as Vec3, gesture)} onReset={() => set("position", undefined)}
      />
      <VectorField
        label="Scale" names={["x", "y", "z"]} step={0.1} value={scaleOf(mesh)} standard={mesh.scale === undefined}
        onChange={(value, gesture) => set("scale", value as Vec3, gesture)} onReset={() => set("scale", undefined)}
      />
      <VectorField
        label="Rotation" names={["x", "y", "z"]} step={5} value={mesh.rotation_deg ?? [0, 0, 0]} standard={mesh.rotation_deg === undefined}
        title="Degrees about x, then y, then z."
        onChange={(value, gesture) => set("rotation_deg", value as Vec3, gesture)} onReset={() => set("rotation_deg", undefined)}
      />
      <h3>All meshes</h3>
      <ChoiceField
        label="Form" value={volume.form ?? "linear"} choices={["linear", "smootherstep", "smootherstep-separate"]} standard={volume.form === undefined}
        onChange={(form) => setAll({ form })}
      />
      <ChoiceField
        label="Looks at" value={volume.view ?? "full"} choices={["parts", "full"]} names={{ parts: "parts of rules", full: "parts and details" }}
        standard={volume.view === undefined} onChange={(view) => setAll({ view })}
      />
      <NumberField
        label="Overlap" step={0.1} min={0} value={volume.overlap_weight ?? 0} standard={volume.overlap_weight === undefined}
        title="Subtracted where parts overlap."
        onChange={(overlap_weight, gesture) => setAll({ overlap_weight }, gesture)} onReset={() => setAll({ overlap_weight: undefined })}
      />
      <NumberField
        label="Cells" step={100000} whole min={1} max={64e6} value={volume.cells ?? 2e6} standard={volume.cells === undefined}
        title="Of the grid in which is counted: fewer are quicker."
        onChange={(cells, gesture) => setAll({ cells }, gesture)} onReset={() => setAll({ cells: undefined })}
      />
    </div>
  );
}

/** A scene may say one number for all three. */
function scaleOf(mesh: VolumeMesh): Vec3 {
  const scale: unknown = mesh.scale ?? 1;
  return typeof scale === "number" ? [scale, scale, scale] : (scale as Vec3);
}
