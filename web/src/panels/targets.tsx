// What the model shall do: curves, meshes and silhouettes, with the settings of the one that is selected.
import { CheckField } from "../controls/fields";
import { Icon, type IconName } from "../controls/icons";
import { IconButton } from "../controls/fields";
import { NumberField } from "../controls/number_field";
import { useStudio } from "../shell/studio_context";
import {
  addMesh, addSilhouette, changeCurves, changeMesh, changeSilhouette, curvesOf, meshesOf, silhouettesOf, type TargetKind,
} from "../store/scene";
import { isMeshFile } from "../editor/drop_mesh";
import { CurveSettings } from "./curve_settings";
import { MeshSettings } from "./mesh_settings";
import { Panel } from "./panel";
import { pickFile } from "./pick_file";
import { SilhouetteSettings } from "./silhouette_settings";

interface Row {
  kind: TargetKind;
  index: number;
  name: string;
  icon: IconName;
  note: string;
}

const kShapes: Record<string, { name: string; icon: IconName }> = {
  "shapes/box.obj": { name: "Box", icon: "box" },
  "shapes/sphere.obj": { name: "Sphere", icon: "sphere" },
  "shapes/cylinder.obj": { name: "Cylinder", icon: "cylinder" },
};

export function TargetsPanel() {
  const studio = useStudio();
  const scene = studio.scene.value;
  const rows: Row[] = [
    ...curvesOf(scene).map((_, index): Row => ({ kind: "curve", index, name: `Curve ${index + 1}`, icon: "curve", note: "" })),
    ...meshesOf(scene).map((mesh, index): Row => {
      const shape = kShapes[mesh.file];
      return {
        kind: "mesh", index, name: shape ? `${shape.name} ${index + 1}` : mesh.file, icon: shape?.icon ?? "box",
        note: (mesh.fill ?? 1) < 0 ? "avoid" : "fill",
      };
    }),
    ...silhouettesOf(scene).map((silhouette, index): Row => ({
      kind: "silhouette", index, name: silhouette.image ?? silhouette.want_image ?? `Silhouette ${index + 1}`, icon: "paint", note: "",
    })),
  ];
  const selection = studio.state.selection.value;
  const problem = studio.state.checked.value?.scene_problem;
  return (
    <Panel
      id="targets" title="Targets" note={rows.length || ""} actions={<AddTarget />}
      reveal={selection === null || selection.kind === "gene" ? "" : `${selection.kind} ${selection.index}`}
    >
      {problem !== undefined && <p class="problem-line" role="alert">{problem}</p>}
      {rows.length === 0 && <p class="hint">Draw a curve in the view (C), or add a mesh or a picture.</p>}
      <ul class="targets" aria-label="Targets">
        {rows.map((row) => <TargetRow key={`${row.kind}${row.index}`} row={row} />)}
      </ul>
      {selection?.kind === "curve" && curvesOf(scene)[selection.index] && <CurveSettings index={selection.index} />}
      {selection?.kind === "mesh" && meshesOf(scene)[selection.index] && <MeshSettings index={selection.index} />}
      {selection?.kind === "silhouette" && silhouettesOf(scene)[selection.index] && <SilhouetteSettings index={selection.index} />}
      {curvesOf(scene).length > 0 && <AllCurves />}
    </Panel>
  );
}

function AllCurves() {
  const studio = useStudio();
  const curves = studio.scene.value.curves!;
  return (
    <div role="group" aria-label="All curves" class="settings">
      <h3>All curves</h3>
      <CheckField
        label="Blend" value={curves.blend ?? false} standard={curves.blend === undefined}
        title="Weighs the directions of the two nearest curves by how near they are."
        onChange={(blend) => studio.setScene("Blend curves", changeCurves(studio.scene.value, { blend }))}
      />
      <NumberField
        label="Weight" value={curves.weight ?? 1} min={0} max={1e6} step={0.1} standard={curves.weight === undefined}
        title="Of all curves among other targets."
        onChange={(weight, gesture) => studio.setScene("Weight of curves", changeCurves(studio.scene.value, { weight }), gesture)}
        onReset={() => studio.setScene("Weight of curves", changeCurves(studio.scene.value, { weight: undefined }))}
      />
    </div>
  );
}

function TargetRow({ row }: { row: Row }) {
  const studio = useStudio();
  const { kind, index } = row;
  const selection = studio.state.selection.value;
  const selected = selection?.kind === kind && selection.index === index;
  const isHidden = studio.visibility.isHidden(kind, index);
  return (
    <li class={selected ? "selected" : ""}>
      <button
        type="button" class="target-name" aria-pressed={selected}
        onClick={() => studio.select(selected ? null : { kind, index })}
        onKeyDown={(event) => {
          if (event.key === "Delete" || event.key === "Backspace") studio.removeTarget(kind, index);
        }}
      >
        <Icon name={row.icon} />
        <span>{row.name}</span>
      </button>
      <TargetWeight row={row} />
      <IconButton label={`Hide ${row.name}`} pressed={isHidden} onClick={() => studio.visibility.toggle(kind, index)}>
        <Icon name={isHidden ? "eyeOff" : "eye"} />
      </IconButton>
      <IconButton label={`Duplicate ${row.name}`} onClick={() => studio.duplicateTarget(kind, index)}><Icon name="copy" /></IconButton>
      <IconButton label={`Delete ${row.name}`} onClick={() => studio.removeTarget(kind, index)}><Icon name="trash" /></IconButton>
    </li>
  );
}

/** How much it counts, where one number says it. */
function TargetWeight({ row }: { row: Row }) {
  const studio = useStudio();
  const { kind, index, name } = row;
  if (kind === "mesh") {
    const mesh = meshesOf(studio.scene.value)[index]!;
    const avoid = (mesh.fill ?? 1) < 0;
    const flip = () => studio.setScene(
      avoid ? `Fill ${name}` : `Avoid ${name}`,
      changeMesh(studio.scene.value, index, avoid ? { fill: Math.abs(mesh.fill ?? 1), spill: undefined } : { fill: -Math.abs(mesh.fill ?? 1), spill: 0 }),
    );
    return (
      <button type="button" class={`chip ${avoid ? "chip-avoid" : "chip-fill"}`} title="Fill or avoid" aria-label={`${name}: ${row.note}. Change`} onClick={flip}>
        {row.note}
      </button>
    );
  }
  if (kind === "silhouette") {
    const weight = silhouettesOf(studio.scene.value)[index]!.weight ?? 1;
    const flip = () => studio.setScene(`Weight of ${name}`, changeSilhouette(studio.scene.value, index, { weight: weight === 0 ? undefined : 0 }));
    return (
      <button type="button" class="chip" title="Weight; click to switch off or on" aria-label={`${name}: weight ${weight}. Switch ${weight === 0 ? "on" : "off"}`} onClick={flip}>
        {weight === 0 ? "off" : `× ${weight}`}
      </button>
    );
  }
  return null;
}

function AddTarget() {
  const studio = useStudio();
  const add = async () => {
    const file = await pickFile(".obj,.glb,.ply,.stl,.png,.jpg,.jpeg");
    if (file === null) return;
    const path = await studio.addFile(file.name, file);
    if (path === null) return;
    const scene = studio.scene.value;
    if (isMeshFile(path)) {
      studio.setScene(`Add ${path}`, addMesh(scene, { file: path }));
      studio.select({ kind: "mesh", index: meshesOf(scene).length });
    } else {
      studio.setScene(`Add ${path}`, addSilhouette(scene, { image: path, view: "parts", camera: { fit: true, azimuth_deg: 0, elevation_deg: 0 } }));
      studio.select({ kind: "silhouette", index: silhouettesOf(scene).length });
    }
  };
  return (
    <IconButton label="Add a mesh or a picture" onClick={() => void add()}><Icon name="plus" /></IconButton>
  );
}
