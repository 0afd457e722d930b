// A page for looking at the view by itself: a synthetic tree, some targets, and a host that keeps the scene. Not part
// of the studio.
//   view-harness.html?parts=3000&light&tool=curve&bones&field&notargets&shadows
import { cloudMessage, meshMessage, treeMeshes, treeModel } from "../../tests/view/synthetic";
import type { Scene } from "../api";
import { kLook, View } from "./create_view";
import type { Tool, ViewHost } from "./host";
import { openContext } from "./stage";

const query = new URLSearchParams(location.search);
const events: unknown[] = [];
let scene: Scene = {
  curves: {
    curve: [
      { points: [[0, 0, 0], [0, 1.2, 0], [-0.3, 2, 0.2], [0.2, 3, 0.4]], thickness: [0.5, 0.15] },
      { points: [[0.2, 3, 0.4], [0.6, 3.9, 0.6], [1.5, 4.2, 0.2], [2.2, 4.0, -0.4]] },
    ],
    density: { min: [-1.5, 0, -1.5], max: [1.5, 3, 1.5] },
  },
  volume: {
    mesh: [
      { file: "shapes/sphere.obj", fill: 1, position: [0, 3.4, 0], scale: [3.6, 2.6, 3.6] },
      { file: "shapes/box.obj", fill: -2, position: [2.6, 0.7, 0.6], scale: [1, 1.4, 1.2], rotation_deg: [0, 30, 0] },
    ],
  },
};

const host: ViewHost = {
  edit(change) {
    events.push({ edit: change.label, gesture: change.gesture });
    scene = change.scene;
    setTimeout(() => view.setScene(structuredClone(change.scene), (path) => path), 5);
    return scene;
  },
  select: (selection) => { events.push({ select: selection }); view.setSelection(selection); },
  setTool: (tool) => { events.push({ tool }); view.setTool(tool); },
  newCurve: () => ({ distance: [0, 0, 100] }),
  paintedBefore: () => null,
  painter: () => (image, camera) => {
    events.push({ painted: image.size, type: image.type, camera });
    Object.assign(window, { image });
  },
  drawn: (model, milliseconds) => { events.push({ drawn: model, milliseconds }); },
};

const opened = openContext()!;
if (query.has("shadows")) opened.software = false;
const view = new View(document.getElementById("view")!, host, opened);
Object.assign(window, {
  view, events, scene: () => scene, treeModel, meshMessage, treeMeshes,
  cloud: (n: number) => view.setCloud(cloudMessage("Bough", Array.from({ length: n }, (_, i) =>
    [Math.sin(i * 1.7) * (i % 37) / 14, 2 + (i % 53) / 20, Math.cos(i * 1.3) * (i % 31) / 14, i % 3] as [number,
      number, number, number]))),
});
view.setLook({
  ...kLook, dark: !query.has("light"), bones: query.has("bones"), field: query.has("field"),
  targets: !query.has("notargets"),
});
if (!query.has("notargets")) view.setScene(scene, (path) => path);
const parts = Number(query.get("parts") ?? 3000);
view.setMeshes(meshMessage(1, treeMeshes()));
view.setModel(treeModel(parts));
view.setRules(["Trunk", "Bough", "Leaf"]);
if (query.has("tool")) view.setTool(query.get("tool") as Tool);
