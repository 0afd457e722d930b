// What dragging with the tools box, sphere and cylinder makes: a base on the ground, then (not for spheres) a height.
// Seen from the side the ground is no help: there the drag is the outline in the upright plane through the target, and
// depth is as width.
import type { Vec3 } from "../api";
import { metresAlong, onPlane } from "./gizmo";
import { kLeastScale, type Placing } from "./placing";
import type { Shape } from "./shapes";
import { distance, mix, type V } from "./vec";
import type { Eye } from "./orbit";

/** The plane that is dragged on. `depth` is the axis across it. */
export interface Board {
  at: V;
  normal: V;
  upright: boolean;
}

/** The ground where it is seen well enough from above or below, else the upright plane that faces the viewer most. */
export function boardFor(eye: Eye): Board {
  if (Math.abs(eye.back[1]) > 0.12) return { at: [0, 0, 0], normal: [0, 1, 0], upright: false };
  const normal: V = Math.abs(eye.back[0]) > Math.abs(eye.back[2]) ? [1, 0, 0] : [0, 0, 1];
  return { at: eye.target, normal, upright: true };
}

/** The point of the board under a pixel, unless it is out of sight far away. */
export function onBoard(eye: Eye, board: Board, x: number, y: number): Vec3 | null {
  const p = onPlane(eye, x, y, board.at, board.normal);
  return p && distance(p, eye.position) < 60 * eye.distance ? p : null;
}

const solid = (x: number): number => Math.max(Math.abs(x), kLeastScale);

export function shapeBetween(shape: Shape, board: Board, a: V, b: V): Placing {
  const rotation_deg: Vec3 = [0, 0, 0];
  if (shape === "sphere") {
    const size = solid(2 * distance(a, b));
    return { position: board.upright ? a : [a[0], a[1] + size / 2, a[2]], scale: [size, size, size], rotation_deg };
  }
  if (board.upright) {
    const wide = solid(board.normal[0] ? b[2] - a[2] : b[0] - a[0]);
    return { position: mix(a, b, 0.5), scale: [wide, solid(b[1] - a[1]), wide], rotation_deg };
  }
  const thin = 0.04 * Math.max(distance(a, b), kLeastScale);
  if (shape === "cylinder") {
    const size = solid(2 * distance(a, b));
    return { position: [a[0], a[1] + thin / 2, a[2]], scale: [size, thin, size], rotation_deg };
  }
  const middle = mix(a, b, 0.5);
  return { position: [middle[0], a[1] + thin / 2, middle[2]], scale: [solid(b[0] - a[0]), thin, solid(b[2] - a[2])],
    rotation_deg };
}

/** The base with the height that a movement of the pointer means; below the base it grows downwards. */
export function withHeight(eye: Eye, base: Placing, dx: number, dy: number): Placing {
  const foot = base.position[1] - base.scale[1] / 2;
  const height = metresAlong(eye, [base.position[0], foot, base.position[2]], [0, 1, 0], dx, dy);
  return {
    ...base, position: [base.position[0], foot + height / 2, base.position[2]],
    scale: [base.scale[0], solid(height), base.scale[2]],
  };
}

/** For the keyboard: a shape of a quarter of the picture's height, standing on the ground below the target. */
export function shapeAt(eye: Eye, shape: Shape): Placing {
  const size = Number((eye.distance / 4).toPrecision(2));
  return { position: [eye.target[0], shape === "sphere" ? Math.max(eye.target[1], size / 2) : size / 2, eye.target[2]],
    scale: [size, size, size], rotation_deg: [0, 0, 0] };
}
