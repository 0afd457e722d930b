// The small cross of axes in the lower left corner, with letters made of strokes. A click on an arm looks from that
// side.
import type { Side } from "./host";
import type { Eye } from "./orbit";
import type { Palette } from "./palette";
import type { Strokes } from "./strokes";

const kArm = 30, kCorner = 50, kButton = 9;

interface Arm {
  side: Side;
  axis: number;
  positive: boolean;
  x: number;
  y: number;
  depth: number;
}

/** From furthest to nearest. */
export function gnomonArms(eye: Eye): Arm[] {
  const arms: Arm[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const positive of [true, false]) {
      const s = positive ? kArm : -kArm;
      arms.push({
        side: `${positive ? "+" : "-"}${"xyz"[axis]}` as Side, axis, positive,
        x: kCorner + s * eye.right[axis]!, y: eye.height - kCorner - s * eye.up[axis]!, depth: -s * eye.back[axis]!,
      });
    }
  }
  return arms.sort((a, b) => b.depth - a.depth);
}

export function hitGnomon(eye: Eye, x: number, y: number): Side | null {
  const near = gnomonArms(eye).filter((arm) => Math.hypot(arm.x - x, arm.y - y) < kButton);
  return near.length > 0 ? near[near.length - 1]!.side : null;
}

/** Letters in a square from -1 to 1, y downwards. */
const kLetters = [
  [[-1, -1, 1, 1], [1, -1, -1, 1]],
  [[-1, -1, 0, 0], [1, -1, 0, 0], [0, 0, 0, 1]],
  [[-1, -1, 1, -1], [1, -1, -1, 1], [-1, 1, 1, 1]],
] as const;

export function drawGnomon(strokes: Strokes, eye: Eye, palette: Palette, hovered: Side | null): void {
  const y0 = eye.height - kCorner;
  for (const { axis, positive, x, y, side, depth } of gnomonArms(eye)) {
    const colour = palette.axes[axis]!, alpha = 0.75 - 0.25 * (depth / kArm), size = side === hovered ? 21 : 17;
    if (positive) {
      strokes.line(kCorner, y0, x, y, 2.5, 2.5, colour, alpha);
      strokes.dot(x, y, size, colour, Math.min(1, alpha + 0.25));
      for (const [ax, ay, bx, by] of kLetters[axis]!) {
        strokes.line(x + 2.8 * ax, y + 3.4 * ay, x + 2.8 * bx, y + 3.4 * by, 1.7, 1.7, palette.background, 1);
      }
    } else {
      strokes.dot(x, y, size - 3, colour, 0.35 * alpha);
      strokes.dot(x, y, size - 7, palette.background, 0.65);
    }
  }
}
