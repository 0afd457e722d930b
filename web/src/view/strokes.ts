// Lines, arrow heads and dots of the overlay as one list in pixels: a stroke has two ends, each with its own width, and
// round caps. A dot is a stroke without length, an arrow head one whose far end has no width. Drawn in order, by one
// draw call.
import { clamp } from "./vec";
import type { Rgb } from "./palette";
import { kHalfTan, type Eye } from "./orbit";
import { add, dot, scale, subtract, type V } from "./vec";

export const kStrokeFloats = 12;
const kMost = 20000;

export class Strokes {
  count = 0;
  data = new Float32Array(512 * kStrokeFloats);

  clear(): void {
    this.count = 0;
  }

  /** In pixels from the upper left; widths are diameters. `dash`: length of dashes in pixels, 0: none. */
  line(ax: number, ay: number, bx: number, by: number, wa: number, wb: number, c: Rgb, alpha = 1, dash = 0): void {
    if (this.count >= kMost || !Number.isFinite(ax + ay + bx + by)) return;
    const at = this.count * kStrokeFloats;
    if (at + kStrokeFloats > this.data.length) {
      const larger = new Float32Array(2 * this.data.length);
      larger.set(this.data);
      this.data = larger;
    }
    const d = this.data;
    d[at] = ax; d[at + 1] = ay; d[at + 2] = bx; d[at + 3] = by;
    d[at + 4] = wa; d[at + 5] = wb; d[at + 6] = dash; d[at + 7] = 0;
    d[at + 8] = c[0]; d[at + 9] = c[1]; d[at + 10] = c[2]; d[at + 11] = clamp(alpha, 0, 1);
    ++this.count;
  }

  dot(x: number, y: number, width: number, c: Rgb, alpha = 1): void {
    this.line(x, y, x, y, width, width, c, alpha);
  }

  /** Between points of space; what lies behind the camera is cut off. */
  segment(eye: Eye, a: V, b: V, width: number, c: Rgb, alpha = 1, dash = 0): void {
    const cut = clipped(eye, a, b);
    if (cut) this.line(cut[0], cut[1], cut[2], cut[3], width, width, c, alpha, dash);
  }

  path(eye: Eye, points: readonly V[], width: number, c: Rgb, alpha = 1): void {
    for (let i = 0; i + 1 < points.length; ++i) this.segment(eye, points[i]!, points[i + 1]!, width, c, alpha);
  }
}

/** Both ends in pixels, or nothing where all is behind the camera. */
export function clipped(eye: Eye, a: V, b: V): [number, number, number, number] | null {
  const near = eye.distance * 1e-3;
  let p = subtract(a, eye.position), q = subtract(b, eye.position);
  const pd = -dot(p, eye.back), qd = -dot(q, eye.back);
  if (pd < near && qd < near) return null;
  if (pd < near) p = add(p, scale(subtract(q, p), (near - pd) / (qd - pd)));
  else if (qd < near) q = add(q, scale(subtract(p, q), (near - qd) / (pd - qd)));
  const x = (v: V): number => eye.width / 2 + dot(v,
    eye.right) * eye.height / (2 * kHalfTan * Math.max(-dot(v, eye.back), near));
  const y = (v: V): number => eye.height / 2 - dot(v,
    eye.up) * eye.height / (2 * kHalfTan * Math.max(-dot(v, eye.back), near));
  return [x(p), y(p), x(q), y(q)];
}
