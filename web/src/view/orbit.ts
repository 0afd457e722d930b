// Where the view is seen from: a camera that circles a target. All functions return a new orbit.
// Azimuth 0 looks from +z, 90 degrees from +x; elevation goes from straight below to straight above, and what is up in
// the picture follows from both, so that there is nothing to flip at the poles.
import type { Camera, Vec3 } from "../api";
import type { Side } from "./host";
import { add, along, clamp, dot, isEmpty, mix, scale, subtract, tidy3, unit, type Box, type V } from "./vec";

export interface Orbit {
  readonly target: V;
  readonly distance: number;
  readonly azimuth: number;
  readonly elevation: number;
}

/** The orbit as seen in a picture of width x height pixels. Back is where the camera is, seen from the target. */
export interface Eye {
  readonly position: V;
  readonly right: V;
  readonly up: V;
  readonly back: V;
  readonly target: V;
  readonly distance: number;
  readonly width: number;
  readonly height: number;
}

export interface Screen {
  x: number;
  y: number;
  /** Metres along the direction of view; what is 0 or less lies behind. */
  depth: number;
}

export const kFovDeg = 45;
export const kHalfTan = Math.tan((kFovDeg / 2) * Math.PI / 180);
export const kStart: Orbit = { target: [0, 2, 0], distance: 8, azimuth: 0.5, elevation: 0.22 };
const kNearest = 1e-3, kFurthest = 1e6, kPole = Math.PI / 2;

export function eyeOf(o: Orbit, width: number, height: number): Eye {
  const ca = Math.cos(o.azimuth), sa = Math.sin(o.azimuth), ce = Math.cos(o.elevation), se = Math.sin(o.elevation);
  const back: Vec3 = [sa * ce, se, ca * ce];
  return {
    back, right: [ca, 0, -sa], up: [-sa * se, ce, -ca * se], position: along(o.target, o.distance, back),
    target: o.target, distance: o.distance, width: Math.max(width, 1), height: Math.max(height, 1),
  };
}

export const cameraOf = (eye: Eye): Camera =>
  ({ eye: tidy3(eye.position), at: tidy3(eye.target), up: tidy3(eye.up), fov_deg: kFovDeg });

/** The orbit that looks as a camera does which cameraOf made; null where none looks so. */
export function orbitOf(camera: Camera): Orbit | null {
  const { eye, at, up, fov_deg: fov } = camera;
  if (eye === undefined || at === undefined || fov !== kFovDeg) return null;
  const off = subtract(eye, at), distance = Math.hypot(...off);
  if (!(distance > 0)) return null;
  const elevation = Math.asin(clamp(off[1] / distance, -1, 1));
  // Straight from above or below the azimuth is in what is up.
  const steep = Math.hypot(off[0], off[2]) < 1e-6 * distance, sign = Math.sign(elevation);
  const azimuth = steep ? Math.atan2(-sign * (up?.[0] ?? 0), -sign * (up?.[2] ?? -1)) : Math.atan2(off[0], off[2]);
  return { target: at, distance, azimuth, elevation };
}

/** Metres per pixel at a depth. */
export const pixelSize = (eye: Eye, depth: number): number => 2 * kHalfTan * depth / eye.height;
export const depthOf = (eye: Eye, p: V): number => -dot(subtract(p, eye.position), eye.back);

export function project(eye: Eye, p: V): Screen {
  const off = subtract(p, eye.position), depth = -dot(off, eye.back);
  const k = eye.height / (2 * kHalfTan * Math.max(depth, 1e-9));
  return { x: eye.width / 2 + dot(off, eye.right) * k, y: eye.height / 2 - dot(off, eye.up) * k, depth };
}

/** The ray through a pixel, with a direction of length 1. */
export function rayThrough(eye: Eye, x: number, y: number): { origin: V; direction: V } {
  return { origin: eye.position, direction: unit(subtract(atDepth(eye, x, y, 1), eye.position)) };
}

/** The point under a pixel at a depth. */
export function atDepth(eye: Eye, x: number, y: number, depth: number): Vec3 {
  const s = pixelSize(eye, depth);
  return along(along(along(eye.position, -depth, eye.back), (x - eye.width / 2) * s, eye.right),
    (eye.height / 2 - y) * s, eye.up);
}

/** Turned by pixels dragged: 0.01 rad each, as in the original editor. */
export const turned = (o: Orbit, dx: number, dy: number): Orbit =>
  ({ ...o, azimuth: o.azimuth - 0.01 * dx, elevation: clamp(o.elevation + 0.01 * dy, -kPole, kPole) });

/** Moved so that what is at the target's depth stays under the pointer. */
export function panned(o: Orbit, eye: Eye, dx: number, dy: number): Orbit {
  const s = pixelSize(eye, o.distance);
  return { ...o, target: add(o.target, add(scale(eye.right, -dx * s), scale(eye.up, dy * s))) };
}

/** Distance times `factor`; what lies under the pixel, at the target's depth, stays there. */
export function zoomed(o: Orbit, eye: Eye, factor: number, x: number, y: number): Orbit {
  const next = clamp(o.distance * factor, kNearest, kFurthest);
  const under = atDepth(eye, x, y, o.distance);
  return { ...o, distance: next, target: mix(under, o.target, next / o.distance) };
}

/** Wheel events as a factor: a notch is about a tenth, whatever the unit; pinches on a touch pad are finer. */
export function wheelFactor(deltaY: number, deltaMode: number, pinch: boolean): number {
  const pixels = deltaY * (deltaMode === 1 ? 16 : deltaMode === 2 ? 400 : 1);
  return Math.exp(clamp(pixels, -240, 240) * (pinch ? 0.01 : 0.0012));
}

const kSides: Record<Side, readonly [number, number]> = {
  "+x": [kPole, 0], "-x": [-kPole, 0], "+y": [0, kPole], "-y": [0, -kPole], "+z": [0, 0], "-z": [Math.PI, 0],
};

/** The same target seen from a side. The azimuth takes the shorter way round. */
export function snapped(o: Orbit, side: Side): Orbit {
  const [azimuth, elevation] = kSides[side];
  const turnBy = azimuth - o.azimuth;
  return { ...o, azimuth: o.azimuth + turnBy - 2 * Math.PI * Math.round(turnBy / (2 * Math.PI)), elevation };
}

/** Around the middle of `box`, as near as all its corners are seen with a margin. */
export function framed(o: Orbit, box: Box, aspect: number): Orbit {
  if (isEmpty(box)) return { ...kStart };
  const target = mix(box.min, box.max, 0.5), { right, up, back } = eyeOf(o, 1, 1), fill = 0.97;
  let least = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const off = subtract([corner & 1 ? box.max[0] : box.min[0], corner & 2 ? box.max[1] : box.min[1],
      corner & 4 ? box.max[2] : box.min[2]], target);
    const wide = Math.abs(dot(off, right)) / (fill * kHalfTan * Math.max(aspect, 0.05)),
      high = Math.abs(dot(off, up)) / (fill * kHalfTan);
    least = Math.max(least, dot(off, back) + Math.max(wide, high));
  }
  return { ...o, target, distance: clamp(least, 10 * kNearest, kFurthest) };
}

/** Between two orbits, eased at both ends; t from 0 to 1. Distances change by ratio. */
export function between(a: Orbit, b: Orbit, t: number): Orbit {
  const s = clamp(t, 0, 1), k = s * s * (3 - 2 * s);
  return {
    target: mix(a.target, b.target, k),
    distance: a.distance * (b.distance / a.distance) ** k,
    azimuth: a.azimuth + (b.azimuth - a.azimuth) * k,
    elevation: a.elevation + (b.elevation - a.elevation) * k,
  };
}
