// A stroke as ONE cubic: least squares over both handles, the ends staying where the stroke begins and ends. Parameters
// start as chord lengths and are moved to the feet of the points on the curve by Newton steps (Schneider, Graphics Gems
// I, without his fixed tangents: a hand's first pixels say little of direction). That alone creeps along loops, so it
// is followed by Gauss-Newton steps in which points may slide along the curve (tangent distance minimisation, Wang et
// al. 2006), damped, and taken only where they help. At most kMostPoints points and some dozens of rounds: a few
// milliseconds.
import type { Vec3 } from "../api";
import { newton, point, velocity, type Cubic } from "./bezier";
import { along, distance, mix, scale, subtract, add, dot, length, unit, type V } from "./vec";

const kRounds = 24, kSteps = 40;
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
  const reach = 2 * total, done = 1e-16 * total * total;
  let best: Fit = { curve: straight, t, error: Infinity };
  for (let round = 0; round < kRounds && best.error > done; ++round) {
    const inner = points.length > 3 ? handles(points, t) : null;
    const curve = inner ? tame([first, inner[0], inner[1], last], reach) : straight;
    const fit = footed(curve, points, t);
    if (fit.error < best.error) best = fit;
    if (!inner) break;
    t = fit.t;
  }
  for (let step = 0, damping = 1e-3; step < kSteps && best.error > done && damping < 1e6; ++step) {
    const move = slide(points, best.t, best.curve, damping);
    if (!move) break;
    const curve = tame([first, add(best.curve[1], move[0]), add(best.curve[2], move[1]), last], reach);
    const fit = footed(curve, points, footed(curve, points, best.t).t);
    const better = fit.error < best.error;
    if (better) best = fit;
    damping = better ? damping / 5 : damping * 8;
  }
  return best.curve.map((p) => [...p]) as [Vec3, Vec3, Vec3, Vec3];
}

interface Fit {
  curve: Cubic;
  t: number[];
  error: number;
}

/** Parameters moved towards the feet of the points, in order: a loop may not jump from one of its arms to the other. */
function footed(curve: Cubic, points: readonly V[], t: readonly number[]): Fit {
  const moved = t.map((u, i) => newton(curve, points[i]!, u));
  moved[0] = 0;
  moved[moved.length - 1] = 1;
  let error = 0;
  for (let i = 0; i < moved.length; ++i) {
    if (i > 0) moved[i] = Math.max(moved[i]!, moved[i - 1]!);
    const off = subtract(point(curve, moved[i]!), points[i]!);
    error += dot(off, off);
  }
  return { curve, t: moved, error };
}

/** How both handles shall move so that the distances of the points across the curve become least. */
function slide(points: readonly V[], t: readonly number[], curve: Cubic, damping: number): [Vec3, Vec3] | null {
  // Six unknowns; each row ends with its right side.
  const rows = Array.from({ length: 6 }, () => new Float64Array(7));
  for (let i = 1; i + 1 < points.length; ++i) {
    const u = t[i]!, s = 1 - u, weights = [3 * s * s * u, 3 * s * u * u];
    const tangent = unit(velocity(curve, u), [0, 0, 0]), off = subtract(points[i]!, point(curve, u));
    for (let r = 0; r < 6; ++r) {
      const row = rows[r]!, axis = r % 3, weight = weights[r < 3 ? 0 : 1]!, slope = tangent[axis]!;
      for (let c = 0; c < 6; ++c) {
        row[c]! += weight * weights[c < 3 ? 0 : 1]! * ((axis === c % 3 ? 1 : 0) - slope * tangent[c % 3]!);
      }
      row[6]! += weight * (off[axis]! - slope * dot(tangent, off));
    }
  }
  for (let r = 0; r < 6; ++r) rows[r]![r]! += damping * (rows[r]![r]! + 1e-6);
  const x = solve(rows);
  return x && [[x[0]!, x[1]!, x[2]!], [x[3]!, x[4]!, x[5]!]];
}

/** Gauss with pivots; nothing where there is no one answer. */
function solve(rows: Float64Array[]): number[] | null {
  const n = rows.length;
  for (let k = 0; k < n; ++k) {
    let pivot = k;
    for (let r = k + 1; r < n; ++r) if (Math.abs(rows[r]![k]!) > Math.abs(rows[pivot]![k]!)) pivot = r;
    [rows[k], rows[pivot]] = [rows[pivot]!, rows[k]!];
    if (!(Math.abs(rows[k]![k]!) > 1e-14)) return null;
    for (let r = k + 1; r < n; ++r) {
      const factor = rows[r]![k]! / rows[k]![k]!;
      for (let c = k; c <= n; ++c) rows[r]![c]! -= factor * rows[k]![c]!;
    }
  }
  const x = new Array<number>(n).fill(0);
  for (let k = n - 1; k >= 0; --k) {
    let sum = rows[k]![n]!;
    for (let c = k + 1; c < n; ++c) sum -= rows[k]![c]! * x[c]!;
    x[k] = sum / rows[k]![k]!;
  }
  return x.every(Number.isFinite) ? x : null;
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
