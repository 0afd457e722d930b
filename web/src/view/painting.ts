// A silhouette as strokes of brushes, and what it looks like on a canvas: as it is seen while painting (blue wanted,
// vermilion and dotted to be left free) and as the image that is scored (black, white, transparent).
import type { Brush } from "./host";

export interface Dab {
  brush: Brush;
  radius: number;
  points: [number, number][];
}

/** How a brush draws: what is used of a 2D context. */
export type Paper = Pick<CanvasRenderingContext2D,
  "clearRect" | "beginPath" | "moveTo" | "lineTo" | "arc" | "stroke" | "fill" | "lineWidth" | "lineCap" | "lineJoin" |
  "strokeStyle" |
  "fillStyle" | "globalCompositeOperation" | "setTransform">;

export interface Inks {
  want: string | CanvasPattern;
  avoid: string | CanvasPattern;
}

export const kImageInks: Inks = { want: "#000000", avoid: "#ffffff" };
const kLongestSide = 1024;

/** Pixels of the image for a view: its own, at most kLongestSide along the longer side. */
export function imageSize(width: number, height: number): { width: number; height: number; scale: number } {
  const scale = Math.min(1, kLongestSide / Math.max(width, height, 1));
  return { width: Math.max(1, Math.round(width * scale)), height: Math.max(1, Math.round(height * scale)), scale };
}

/** Draws one dab from its point `from` on. Inks are opaque: a brush takes the place of what was there. */
export function drawDab(paper: Paper, dab: Dab, inks: Inks, from = 0): void {
  const points = dab.points.slice(Math.max(0, from - 1));
  if (points.length === 0) return;
  paper.globalCompositeOperation = dab.brush === "erase" ? "destination-out" : "source-over";
  paper.strokeStyle = paper.fillStyle = dab.brush === "erase" ? "#000000" : inks[dab.brush];
  paper.lineWidth = 2 * dab.radius;
  paper.lineCap = paper.lineJoin = "round";
  paper.beginPath();
  const [x, y] = points[0]!;
  if (points.length === 1) {
    paper.arc(x, y, dab.radius, 0, 2 * Math.PI);
    paper.fill();
  } else {
    paper.moveTo(x, y);
    for (const [px, py] of points.slice(1)) paper.lineTo(px, py);
    paper.stroke();
  }
}

/** `drawGround` draws what was painted before, in pixels of the view. */
export function drawAll(paper: Paper, dabs: readonly Dab[], inks: Inks, width: number, height: number,
  scale: number, drawGround?: () => void): void {
  paper.setTransform(1, 0, 0, 1, 0, 0);
  paper.globalCompositeOperation = "source-over";
  paper.clearRect(0, 0, width * scale, height * scale);
  paper.setTransform(scale, 0, 0, scale, 0, 0);
  drawGround?.();
  for (const dab of dabs) drawDab(paper, dab, inks);
}

/** Where an image of so many pixels lies in a view: it fills the height, and the middle stays the middle, because the vertical
 * angle of view is the same. */
export function placeOf(image: { width: number; height: number }, width: number, height: number): { x: number; y: number; width: number; height: number } {
  const wide = (image.width * height) / image.height;
  return { x: (width - wide) / 2, y: 0, width: wide, height };
}

/** The part of an image that one brush made, as a mask of its alpha: dark pixels are wanted, light ones are not. */
export function maskOf(rgba: Uint8ClampedArray, brush: "want" | "avoid"): Uint8ClampedArray<ArrayBuffer> {
  const mask = new Uint8ClampedArray(rgba.length);
  for (let i = 0; i < rgba.length; i += 4) {
    const dark = rgba[i]! + rgba[i + 1]! + rgba[i + 2]! < 3 * 128;
    if (dark === (brush === "want")) mask[i + 3] = rgba[i + 3]!;
  }
  return mask;
}

/** Whether anything that counts was painted. */
export const hasPaint = (dabs: readonly Dab[]): boolean => dabs.some((dab) => dab.brush !== "erase");
