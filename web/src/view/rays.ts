// A ray against a box and against triangles.
import type { Steps } from "./slices";
import type { V } from "./vec";

export interface Triangles {
  positions: Float32Array;
  indices: Uint32Array;
}

/** Where the ray enters the box (at least 0), or Infinity. Directions need not be of length 1. */
export function hitBox(origin: V, direction: V, min: V, max: V): number {
  let near = 0, far = Infinity;
  for (let i = 0; i < 3; ++i) {
    const inverse = 1 / direction[i]!;
    let a = (min[i]! - origin[i]!) * inverse, b = (max[i]! - origin[i]!) * inverse;
    if (a > b) [a, b] = [b, a];
    // A ray within a face's plane gives 0 * Infinity, which says nothing.
    if (a > near) near = a;
    if (b < far) far = b;
    if (direction[i] === 0 && (origin[i]! < min[i]! || origin[i]! > max[i]!)) return Infinity;
  }
  return near <= far ? near : Infinity;
}

/** The nearest t > 0 at which the ray meets a triangle from either side, or Infinity (Moeller and Trumbore 1997).
 *  The upper  ends of cones are scaled by `top`: x and z of what is at y. */
export function hitTriangles(origin: V, direction: V, { positions, indices }: Triangles, top = 1, begin = 0,
  end = indices.length): number {
  const [ox, oy, oz] = origin, [dx, dy, dz] = direction;
  let nearest = Infinity;
  for (let i = begin; i < end; i += 3) {
    const a = 3 * indices[i]!, b = 3 * indices[i + 1]!, c = 3 * indices[i + 2]!;
    let ax = positions[a]!, az = positions[a + 2]!, bx = positions[b]!, bz = positions[b + 2]!;
    let cx = positions[c]!, cz = positions[c + 2]!;
    const ay = positions[a + 1]!, by = positions[b + 1]!, cy = positions[c + 1]!;
    if (top !== 1) {
      const ka = 1 + (top - 1) * (ay + 0.5), kb = 1 + (top - 1) * (by + 0.5), kc = 1 + (top - 1) * (cy + 0.5);
      ax *= ka; az *= ka; bx *= kb; bz *= kb; cx *= kc; cz *= kc;
    }
    const e1x = bx - ax, e1y = by - ay, e1z = bz - az, e2x = cx - ax, e2y = cy - ay, e2z = cz - az;
    const px = dy * e2z - dz * e2y, py = dz * e2x - dx * e2z, pz = dx * e2y - dy * e2x;
    const determinant = e1x * px + e1y * py + e1z * pz;
    if (determinant === 0) continue;
    const tx = ox - ax, ty = oy - ay, tz = oz - az;
    const u = (tx * px + ty * py + tz * pz) / determinant;
    if (!(u >= 0 && u <= 1)) continue;
    const qx = ty * e1z - tz * e1y, qy = tz * e1x - tx * e1z, qz = tx * e1y - ty * e1x;
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (!(v >= 0 && u + v <= 1)) continue;
    const t = (e2x * qx + e2y * qy + e2z * qz) / determinant;
    if (t > 0 && t < nearest) nearest = t;
  }
  return nearest;
}

const kChunk = 3 * 256;

/** Boxes around every 256 triangles in their order, 6 floats each: neighbours in a file mostly are neighbours in
 *  space. */
export function* chunkBoxes({ positions, indices }: Triangles): Steps<Float32Array> {
  const boxes = new Float32Array(6 * Math.ceil(indices.length / kChunk));
  for (let c = 0; 6 * c < boxes.length; ++c) {
    if (c % 16 === 15) yield;
    boxes.fill(Infinity, 6 * c, 6 * c + 3).fill(-Infinity, 6 * c + 3, 6 * c + 6);
    for (let i = c * kChunk; i < Math.min((c + 1) * kChunk, indices.length); ++i) {
      for (let k = 0; k < 3; ++k) {
        const x = positions[3 * indices[i]! + k]!;
        if (x < boxes[6 * c + k]!) boxes[6 * c + k] = x;
        if (x > boxes[6 * c + 3 + k]!) boxes[6 * c + 3 + k] = x;
      }
    }
  }
  return boxes;
}

/** As hitTriangles, for large meshes. */
export function hitChunks(origin: V, direction: V, mesh: Triangles, boxes: Float32Array): number {
  let nearest = Infinity;
  for (let c = 0; 6 * c < boxes.length; ++c) {
    const b = 6 * c, enter = hitBox(origin, direction, [boxes[b]!, boxes[b + 1]!, boxes[b + 2]!],
      [boxes[b + 3]!, boxes[b + 4]!, boxes[b + 5]!]);
    if (enter >= nearest) continue;
    nearest = Math.min(nearest, hitTriangles(origin, direction, mesh, 1, c * kChunk,
      Math.min((c + 1) * kChunk, mesh.indices.length)));
  }
  return nearest;
}
