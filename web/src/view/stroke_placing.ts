// Where a drawn stroke lies in space, and how thick it is.
import type { Vec3 } from "../api";
import { atDepth, depthOf, pixelSize, type Eye } from "./orbit";
import type { V } from "./vec";

export interface Ink {
  x: number;
  y: number;
  /** 0..1; of a mouse always 0.5. */
  pressure: number;
}

/** Where an end is held: at a point of space (snapped, or on a surface). */
export interface Anchor {
  point: V;
}

/** Depths change evenly along the stroke from where it starts to where it ends; an end that is held by nothing has
 *  the depth of the  other, and a stroke that is held nowhere lies at the target's. `surface` says what lies under a
 *  pixel: a stroke that starts,  ends and runs on a surface lies on it. */
export function placeStroke(
  eye: Eye, ink: readonly Ink[], start: Anchor | null, end: Anchor | null,
  surface: ((x: number, y: number) => V | null) | null): Vec3[] {
  if (ink.length === 0) return [];
  const near = eye.distance * 0.01;
  const depth = (anchor: Anchor | null): number | null => {
    const d = anchor ? depthOf(eye, anchor.point) : 0;
    return d > near ? d : null;
  };
  const first = depth(start) ?? depth(end) ?? eye.distance, last = depth(end) ?? depth(start) ?? eye.distance;
  const lengths = [0];
  for (let i = 1; i < ink.length; ++i) {
    lengths.push(lengths[i - 1]! + Math.hypot(ink[i]!.x - ink[i - 1]!.x, ink[i]!.y - ink[i - 1]!.y));
  }
  const total = lengths[lengths.length - 1]! || 1;
  const on = start && end && surface ? surfaceDepths(eye, ink, lengths, surface) : null;
  const placed = ink.map(({ x, y }, i) => {
    const t = lengths[i]! / total;
    return atDepth(eye, x, y, on ? on(t) : first + (last - first) * t);
  });
  if (start) placed[0] = [...start.point];
  if (end) placed[placed.length - 1] = [...end.point];
  return placed;
}

const kProbes = 17;

/** Depth along the stroke where at least four of five probes meet the surface; those that miss take their
 *  neighbours'. */
function surfaceDepths(
  eye: Eye, ink: readonly Ink[], lengths: readonly number[],
  surface: (x: number, y: number) => V | null): ((t: number) => number) | null {
  const total = lengths[lengths.length - 1]!;
  const depths: (number | null)[] = [];
  let at = 0;
  for (let k = 0; k < kProbes; ++k) {
    while (at < ink.length - 1 && lengths[at]! < total * k / (kProbes - 1)) ++at;
    const p = surface(ink[at]!.x, ink[at]!.y);
    depths.push(p ? depthOf(eye, p) : null);
  }
  const known = depths.flatMap((d, k) => (d === null ? [] : [[k, d] as const]));
  if (known.length < 0.8 * kProbes) return null;
  return (t) => {
    const k = t * (kProbes - 1);
    let low = known[0]!, high = known[known.length - 1]!;
    for (const entry of known) {
      if (entry[0] <= k) low = entry;
      if (entry[0] >= k) { high = entry; break; }
    }
    return high[0] > low[0] ? low[1] + (high[1] - low[1]) * Math.min(Math.max((k - low[0]) / (high[0] - low[0]), 0), 1)
      : low[1];
  };
}

/** Radii at both ends for a pen's pressure: a thirtieth of the picture's height at full pressure, nothing below a
 *  tenth of it. */
export function penThickness(eye: Eye, ink: readonly Ink[], depth: number): [number, number] {
  const third = Math.max(1, Math.floor(ink.length / 3)), full = pixelSize(eye, depth) * eye.height / 30;
  const mean = (part: readonly Ink[]): number => part.reduce((sum, p) => sum + p.pressure, 0) / part.length;
  const radius = (pressure: number): number => full * Math.max(0, (pressure - 0.1) / 0.9);
  return [radius(mean(ink.slice(0, third))), radius(mean(ink.slice(-third)))];
}
