// Curves and their points under the pointer, in pixels.
import type { Curve, Vec3 } from "../api";
import { point, samples } from "./bezier";
import { pathDistance } from "./gizmo";
import { clipped } from "./strokes";
import { project, type Eye } from "./orbit";
import type { V } from "./vec";

export const kPickWidth = 12;
export const kSegments = 32;

/** The curve nearest to a pixel within the pick width. Of two as near, the later one, which is drawn over the other.
 *  `except`: places of curves that cannot be taken. */
export function hitCurve(eye: Eye, curves: readonly Curve[], x: number, y: number, except: readonly number[] = [],
  width = kPickWidth): number | null {
  let best: number | null = null, least = width;
  curves.forEach(({ points }, index) => {
    if (except.includes(index)) return;
    const path = samples(points, kSegments);
    for (let i = 0; i < kSegments; ++i) {
      const s = clipped(eye, path[i]!, path[i + 1]!);
      if (!s) continue;
      const d = pathDistance([[s[0], s[1]], [s[2], s[3]]], x, y);
      if (d <= least) [best, least] = [index, d];
    }
  });
  return best;
}

/** The control point under a pixel: handles win over ends, since ends can also be taken along the curve. */
export function hitPoint(eye: Eye, points: readonly V[], x: number, y: number, width = kPickWidth): number | null {
  let best: number | null = null, least = width;
  for (const index of [1, 2, 0, 3]) {
    const s = project(eye, points[index]!);
    const d = s.depth > 0 ? Math.hypot(s.x - x, s.y - y) : Infinity;
    if (d < least) [best, least] = [index, d];
  }
  return best;
}

/** An end of another curve near a pixel, or (`anywhere`) a place along one: where a bough leaves its trunk. */
export function snapTo(
  eye: Eye, curves: readonly Curve[], except: readonly number[], x: number, y: number, anywhere = false,
  width = kPickWidth): Vec3 | null {
  let best: Vec3 | null = null, least = width;
  curves.forEach(({ points }, index) => {
    if (except.includes(index)) return;
    for (const end of [points[0], points[3]]) {
      const s = project(eye, end), d = s.depth > 0 ? Math.hypot(s.x - x, s.y - y) : Infinity;
      if (d < least) [best, least] = [[...end], d];
    }
  });
  if (best || !anywhere) return best;
  curves.forEach(({ points }, index) => {
    if (except.includes(index)) return;
    for (let i = 0; i <= 96; ++i) {
      const p = point(points, i / 96), s = project(eye, p), d = s.depth > 0 ? Math.hypot(s.x - x, s.y - y) : Infinity;
      if (d < least * 0.6) [best, least] = [p, d / 0.6];
    }
  });
  return best;
}
