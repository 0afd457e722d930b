// A stroke as ONE cubic: least squares over both handles, the ends staying where the stroke begins and ends. Parameters start
// as chord lengths and are moved to the feet of the points on the curve by Newton steps (Schneider, Graphics Gems I, without
// his fixed tangents: a hand's first pixels say little of direction). At most kRounds rounds over kMostPoints points: under a
// millisecond.
import type { Vec3 } from "../api";
import { newton, point, type Cubic } from "./bezier";
import { along, distance, mix, scale, subtract, add, dot, length, type V } from "./vec";

const kRounds = 200;
const kMostPoints = 96;

/** Points at even distances along the stroke, at most `most`, the ends included. */
export function resample(stroke: readonly V[], most: number): Vec3[] {
  const ends: number[] = [0];
  for (let i = 1; i < stroke.length; ++i) ends.push(ends[i - 1]! + distance(stroke[i - 1]!, stroke[i]!));
  const total = ends[ends.length - 1]!;
  if (stroke.length <= most || !(total > 0)) return stroke.map((p) => [...p] as Vec3);
  const result: Vec3[] = [];
  let i = 1;
  for (let k = 0; k < most; ++k) {
    const wanted = total * k / (most - 1);
    while (i < stroke.length - 1 && ends[i]! < wanted) ++i;
    const span = ends[i]! - ends[i - 1]!;
    result.push(mix(stroke[i - 1]!, stroke[i]!, span > 0 ? Math.min((wanted - ends[i - 1]!) / span, 1) : 0));
  }
  return result;
}

/** Handles for given parameters, or nothing where the system has no one answer. */
function handles(points: readonly V[], t: readonly number[]): [Vec3, Vec3] | null {
  const first = points[0]!, last = points[points.length - 1]!;
  let aa = 0, ab = 0, bb = 0;
  let ra: Vec3 = [0, 0, 0], rb: Vec3 = [0, 0, 0];
  for (let i = 0; i < points.length; ++i) {
    const u = t[i]!, s = 1 - u;
    const a = 3 * s * s * u, b = 3 * s * u * u;
    const rest = subtract(points[i]!, add(scale(first, s * s * s + a), scale(last, u * u * u + b)));
    // Unknowns are the handles as seen from the nearer end.
    aa += a * a; ab += a * b; bb += b * b;
    ra = along(ra, a, rest);
    rb = along(rb, b, rest);
  }
  const determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-9 * aa * bb)) return null;
  const one = scale(subtract(scale(ra, bb), scale(rb, ab)), 1 / determinant);
  const two = scale(subtract(scale(rb, aa), scale(ra, ab)), 1 / determinant);
  return [add(first, one), add(last, two)];
}

/** Handles no further from their ends than twice the stroke is long: a scribble does not throw them away. */
function tame(c: Cubic, reach: number): Cubic {
  const pull = (end: V, handle: V): V => {
    const off = subtract(handle, end), l = length(off);
    return l > reach ? along(end, reach / l, off) : handle;
  };
  return [c[0], pull(c[0], c[1]), pull(c[3], c[2]), c[3]];
}

/** The cubic through a stroke, or nothing where the stroke is a point. */
export function fitCubic(stroke: readonly V[]): [Vec3, Vec3, Vec3, Vec3] | null {
  const finite = stroke.filter((p) => Number.isFinite(p[0] + p[1] + p[2]));
  const distinct = finite.filter((p, i) => i === 0 || distance(p, finite[i - 1]!) > 0);
  if (distinct.length < 2) return null;
  const points = resample(distinct, kMostPoints);
  const first = points[0]!, last = points[points.length - 1]!;
  const lengths = [0];
  for (let i = 1; i < points.length; ++i) lengths.push(lengths[i - 1]! + distance(points[i - 1]!, points[i]!));
  const total = lengths[lengths.length - 1]!;
  let t = lengths.map((l) => l / total);
  const straight: Cubic = [first, mix(first, last, 1 / 3), mix(first, last, 2 / 3), last];
  const errorOf = (c: Cubic, at: readonly number[]): number =>
    points.reduce((sum, p, i) => { const d = subtract(point(c, at[i]!), p); return sum + dot(d, d); }, 0);
  let best: Cubic = straight, least = Infinity;
  for (let round = 0; round < kRounds; ++round) {
    const inner = points.length > 3 ? handles(points, t) : null;
    const curve: Cubic = inner ? tame([first, inner[0], inner[1], last], 2 * total) : straight;
    const error = errorOf(curve, t);
    if (error < least) best = curve;
    if (!inner || !(error < least * (1 - 1e-7)) || error < 1e-18 * total * total) break;
    least = error;
    const moved = t.map((u, i) => newton(curve, points[i]!, u));
    moved[0] = 0;
    moved[moved.length - 1] = 1;
    // Order is kept: a loop may not jump from one of its arms to the other.
    for (let i = 1; i < moved.length; ++i) moved[i] = Math.max(moved[i]!, moved[i - 1]!);
    t = moved;
  }
  return best.map((p) => [...p]) as [Vec3, Vec3, Vec3, Vec3];
}

/** Largest distance of the points from the curve, for tests and for deciding whether a stroke was a click. */
export function worst(c: Cubic, points: readonly V[], count = 200): number {
  let most = 0;
  for (const p of points) {
    let least = Infinity;
    for (let i = 0; i <= count; ++i) least = Math.min(least, distance(point(c, i / count), p));
    most = Math.max(most, least);
  }
  return most;
}
