// From where a model is seen so that all of it is in its cell however it turns.
import { clamp, isEmpty, type Box } from "../view/vec";

/** What a model takes when it turns about its own axis. */
export interface Span {
  /** The axis. */
  x: number;
  z: number;
  radius: number;
  low: number;
  high: number;
}

export const kFov = 26 * Math.PI / 180;
export const kElevation = 0.2;
/** What is left free around it, and for the rating below, as shares of the cell. */
const kMargin = 1.06, kWords = 0.13;

/** The ground is part of it where the model stands on it or nearly so. `reach`: how far anything is from the axis at most; the
 *  corners of the box where that is not known. */
export function spanOf(box: Box, reach?: (x: number, z: number) => number): Span {
  if (isEmpty(box)) return { x: 0, z: 0, radius: 0.5, low: 0, high: 1 };
  const x = (box.min[0] + box.max[0]) / 2, z = (box.min[2] + box.max[2]) / 2;
  const height = box.max[1] - box.min[1];
  const low = box.min[1] > 0 && box.min[1] < 0.3 * height ? 0 : box.min[1];
  return { x, z, radius: Math.max(reach?.(x, z) ?? Math.hypot(box.max[0] - x, box.max[2] - z), 1e-3), low, high: Math.max(box.max[1], low + 1e-3) };
}

/** One frame for all: as wide and high as the largest, each about its own axis. */
export function commonSpan(spans: readonly Span[]): Span | null {
  if (spans.length === 0) return null;
  return {
    x: 0, z: 0, radius: Math.max(...spans.map((one) => one.radius)),
    low: Math.min(...spans.map((one) => one.low)), high: Math.max(...spans.map((one) => one.high)),
  };
}

export interface Frame {
  /** What the camera looks at, on the model's axis. */
  height: number;
  distance: number;
}

/** `aspect` is width over height. The model is taken as an upright cylinder, which is what it is when it turns. */
export function frameOf(span: Span, aspect: number, elevation = kElevation): Frame {
  const half = (span.high - span.low) / 2, tan = Math.tan(kFov / 2), cosine = Math.cos(elevation), sine = Math.abs(Math.sin(elevation));
  // Below is the rim of the disc in front; crowns are seldom as wide at their top as in their middle.
  const above = half * cosine + 0.4 * span.radius * sine, below = half * cosine + span.radius * sine;
  const near = span.radius * cosine + half * sine;
  const room = Math.max((above + below) / (2 * tan * (1 - kWords)), span.radius / (tan * aspect));
  // Of what is nearest to the eye there is little: a part of the depth in front is enough.
  const distance = kMargin * room + 0.5 * near;
  return { height: (span.low + span.high) / 2 + (above - below) / (2 * cosine) - kWords * room * tan / cosine, distance };
}

export const tilted = (elevation: number, by: number): number => clamp(elevation + by, -0.2, 1.4);
