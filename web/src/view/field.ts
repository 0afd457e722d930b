// The vector field that curves make: on a grid around them, the direction of the nearest curve where it is nearest.
import type { Curve } from "../api";
import { newton, point, samples, velocity, type Cubic } from "./bezier";
import { distance, emptyBox, grow, isEmpty, unit } from "./vec";

/** Per place of the grid 7 floats: where, direction, and strength 0..1, which falls with the distance from the
 *  curve. */
export const kFieldFloats = 7;
const kSamples = 16;

/** About `places` places altogether, fewer than 24 along a side. Empty without curves. */
export function fieldOf(curves: readonly Curve[], places = 2400): Float32Array {
  const box = emptyBox();
  for (const curve of curves) for (const p of samples(curve.points, 12)) grow(box, p);
  if (isEmpty(box)) return new Float32Array(0);
  const longest = Math.max(...[0, 1, 2].map((i) => box.max[i]! - box.min[i]!), 1e-6), margin = 0.25 * longest;
  const sides = [0, 1, 2].map((i) => box.max[i]! - box.min[i]! + 2 * margin);
  const cell = Math.max(Math.cbrt(sides[0]! * sides[1]! * sides[2]! / places), Math.max(...sides) / 24);
  const counts = sides.map((s) => Math.max(1, Math.round(s / cell)));
  // All curves as points, to see which part of which curve is nearest; Newton steps do the rest.
  const near = new Float64Array(curves.length * (kSamples + 1) * 3);
  curves.forEach((curve, c) => samples(curve.points, kSamples).forEach((p, i) => near.set(p,
    3 * (c * (kSamples + 1) + i))));
  const result = new Float32Array(counts[0]! * counts[1]! * counts[2]! * kFieldFloats);
  let at = 0;
  for (let i = 0; i < counts[0]!; ++i) {
    for (let j = 0; j < counts[1]!; ++j) {
      for (let k = 0; k < counts[2]!; ++k) {
        const p = [i, j, k].map((n, axis) => box.min[axis]! - margin + (n + 0.5) * sides[axis]! / counts[axis]!) as
          [number, number, number];
        let best = 0, least = Infinity;
        for (let n = 0; n < near.length; n += 3) {
          const x = near[n]! - p[0], y = near[n + 1]! - p[1], z = near[n + 2]! - p[2], d = x * x + y * y + z * z;
          if (d < least) [best, least] = [n / 3, d];
        }
        const curve: Cubic = curves[Math.floor(best / (kSamples + 1))]!.points;
        const t = newton(curve, p, newton(curve, p, (best % (kSamples + 1)) / kSamples));
        const away = distance(point(curve, t), p) / cell;
        result.set([...p, ...unit(velocity(curve, t)), Math.exp(-0.09 * away * away)], at);
        at += kFieldFloats;
      }
    }
  }
  return result;
}

/** Length of a field's lines, for the grid that fieldOf made: what is between two places. */
export function spacing(field: Float32Array): number {
  return field.length >= 2 * kFieldFloats ? Math.abs(field[kFieldFloats + 2]! - field[2]!) || 0.2 : 0.2;
}
