// Keys of the view. Every tool works without a pointer: Tab goes through curves, their points and volumes, arrows move
// what is selected or turn the camera, Insert adds what the tool makes.
import type { Curve, Vec3 } from "../api";
import type { Desk } from "./desk";
import { nudgeStep } from "./drags";
import { isHidden, type Selection, type Side } from "./host";
import { panned, turned, zoomed } from "./orbit";
import { placingOf, rotated, type Placing } from "./placing";
import {
  addCurve, addMesh, curvesOf, kMostCurves, meshesOf, movedCurve, movedPoint, removeCurve, removeMesh, setPlacing,
  setPoints,
} from "./scene_edits";
import { shapeAt } from "./shape_drag";
import { kShapes, shapeFile, type Shape } from "./shapes";
import { add, along, scale, tidy3, type V } from "./vec";

export interface Key {
  key: string;
  shift: boolean;
  ctrl: boolean;
  alt: boolean;
}

const kSideKeys: Record<string, readonly [Side, Side]> = { "1": ["+z", "-z"], "3": ["+x", "-x"], "7": ["+y", "-y"] };
const kPointNames = ["start", "first handle", "second handle", "end"];
const kPause = 800;
const kPanPixels = 40;

export class Keys {
  private nudge: { what: string; gesture: string; until: number } | null = null;

  constructor(private readonly desk: Desk, private readonly now: () => number) {}

  /** True where the key meant something. */
  press(k: Key): boolean {
    const { desk } = this, { selection } = desk;
    if (k.key === "Tab" && !k.ctrl && !k.alt) return this.cycle(k.shift ? -1 : 1);
    if (k.ctrl) return k.key.toLowerCase() === "d" && this.duplicate();
    if (k.alt) return false;
    if (k.key === "Delete" || k.key === "Backspace") return this.remove();
    if (k.key === "Insert" || k.key === "n") return this.insert();
    if (k.key === "Home" || k.key === "f") return desk.frame(), true;
    const side = kSideKeys[k.key];
    if (side) return desk.snapSide(side[k.shift ? 1 : 0]), true;
    if (k.key === "+" || k.key === "=" || k.key === "-") return this.zoom(k.key === "-" ? 1.15 : 1 / 1.15);
    const arrows: Record<string, readonly [number, number, number]> = {
      ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, -1],
      PageDown: [0, 0, 1],
    };
    const arrow = arrows[k.key];
    const movable = (selection?.kind === "curve" || selection?.kind === "mesh") && desk.targets;
    if (arrow && movable) return this.move(selection, arrow, k.shift ? 10 : 1);
    if (arrow && arrow[2] === 0 && k.shift) {
      desk.orbit = panned(desk.orbit, desk.eye(), -kPanPixels * arrow[0], kPanPixels * arrow[1]);
      return true;
    }
    if (arrow && arrow[2] === 0) {
      desk.orbit = turned(desk.orbit, -8 * arrow[0], 8 * arrow[1]);
      return true;
    }
    if (selection?.kind === "mesh" && desk.targets) return this.reshape(selection.index, k);
    return (k.key === "." || k.key === ",") && this.part(k.key === "." ? 1 : -1);
  }

  /** The next part of the model, or the one before, gene by gene; round and round. */
  private part(step: 1 | -1): boolean {
    const { desk } = this, genes = desk.genes(), now = desk.selection?.kind === "gene" ? desk.selection.gene : null;
    if (genes.length === 0) return false;
    const found = now === null ? -1 : genes.indexOf(now), at = found < 0 && step < 0 ? 0 : found;
    const gene = genes[(at + step + genes.length) % genes.length]!;
    desk.select({ kind: "gene", gene });
    desk.say(`Part ${genes.indexOf(gene) + 1} of ${genes.length}`);
    return true;
  }

  private zoom(factor: number): boolean {
    const eye = this.desk.eye();
    this.desk.orbit = zoomed(this.desk.orbit, eye, factor, eye.width / 2, eye.height / 2);
    return true;
  }

  /** Everything that is shown and can be selected, in order. At either end Tab goes on to the rest of the page. */
  private cycle(step: number): boolean {
    const { desk } = this, scene = desk.draft.scene;
    if (!desk.targets) return false;
    const stops: Selection[] = [
      ...curvesOf(scene).flatMap((_, index): Selection[] =>
        [{ kind: "curve", index }, ...[0, 1, 2, 3].map((point): Selection => ({ kind: "curve", index, point }))]),
      ...meshesOf(scene).map((_, index): Selection => ({ kind: "mesh", index })),
    ].filter((stop) => !isHidden(desk.hidden, stop));
    const same = (a: Selection, b: Selection | null): boolean => JSON.stringify(a) === JSON.stringify(b);
    const at = stops.findIndex((stop) => same(stop, desk.selection));
    const next = stops[at < 0 ? (step > 0 ? 0 : stops.length - 1) : at + step];
    if (!next) return false;
    desk.select(next);
    desk.say(next.kind === "mesh" ? `Volume ${next.index + 1}` : next.kind === "curve"
      ? `Curve ${next.index + 1}${next.point === undefined ? "" : `, ${kPointNames[next.point]}`}` : "");
    return true;
  }

  /** Presses that follow each other within a moment are one step of undo. */
  private gesture(what: string): string {
    const fresh = !this.nudge || this.nudge.what !== what || this.now() > this.nudge.until;
    const gesture = fresh ? this.desk.draft.newGesture() : this.nudge!.gesture;
    this.nudge = { what, gesture, until: this.now() + kPause };
    return gesture;
  }

  private move(selection: Selection, arrow: V, times: number): boolean {
    const { desk } = this, scene = desk.draft.scene, eye = desk.eye();
    const by = (at: V): Vec3 => scale(add(add(scale(eye.right, arrow[0]), scale(eye.up, arrow[1])),
      scale(eye.back, arrow[2])),
      times * nudgeStep(desk, at));
    if (selection.kind === "curve") {
      const curve = curvesOf(scene)[selection.index];
      if (!curve) return false;
      const { point } = selection, grip = curve.points[point ?? 0]!;
      const points = point === undefined ? movedCurve(curve.points, by(grip))
        : movedPoint(curve.points, point, add(grip, by(grip)));
      desk.draft.once(`Move curve ${selection.index + 1}`, setPoints(scene, selection.index, points),
        this.gesture(`curve ${selection.index} ${point}`));
      return true;
    }
    const mesh = selection.kind === "mesh" ? meshesOf(scene)[selection.index] : undefined;
    if (selection.kind !== "mesh" || !mesh) return false;
    const p = placingOf(mesh);
    this.place(selection.index, { ...p, position: add(p.position, by(p.position)) }, "Move");
    return true;
  }

  private place(index: number, placing: Placing, what: string): void {
    this.desk.draft.once(`${what} volume ${index + 1}`, setPlacing(this.desk.draft.scene, index, placing),
      this.gesture(`${what} ${index}`));
  }

  /** x, y, z make a volume longer along an axis, with shift shorter; comma and full stop scale it evenly; r turns it
   *  about y. */
  private reshape(index: number, k: Key): boolean {
    const mesh = meshesOf(this.desk.draft.scene)[index];
    if (!mesh) return false;
    const p = placingOf(mesh), key = k.key.toLowerCase(), axis = "xyz".indexOf(key), factor = k.shift ? 1 / 1.1 : 1.1;
    if (key.length === 1 && axis >= 0) {
      this.place(index, { ...p, scale: p.scale.map((s, i) => (i === axis ? s * factor : s)) as Vec3 }, "Scale");
    } else if (key === "," || key === ".") {
      this.place(index, { ...p, scale: scale(p.scale, key === "." ? 1.1 : 1 / 1.1) }, "Scale");
    } else if (key === "r") {
      this.place(index, rotated(p, [0, 1, 0], (k.shift ? -1 : 1) * Math.PI / 12), "Turn");
    } else return false;
    return true;
  }

  private remove(): boolean {
    const { desk } = this, { selection } = desk, scene = desk.draft.scene;
    if (!selection || !desk.targets) return false;
    if (selection.kind === "curve" && curvesOf(scene)[selection.index]) {
      desk.select(null);
      desk.draft.once(`Delete curve ${selection.index + 1}`, removeCurve(scene, selection.index));
    } else if (selection.kind === "mesh" && meshesOf(scene)[selection.index]) {
      desk.select(null);
      desk.draft.once(`Delete volume ${selection.index + 1}`, removeMesh(scene, selection.index));
    } else return false;
    desk.say("Deleted");
    return true;
  }

  /** The copy lies beside the original, to the right as it is seen. */
  private duplicate(): boolean {
    const { desk } = this, { selection } = desk, scene = desk.draft.scene, right = desk.eye().right;
    if (!selection || !desk.targets) return false;
    if (selection.kind === "curve") {
      const curve = curvesOf(scene)[selection.index], count = curvesOf(scene).length;
      if (!curve || count >= kMostCurves) return false;
      const moved = movedCurve(curve.points, scale(right, 6 * nudgeStep(desk, curve.points[0])));
      const copy: Curve = { ...curve, points: moved.map(tidy3) as Curve["points"] };
      desk.draft.once(`Duplicate curve ${selection.index + 1}`, addCurve(scene, copy));
      desk.select({ kind: "curve", index: count });
    } else if (selection.kind === "mesh") {
      const mesh = meshesOf(scene)[selection.index];
      if (!mesh) return false;
      const p = placingOf(mesh);
      desk.draft.once(`Duplicate volume ${selection.index + 1}`,
        addMesh(scene, { ...mesh, position: tidy3(along(p.position, 10 * nudgeStep(desk, p.position), right)) }));
      desk.select({ kind: "mesh", index: meshesOf(scene).length });
    } else return false;
    desk.say("Duplicated");
    return true;
  }

  /** What the tool makes, in the middle of the view: an upright curve, or a shape. */
  private insert(): boolean {
    const { desk } = this, { tool } = desk, scene = desk.draft.scene, eye = desk.eye();
    if (tool === "curve" && curvesOf(scene).length < kMostCurves) {
      const size = eye.distance / 4, index = curvesOf(scene).length;
      const points = [-1.5, -0.5, 0.5, 1.5].map((i) =>
        tidy3(along(eye.target, i * size / 3, eye.up))) as Curve["points"];
      desk.draft.once(`Draw curve ${index + 1}`, addCurve(scene, { ...desk.host.newCurve(), points }));
      desk.select({ kind: "curve", index });
      desk.say(`Curve ${index + 1} added`);
      return true;
    }
    if (!kShapes.includes(tool as Shape)) return false;
    const placing = shapeAt(eye, tool as Shape), index = meshesOf(scene).length;
    desk.draft.once(`Add ${tool}`, addMesh(scene, {
      file: shapeFile(tool as Shape), fill: 1, position: tidy3(placing.position), scale: tidy3(placing.scale),
    }));
    desk.select({ kind: "mesh", index });
    desk.say(`${tool} added`);
    return true;
  }
}
