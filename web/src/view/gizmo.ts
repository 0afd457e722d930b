// Handles of a volume's mesh: arrows move along its axes, small marks between two of them in their plane, the middle in
// the plane of the screen; knobs scale, quarter rings turn. All sizes are in pixels. Axes point to the half towards the
// viewer.
import type { Vec3 } from "../api";
import { atDepth, depthOf, pixelSize, project, rayThrough, type Eye } from "./orbit";
import { axesOf, kLeastScale, rotated, type Placing } from "./placing";
import { add, along, cross, dot, scale, subtract, type V } from "./vec";

export type GizmoKind = "move" | "plane" | "free" | "scale" | "turn";

export interface GizmoHandle {
  kind: GizmoKind;
  /** Of move, scale and turn: along or about it; of plane: across it. */
  axis: 0 | 1 | 2;
  /** In pixels: what is drawn and hit, one point or a path. */
  path: [number, number][];
  /** Hardly seen, since its axis points at the viewer: not to be taken. */
  faint: boolean;
}

export const kArrow = 74, kArrowHead = 15, kKnob = 108, kRing = 60, kPlane = 26;
const kReach = 9;

/** Directions of the mesh's axes, turned towards the viewer. */
function outward(eye: Eye, p: Placing): readonly Vec3[] {
  const to = subtract(eye.position, p.position);
  return axesOf(p.rotation_deg).map((a) => scale(a, dot(a, to) < 0 ? -1 : 1));
}

/** All handles, nearest meaning first; none where the mesh is behind the camera. */
export function gizmoHandles(eye: Eye, p: Placing): GizmoHandle[] {
  const depth = depthOf(eye, p.position);
  if (!(depth > eye.distance * 1e-3)) return [];
  const pixel = pixelSize(eye, depth), axes = outward(eye, p);
  const at = (v: V): [number, number] => { const s = project(eye, v); return [s.x, s.y]; };
  const towards = (axis: number, pixels: number): Vec3 => along(p.position, pixels * pixel, axes[axis]!);
  const handles: GizmoHandle[] = [{ kind: "free", axis: 0, path: [at(p.position)], faint: false }];
  for (const axis of [0, 1, 2] as const) {
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3] as const;
    const shown = Math.hypot(...subtract2(at(towards(axis, 100)), at(p.position)));
    const faint = shown < 22;
    handles.push({ kind: "scale", axis, path: [at(towards(axis, kKnob))], faint });
    handles.push({ kind: "move", axis, path: [at(towards(axis, 14)), at(towards(axis, kArrow))], faint });
    const seen = Math.abs(dot(axes[axis]!, eye.back));
    handles.push({
      kind: "plane", axis, faint: seen < 0.15,
      path: [at(add(towards(u, kPlane), scale(axes[v]!, kPlane * pixel)))],
    });
    handles.push({
      kind: "turn", axis, faint: seen < 0.08,
      path: Array.from({ length: 13 }, (_, i) => {
        const angle = Math.PI / 2 * (0.12 + 0.76 * i / 12);
        return at(along(towards(u, kRing * Math.cos(angle)), kRing * Math.sin(angle) * pixel, axes[v]!));
      }),
    });
  }
  return handles;
}

const subtract2 = (a: readonly [number, number], b: readonly [number, number]): [number, number] =>
  [a[0] - b[0], a[1] - b[1]];

/** Distance of a pixel from a path in pixels. */
export function pathDistance(path: readonly (readonly [number, number])[], x: number, y: number): number {
  let least = Infinity;
  for (let i = 0; i < path.length; ++i) {
    const a = path[i]!, b = path[i + 1] ?? a;
    const dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const t = square > 0 ? Math.min(Math.max(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0), 1) : 0;
    least = Math.min(least, Math.hypot(x - a[0] - t * dx, y - a[1] - t * dy));
  }
  return least;
}

export function hitGizmo(handles: readonly GizmoHandle[], x: number, y: number): GizmoHandle | null {
  let best: GizmoHandle | null = null, least = kReach;
  for (const handle of handles) {
    const d = handle.faint ? Infinity : pathDistance(handle.path, x, y);
    if (d < least) [best, least] = [handle, d];
  }
  return best;
}

/** Where a ray through a pixel meets the plane through `at` across `normal`; nothing where it runs along it. */
export function onPlane(eye: Eye, x: number, y: number, at: V, normal: V): Vec3 | null {
  const { origin, direction } = rayThrough(eye, x, y);
  const slope = dot(direction, normal);
  if (Math.abs(slope) < 0.02) return null;
  const t = dot(subtract(at, origin), normal) / slope;
  return t > 0 ? along(origin, t, direction) : null;
}

/** Metres along a direction at `at` that a movement of pixels means, as it looks on the screen. */
export function metresAlong(eye: Eye, at: V, direction: V, dx: number, dy: number): number {
  const step = pixelSize(eye, depthOf(eye, at)) * 50;
  const a = project(eye, at), b = project(eye, along(at, step, direction));
  const [vx, vy] = [(b.x - a.x) / step, (b.y - a.y) / step], square = vx * vx + vy * vy;
  return square > 1e-9 ? (dx * vx + dy * vy) / square : 0;
}

/** What a drag from one pixel to another makes of the placing. `snap`: turns in steps of 15 degrees, scales evenly. */
export function dragGizmo(
  eye: Eye, start: Placing, handle: Pick<GizmoHandle, "kind" | "axis">, from: V2, to: V2, snap: boolean): Placing {
  const axes = outward(eye, start), axis = axes[handle.axis]!;
  const dx = to[0] - from[0], dy = to[1] - from[1], pixel = pixelSize(eye, depthOf(eye, start.position));
  if (handle.kind === "free") {
    const depth = depthOf(eye, start.position);
    const by = subtract(atDepth(eye, ...to, depth), atDepth(eye, ...from, depth));
    return { ...start, position: add(start.position, by) };
  }
  if (handle.kind === "move") {
    return { ...start, position: along(start.position, metresAlong(eye, start.position, axis, dx, dy), axis) };
  }
  if (handle.kind === "plane") {
    const a = onPlane(eye, ...from, start.position, axis), b = onPlane(eye, ...to, start.position, axis);
    return a && b ? { ...start, position: add(start.position, subtract(b, a)) } : start;
  }
  if (handle.kind === "scale") {
    const factor = Math.max(1 + metresAlong(eye, start.position, axis, dx, dy) / (kKnob * pixel), 1e-3);
    const grown = (s: number): number => Math.sign(s || 1) * Math.max(Math.abs(s) * factor, kLeastScale);
    return { ...start, scale: start.scale.map((s, i) => (snap || i === handle.axis ? grown(s) : s)) as Vec3 };
  }
  let angle = turnAngle(eye, start.position, axis, from, to);
  if (snap) angle = Math.round(angle / (Math.PI / 12)) * (Math.PI / 12);
  return rotated(start, axis, angle);
}

export type V2 = readonly [number, number];

/** Angle about `axis` from one pixel to another, radians. A ring seen from its edge turns by distance along it. */
export function turnAngle(eye: Eye, centre: V, axis: V, from: V2, to: V2): number {
  const a = onPlane(eye, ...from, centre, axis), b = onPlane(eye, ...to, centre, axis);
  if (a && b && Math.abs(dot(axis, eye.back)) > 0.15) {
    const u = subtract(a, centre), v = subtract(b, centre);
    return Math.atan2(dot(cross(u, v), axis), dot(u, v));
  }
  const on = project(eye, centre), tip = project(eye, along(centre, pixelSize(eye, depthOf(eye, centre)) * 50, axis));
  const [ax, ay] = [tip.x - on.x, tip.y - on.y], l = Math.hypot(ax, ay);
  return l > 0 ? ((to[0] - from[0]) * -ay + (to[1] - from[1]) * ax) / l / kRing : 0;
}
