// Small vectors as plain triples, and the 3x3 matrices of turned frames (three columns).
import type { Vec3 } from "../api";

export type V = Readonly<Vec3>;
export type Columns = readonly [V, V, V];

export const add = (a: V, b: V): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: V, b: V): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: V, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
/** a + s b */
export const along = (a: V, s: number, b: V): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const mix = (a: V, b: V, t: number): Vec3 => along(a, t, subtract(b, a));
export const dot = (a: V, b: V): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: V, b: V): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: V): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: V, b: V): number => length(subtract(a, b));

/** Of length 1; `otherwise` where `a` has none. */
export function unit(a: V, otherwise: V = [0, 1, 0]): Vec3 {
  const l = length(a);
  return l > 0 && Number.isFinite(l) ? scale(a, 1 / l) : [...otherwise];
}

/** A direction across `a`. */
export function across(a: V): Vec3 {
  return unit(Math.abs(a[1]) < 0.9 * length(a) ? cross(a, [0, 1, 0]) : cross(a, [1, 0, 0]));
}

/** Column-wise product m * v. */
export const times = (m: Columns, v: V): Vec3 => add(add(scale(m[0], v[0]), scale(m[1], v[1])), scale(m[2], v[2]));

/** `v` turned about `axis` (of length 1), radians, right-handed. */
export function turn(v: V, axis: V, angle: number): Vec3 {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(along(scale(v, c), s, cross(axis, v)), scale(axis, dot(axis, v) * (1 - c)));
}

/** Numbers to six digits after the point: what goes into the document, short and without noise. */
export const tidy = (x: number): number => Math.round(x * 1e6) / 1e6 + 0;
export const tidy3 = (v: V): Vec3 => [tidy(v[0]), tidy(v[1]), tidy(v[2])];

export const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);

/** A box that grows; empty while min > max. */
export interface Box {
  min: Vec3;
  max: Vec3;
}

export const emptyBox = (): Box => ({ min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] });
export const isEmpty = (box: Box): boolean => !(box.min[0] <= box.max[0] && box.min[1] <= box.max[1] &&
  box.min[2] <= box.max[2]);

/** Points that are not finite are left out. */
export function grow(box: Box, p: V): void {
  if (!Number.isFinite(p[0] + p[1] + p[2])) return;
  for (let i = 0; i < 3; ++i) {
    box.min[i] = Math.min(box.min[i]!, p[i]!);
    box.max[i] = Math.max(box.max[i]!, p[i]!);
  }
}

export function join(box: Box, other: Box): void {
  if (isEmpty(other)) return;
  grow(box, other.min);
  grow(box, other.max);
}
