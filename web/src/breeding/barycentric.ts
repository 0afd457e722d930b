// A point on a triangle, or on a line between two, as weights of its corners.

export interface Point {
  x: number;
  y: number;
}

/** Places of the corners in a square of side 1, y downwards: a triangle that stands on a side, or a line. */
export function corners(count: number): Point[] {
  return count === 3 ? [{ x: 0.5, y: 0.07 }, { x: 0.04, y: 0.87 }, { x: 0.96, y: 0.87 }] : [{ x: 0.04, y: 0.5 }, { x: 0.96, y: 0.5 }];
}

export function pointOf(weights: readonly number[], at: readonly Point[]): Point {
  const sum = weights.reduce((a, b) => a + b, 0) || 1;
  return at.reduce((p, c, i) => ({ x: p.x + c.x * weights[i]! / sum, y: p.y + c.y * weights[i]! / sum }), { x: 0, y: 0 });
}

/** Of the point of the triangle (or line) that is nearest to `p`: none below 0, in sum 1. */
export function weightsAt(p: Point, at: readonly Point[]): number[] {
  if (at.length === 2) {
    const t = along(p, at[0]!, at[1]!);
    return [1 - t, t];
  }
  const [a, b, c] = at as [Point, Point, Point];
  const area = cross(a, b, c);
  const weights = [cross(p, b, c) / area, cross(a, p, c) / area, cross(a, b, p) / area];
  if (weights.every((weight) => weight >= 0)) return weights;
  // Outside: the nearest point of the three sides.
  let best = [1, 0, 0], least = Infinity;
  for (const [i, k] of [[0, 1], [1, 2], [2, 0]] as const) {
    const t = along(p, at[i]!, at[k]!);
    const near = { x: at[i]!.x + t * (at[k]!.x - at[i]!.x), y: at[i]!.y + t * (at[k]!.y - at[i]!.y) };
    const away = Math.hypot(p.x - near.x, p.y - near.y);
    if (away >= least) continue;
    least = away;
    best = [0, 0, 0];
    best[i] = 1 - t;
    best[k] = t;
  }
  return best;
}

/** Weights after `step` of one corner's weight more (or less), the others in their proportion. */
export function nudged(weights: readonly number[], corner: number, step: number): number[] {
  const own = Math.min(1, Math.max(0, weights[corner]! + step));
  const rest = weights.reduce((sum, weight, i) => (i === corner ? sum : sum + weight), 0);
  return weights.map((weight, i) => (i === corner ? own : rest > 1e-9 ? weight / rest * (1 - own) : (1 - own) / (weights.length - 1)));
}

/** Share of the way from a to b, 0..1. */
function along(p: Point, a: Point, b: Point): number {
  const x = b.x - a.x, y = b.y - a.y;
  return Math.min(1, Math.max(0, ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y)));
}

function cross(a: Point, b: Point, c: Point): number {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
