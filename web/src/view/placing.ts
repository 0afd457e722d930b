// Where a volume's mesh stands: position + turn * (scale * p), the turn about x, then y, then z (docs/scenes.md).
import type { Vec3, VolumeMesh } from "../api";
import { add, clamp, cross, dot, scale, subtract, turn, type Columns, type V } from "./vec";

export interface Placing {
  readonly position: V;
  readonly scale: V;
  readonly rotation_deg: V;
}

export const kLeastScale = 1e-3;

export const placingOf = (mesh: VolumeMesh): Placing => ({
  position: mesh.position ?? [0, 0, 0], scale: mesh.scale ?? [1, 1, 1], rotation_deg: mesh.rotation_deg ?? [0, 0, 0],
});

const kAxes: Columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const kRadians = Math.PI / 180;

/** The turned axes. */
export function axesOf(rotation_deg: V): Columns {
  return kAxes.map((axis) =>
    kAxes.reduce<V>((v, about, i) => turn(v, about, rotation_deg[i]! * kRadians), axis)) as unknown as Columns;
}

/** Angles whose turn has these axes. At +-90 degrees about y, z is 0. */
export function anglesOf(axes: Columns): Vec3 {
  // With R = Rz Ry Rx: R's first column is (cz cy, sz cy, -sy), its last row (-sy, cy sx, cy cx).
  const y = Math.asin(clamp(-axes[0][2], -1, 1));
  const flat = Math.hypot(axes[0][0], axes[0][1]);
  const x = flat > 1e-6 ? Math.atan2(axes[1][2], axes[2][2]) : Math.atan2(-axes[2][1], axes[1][1]);
  const z = flat > 1e-6 ? Math.atan2(axes[0][1], axes[0][0]) : 0;
  return [x / kRadians, y / kRadians, z / kRadians];
}

/** The placing turned by an angle (radians) about a direction of length 1, in place. */
export function rotated(p: Placing, axis: V, angle: number): Placing {
  const axes = axesOf(p.rotation_deg).map((a) => turn(a, axis, angle)) as unknown as Columns;
  return { ...p, rotation_deg: anglesOf(axes) };
}

/** Columns of turn * scale. */
export function basisOf(p: Placing): Columns {
  const axes = axesOf(p.rotation_deg);
  return [scale(axes[0], p.scale[0]), scale(axes[1], p.scale[1]), scale(axes[2], p.scale[2])];
}

export function place(p: Placing, v: V): Vec3 {
  const m = basisOf(p);
  return add(p.position, add(add(scale(m[0], v[0]), scale(m[1], v[1])), scale(m[2], v[2])));
}

/** A ray in the mesh's own space: t stays what it was, since the direction is not made unit again. */
export function rayInto(p: Placing, origin: V, direction: V): { origin: Vec3; direction: Vec3 } | null {
  const m = basisOf(p), determinant = dot(m[0], cross(m[1], m[2]));
  if (!(Math.abs(determinant) > 0)) return null;
  const rows = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
  const into = (v: V): Vec3 => rows.map((row) => dot(row, v) / determinant) as Vec3;
  return { origin: into(subtract(origin, p.position)), direction: into(direction) };
}
