// Wavefront OBJ: vertices and faces, which is all that a ghost needs. Polygons are cut into fans; what is not
// understood is passed over.
import type { Triangles } from "./rays";

export const kMostTriangles = 300_000;
const kSlice = 500;

/** Throws an Error that names the line for faces that name no vertex, and for what is too large. Pauses every kSlice
 *  lines. */
export function* readObj(text: string): Generator<void, Triangles> {
  const positions: number[] = [], indices: number[] = [];
  let line = 0;
  for (let at = 0, end = 0; at < text.length; at = end + 1) {
    end = text.indexOf("\n", at);
    if (end < 0) end = text.length;
    const row = text.slice(at, end);
    if (++line % kSlice === 0) yield;
    if (row.startsWith("v ")) {
      const [x, y, z] = row.slice(2).trim().split(/\s+/).map(Number);
      if (!Number.isFinite(x) || !Number.isFinite(y) ||
        !Number.isFinite(z)) throw new Error(`line ${line}: not three numbers`);
      positions.push(x!, y!, z!);
    } else if (row.startsWith("f ")) {
      const count = positions.length / 3;
      const corners = row.slice(2).trim().split(/\s+/).map((corner) => {
        const n = parseInt(corner, 10);
        const index = n < 0 ? count + n : n - 1;
        if (!(index >= 0 && index < count)) throw new Error(`line ${line}: a face names vertex ${corner} of ${count}`);
        return index;
      });
      for (let i = 2; i < corners.length; ++i) indices.push(corners[0]!, corners[i - 1]!, corners[i]!);
      if (indices.length > 3 * kMostTriangles) throw new Error(`it has more than ${kMostTriangles} triangles`);
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}
