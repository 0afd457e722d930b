// What is drawn over the model: curves with their arrow heads, points of the selected one, the gizmo, the density box,
// what is being drawn, the gnomon. All as strokes in pixels, made anew for a frame in which something of it changed.
import type { Scene } from "../api";
import { samples } from "./bezier";
import { kSegments } from "./curve_picking";
import { gizmoHandles, kArrowHead, type GizmoHandle } from "./gizmo";
import { drawGnomon } from "./gnomon";
import { isHidden, type Hidden, type Selection, type Side } from "./host";
import { project, type Eye } from "./orbit";
import type { Palette, Rgb } from "./palette";
import { placingOf } from "./placing";
import { curvesOf, meshesOf } from "./scene_edits";
import type { Strokes } from "./strokes";
import type { Vec3 } from "../api";
import type { V } from "./vec";

/** What the pointer is over. */
export type Hover =
  | { kind: "curve"; index: number }
  | { kind: "point"; index: number; point: number }
  | { kind: "gizmo"; handle: Pick<GizmoHandle, "kind" | "axis"> }
  | { kind: "side"; side: Side };

export interface OverlayState {
  eye: Eye;
  scene: Scene;
  palette: Palette;
  selection: Selection | null;
  hover: Hover | null;
  targets: boolean;
  hidden: Hidden;
  /** A stroke as it is drawn, in pixels. */
  ink: readonly { x: number; y: number }[];
  /** Where a dragged end would snap. */
  snap: V | null;
}

export function drawOverlay(strokes: Strokes, state: OverlayState): void {
  const { eye, scene, palette, hover, hidden } = state;
  const selection = state.selection && isHidden(hidden, state.selection) ? null : state.selection;
  strokes.clear();
  if (state.targets) {
    drawDensity(strokes, state);
    curvesOf(scene).forEach((curve, index) => {
      const chosen = selection?.kind === "curve" && selection.index === index;
      const over = (hover?.kind === "curve" || hover?.kind === "point") && hover.index === index;
      if (!chosen && !hidden.curves.includes(index)) drawCurve(strokes, eye, curve.points, palette, palette.curve, over ? 5 : 3.2);
    });
    if (selection?.kind === "curve") drawChosen(strokes, state, selection.index, selection.point);
    const mesh = selection?.kind === "mesh" ? meshesOf(scene)[selection.index] : undefined;
    if (mesh) drawGizmo(strokes, gizmoHandles(eye, placingOf(mesh)), palette, hover);
  }
  if (state.snap) {
    const s = project(eye, state.snap);
    ring(strokes, s.x, s.y, 22, palette.selected, 2);
  }
  for (const [width, colour, alpha] of [[6, palette.halo, 0.35], [3, palette.selected, 1]] as const) {
    for (let i = 0; i + 1 < state.ink.length; ++i) {
      const a = state.ink[i]!, b = state.ink[i + 1]!;
      strokes.line(a.x, a.y, b.x, b.y, width, width, colour, alpha);
    }
  }
  drawGnomon(strokes, eye, palette, hover?.kind === "side" ? hover.side : null);
}

function drawCurve(strokes: Strokes, eye: Eye, points: readonly [V, V, V, V], palette: Palette, colour: Rgb,
  width: number): void {
  const path = samples(points, kSegments);
  strokes.path(eye, path, width + 2.6, palette.halo, 0.55);
  arrow(strokes, eye, path, width + 1.5, 4.2, palette.halo, 0.55);
  strokes.path(eye, path, width, colour);
  arrow(strokes, eye, path, width, 3.4, colour, 1);
  const start = project(eye, points[0]);
  if (start.depth > 0) strokes.dot(start.x, start.y, width + 3.5, colour);
}

/** A head at the end of a path, seen from where it comes along its last pixels. */
function arrow(strokes: Strokes, eye: Eye, path: readonly Vec3[], width: number, wide: number, colour: Rgb,
  alpha: number): void {
  const tip = project(eye, path[path.length - 1]!);
  if (tip.depth <= 0) return;
  for (let i = path.length - 2; i >= 0; --i) {
    const p = project(eye, path[i]!), dx = tip.x - p.x, dy = tip.y - p.y, l = Math.hypot(dx, dy);
    if (p.depth <= 0 || (l < 10 && i > 0)) continue;
    if (l < 2) return;
    const head = 3.6 * width + 3;
    strokes.line(tip.x - dx / l * head * 0.3, tip.y - dy / l * head * 0.3, tip.x + dx / l * head * 0.7,
      tip.y + dy / l * head * 0.7,
      wide * width, 0, colour, alpha);
    return;
  }
}

function drawChosen(strokes: Strokes, { eye, scene, palette, hover }: OverlayState, index: number,
  point?: number): void {
  const curve = curvesOf(scene)[index];
  if (!curve) return;
  const p = curve.points;
  drawCurve(strokes, eye, p, palette, palette.selected, 4);
  for (const [end, handle] of [[p[0], p[1]], [p[3], p[2]]] as const) {
    strokes.segment(eye, end, handle, 3.4, palette.halo, 0.45);
    strokes.segment(eye, end, handle, 1.6, palette.handle, 0.85);
  }
  p.forEach((v, i) => {
    const s = project(eye, v);
    if (s.depth <= 0) return;
    const over = hover?.kind === "point" && hover.point === i && hover.index === index;
    const size = (i === 0 || i === 3 ? 12 : 10) + (over ? 4 : 0);
    strokes.dot(s.x, s.y, size + 3.5, palette.halo, 0.8);
    strokes.dot(s.x, s.y, size, i === point ? palette.selected : palette.handle);
    if (i === 0 || i === 3) strokes.dot(s.x, s.y, size - 6, i === point ? palette.handle : palette.selected);
    if (i === point) ring(strokes, s.x, s.y, size + 9, palette.selected, 1.8);
  });
}

function ring(strokes: Strokes, x: number, y: number, width: number, colour: Rgb, line: number): void {
  const at = (i: number): [number, number] =>
    [x + width / 2 * Math.cos(Math.PI * i / 10), y + width / 2 * Math.sin(Math.PI * i / 10)];
  for (let i = 0; i < 20; ++i) strokes.line(...at(i), ...at(i + 1), line, line, colour, 1);
}

function drawGizmo(strokes: Strokes, handles: readonly GizmoHandle[], palette: Palette, hover: Hover | null): void {
  const shown = handles.filter((h) => !h.faint);
  const over = (h: GizmoHandle): boolean =>
    hover?.kind === "gizmo" && hover.handle.kind === h.kind && (h.kind === "free" || hover.handle.axis === h.axis);
  const colourOf = (h: GizmoHandle): Rgb => (over(h) ? palette.selected : h.kind === "free"
    ? palette.handle : palette.axes[h.axis]!);
  for (const h of shown.filter((h) => h.kind === "turn")) {
    for (const [width, colour, alpha] of [[5.5, palette.halo, 0.4], [over(h) ? 4 : 2.6, colourOf(h), 0.95]] as const) {
      for (let i = 0; i + 1 < h.path.length; ++i) strokes.line(...h.path[i]!, ...h.path[i + 1]!, width, width, colour,
        alpha);
    }
  }
  for (const h of shown.filter((h) => h.kind === "move")) {
    const [a, b] = [h.path[0]!, h.path[1]!], dx = b[0] - a[0], dy = b[1] - a[1], l = Math.hypot(dx, dy) || 1;
    const head = kArrowHead * Math.min(1, l / 40);
    strokes.line(...a, ...b, 5.5, 5.5, palette.halo, 0.4);
    strokes.line(...a, ...b, over(h) ? 4 : 2.6, over(h) ? 4 : 2.6, colourOf(h), 0.95);
    strokes.line(b[0], b[1], b[0] + dx / l * head, b[1] + dy / l * head, 13, 0, colourOf(h), 1);
  }
  for (const h of shown.filter((h) => h.kind === "plane" || h.kind === "scale" || h.kind === "free")) {
    const [x, y] = h.path[0]!, size = (h.kind === "plane" ? 8 : 11) + (over(h) ? 3 : 0);
    strokes.dot(x, y, size + 3, palette.halo, 0.75);
    strokes.dot(x, y, size, colourOf(h));
    if (h.kind === "scale") strokes.dot(x, y, size - 6, palette.background, 1);
  }
}

function drawDensity(strokes: Strokes, { eye, scene, palette }: OverlayState): void {
  const density = scene.curves?.density;
  if (!density) return;
  const { min, max } = density;
  const corner = (i: number): Vec3 => [i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) {
      if (!(i & bit)) strokes.segment(eye, corner(i), corner(i | bit), 1.8, palette.density, 0.85, 6);
    }
  }
}
