// Cubic Bézier curves: four control points, a parameter from 0 to 1.
import type { Vec3 } from "../api";
import { add, along, distance, scale, subtract, type V } from "./vec";

export type Cubic = readonly [V, V, V, V];

export function point(c: Cubic, t: number): Vec3 {
  const s = 1 - t;
  const a = s * s * s, b = 3 * s * s * t, d = 3 * s * t * t, e = t * t * t;
  return [0, 1, 2].map((i) => a * c[0][i]! + b * c[1][i]! + d * c[2][i]! + e * c[3][i]!) as Vec3;
}

/** First derivative by t. */
export function velocity(c: Cubic, t: number): Vec3 {
  const s = 1 - t;
  return add(
    along(scale(subtract(c[1], c[0]), 3 * s * s), 6 * s * t, subtract(c[2], c[1])),
    scale(subtract(c[3], c[2]), 3 * t * t));
}

export function acceleration(c: Cubic, t: number): Vec3 {
  const first = subtract(along(c[2], -2, c[1]), scale(c[0], -1)),
    last = subtract(along(c[3], -2, c[2]), scale(c[1], -1));
  return along(scale(first, 6 * (1 - t)), 6 * t, last);
}

/** `count` + 1 points at even parameters. */
export function samples(c: Cubic, count: number): Vec3[] {
  return Array.from({ length: count + 1 }, (_, i) => point(c, i / count));
}

/** Length by chords. */
export function arcLength(c: Cubic, count = 32): number {
  const p = samples(c, count);
  let sum = 0;
  for (let i = 0; i < count; ++i) sum += distance(p[i]!, p[i + 1]!);
  return sum;
}

/** Parameter of the point of `c` nearest to `p`: the best of `count` samples, then refined by Newton steps. */
export function nearest(c: Cubic, p: V, count = 24): number {
  let best = 0, least = Infinity;
  for (let i = 0; i <= count; ++i) {
    const d = distance(point(c, i / count), p);
    if (d < least) [best, least] = [i / count, d];
  }
  for (let k = 0; k < 4; ++k) {
    const next = newton(c, p, best);
    const d = distance(point(c, next), p);
    if (d >= least) break;
    [best, least] = [next, d];
  }
  return best;
}

/** One Newton step of t towards the foot of p on the curve, kept within 0..1. */
export function newton(c: Cubic, p: V, t: number): number {
  const off = subtract(point(c, t), p), v = velocity(c, t), a = acceleration(c, t);
  const slope = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + off[0] * a[0] + off[1] * a[1] + off[2] * a[2];
  if (!(Math.abs(slope) > 1e-12)) return t;
  const next = t - (off[0] * v[0] + off[1] * v[1] + off[2] * v[2]) / slope;
  return Math.min(Math.max(next, 0), 1);
}
