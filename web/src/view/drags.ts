// What can be dragged: the camera, points of curves, whole curves, handles of the gizmo, new strokes and new shapes.
import type { Curve } from "../api";
import type { Desk, Drag, Pointer } from "./desk";
import { snapTo } from "./curve_picking";
import { fitCubic } from "./fit_curve";
import { dragGizmo, type GizmoHandle } from "./gizmo";
import { atDepth, depthOf, eyeOf, panned, pixelSize, turned, zoomed } from "./orbit";
import type { Tool } from "./host";
import { placingOf, type Placing } from "./placing";
import { addCurve, addMesh, curvesOf, kMostCurves, meshesOf, movedCurve, movedPoint, setPlacing,
  setPoints } from "./scene_edits";
import { boardFor, onBoard, shapeBetween, withHeight } from "./shape_drag";
import { shapeFile, type Shape } from "./shapes";
import { penThickness, placeStroke, type Anchor, type Ink } from "./stroke_placing";
import { subtract, tidy, tidy3, type V } from "./vec";

const nothing = (): void => {};

/** Orbits, pans (`pan`) or zooms (`zoom`); `click` is what letting go means where the pointer did not move. */
export function cameraDrag(desk: Desk, from: Pointer, how: "orbit" | "pan" | "zoom",
  click: (p: Pointer) => void = nothing): Drag {
  const before = desk.orbit;
  let last = from;
  return {
    move(p) {
      const dx = p.x - last.x, dy = p.y - last.y, eye = desk.eye();
      last = p;
      desk.orbit = how === "pan" ? panned(desk.orbit, eye, dx, dy)
        : how === "zoom" ? zoomed(desk.orbit, eye, Math.exp(0.008 * dy), from.x, from.y) : turned(desk.orbit, dx, dy);
    },
    end(p, clicked) {
      if (clicked) {
        desk.orbit = before;
        click(p);
      }
    },
    cancel() { desk.orbit = before; },
  };
}

export function clickOnly(click: (p: Pointer) => void): Drag {
  return { move: nothing, end: (p, clicked) => { if (clicked) click(p); }, cancel: nothing };
}

const curveName = (index: number): string => `curve ${index + 1}`;

/** One control point, parallel to the screen; ends snap to other curves' ends unless shift is held. */
export function pointDrag(desk: Desk, index: number, point: number, from: Pointer): Drag {
  const start = curvesOf(desk.draft.scene)[index]!.points, eye = desk.eye(), depth = depthOf(eye, start[point]!);
  const grip = subtract(start[point]!, atDepth(eye, from.x, from.y, depth));
  const isEnd = point === 0 || point === 3;
  desk.draft.begin(`Move ${curveName(index)}`);
  return {
    move(p) {
      const to = atDepth(eye, p.x, p.y, depth).map((x, i) => x + grip[i]!) as [number, number, number];
      desk.snapMark = isEnd && !p.shift ? snapTo(eye, curvesOf(desk.draft.scene), [index, ...desk.hidden.curves], p.x, p.y, true) : null;
      desk.draft.change(setPoints(desk.draft.scene, index, movedPoint(start, point, desk.snapMark ?? to)));
    },
    end(_, clicked) {
      desk.snapMark = null;
      if (clicked) desk.draft.cancel();
      else desk.draft.end();
    },
    cancel() {
      desk.snapMark = null;
      desk.draft.cancel();
    },
  };
}

/** A whole curve, parallel to the screen. */
export function curveDrag(desk: Desk, index: number, from: Pointer, depth: number): Drag {
  const start = curvesOf(desk.draft.scene)[index]!.points, eye = desk.eye();
  const origin = atDepth(eye, from.x, from.y, depth);
  desk.draft.begin(`Move ${curveName(index)}`);
  return {
    move(p) {
      const by = subtract(atDepth(eye, p.x, p.y, depth), origin);
      desk.draft.change(setPoints(desk.draft.scene, index, movedCurve(start, by)));
    },
    end: (_, clicked) => (clicked ? desk.draft.cancel() : desk.draft.end()),
    cancel: () => desk.draft.cancel(),
  };
}

const kDone = { free: "Move", move: "Move", plane: "Move", scale: "Scale", turn: "Turn" } as const;

export function gizmoDrag(desk: Desk, index: number, handle: GizmoHandle, from: Pointer): Drag {
  const start = placingOf(meshesOf(desk.draft.scene)[index]!), eye = desk.eye();
  desk.draft.begin(`${kDone[handle.kind]} volume ${index + 1}`);
  return {
    move(p) {
      desk.draft.change(setPlacing(desk.draft.scene, index,
        dragGizmo(eye, start, handle, [from.x, from.y], [p.x, p.y], p.shift)));
    },
    end: (_, clicked) => (clicked ? desk.draft.cancel() : desk.draft.end()),
    cancel: () => desk.draft.cancel(),
  };
}

/** A stroke that becomes a curve. Its ends are held by other curves' ends, else by what lies under them. */
export function strokeDrag(desk: Desk, from: Pointer, click: (p: Pointer) => void): Drag {
  const eye = desk.eye();
  const anchorAt = (p: Pointer, anywhere: boolean): Anchor | null => {
    const curves = curvesOf(desk.draft.scene);
    const snapped = p.shift ? null : snapTo(eye, curves, desk.hidden.curves, p.x, p.y, anywhere);
    const point = snapped ?? desk.under(p.x, p.y)?.point;
    return point ? { point } : null;
  };
  const start = anchorAt(from, true);
  const ink: Ink[] = [...from.ink];
  return {
    move(p) {
      ink.push(...p.ink);
      desk.ink = ink;
      desk.snapMark = p.shift ? null : snapTo(eye, curvesOf(desk.draft.scene), desk.hidden.curves, p.x, p.y);
    },
    end(p, clicked) {
      desk.ink = [];
      desk.snapMark = null;
      if (clicked) return click(p);
      const curves = curvesOf(desk.draft.scene);
      if (curves.length >= kMostCurves) return desk.say(`There are ${kMostCurves} curves, as many as there can be`);
      const surface = (x: number, y: number): V | null => desk.under(x, y)?.point ?? null;
      const points = fitCubic(placeStroke(eye, ink, start, anchorAt(p, false), surface));
      if (!points) return;
      const curve: Curve = { ...desk.host.newCurve(), points: points.map(tidy3) as Curve["points"] };
      if (p.pen) curve.thickness = penThickness(eye, ink, depthOf(eye, points[0])).map(tidy) as [number, number];
      desk.draft.once(`Draw ${curveName(curves.length)}`, addCurve(desk.draft.scene, curve));
      desk.select({ kind: "curve", index: curves.length });
      desk.say(`Curve ${curves.length + 1} drawn`);
    },
    cancel() {
      desk.ink = [];
      desk.snapMark = null;
    },
  };
}

/** The base of a new shape; `tall` goes on with its height where it has one of its own. */
export function shapeDrag(desk: Desk, shape: Shape, from: Pointer, tall: (step: HeightStep) => void): Drag {
  const eye = desk.eye(), board = boardFor(eye), a = onBoard(eye, board, from.x, from.y);
  let placing: Placing | null = null;
  // Nothing goes out before the shape is whole: a search for a flat box would be for nothing. Other edits may meanwhile.
  const show = (now: Placing): void => {
    placing = now;
    const mesh = { file: shapeFile(shape), fill: 1, position: tidy3(now.position), scale: tidy3(now.scale) };
    desk.draft.preview((scene) => addMesh(scene, mesh));
  };
  const select = (): void => desk.select({ kind: "mesh", index: meshesOf(desk.draft.scene).length - 1 });
  if (!a) return cameraDrag(desk, from, "orbit");
  desk.draft.begin(`Add ${shape}`);
  return {
    move(p) {
      const b = onBoard(eye, board, p.x, p.y);
      if (b) show(shapeBetween(shape, board, a, b));
    },
    end(p, clicked) {
      const base = placing;
      if (clicked || !base) return desk.draft.cancel();
      const finish = (next?: Tool): void => {
        desk.draft.change(desk.draft.scene);
        desk.draft.end();
        select();
        if (!next) desk.host.setTool("select");
        desk.say(`${shape} added`);
      };
      if (shape === "sphere" || board.upright) return finish();
      select();
      tall({
        move: (q) => show(withHeight(eyeOf(desk.orbit, eye.width, eye.height), base, q.x - p.x, q.y - p.y)),
        finish,
        cancel: () => { desk.draft.cancel(); desk.select(null); },
      });
    },
    cancel: () => desk.draft.cancel(),
  };
}

/** The height of a shape follows the pointer until it is pressed again. */
export interface HeightStep {
  move(p: { x: number; y: number }): void;
  /** `next`: the tool that was chosen instead of this one. */
  finish(next?: Tool): void;
  cancel(): void;
}

/** Metres that a nudge by an arrow key means at a point: a hundredth of the picture's height. */
export const nudgeStep = (desk: Desk, at: V): number => pixelSize(desk.eye(),
  depthOf(desk.eye(), at)) * desk.eye().height / 100;
