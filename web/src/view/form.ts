// The form of a target's mesh as it is shown: its surface, its creases as lines, and what finds it under a ray.
import { BufferAttribute, BufferGeometry } from "three";
import { chunkBoxes, type Triangles } from "./rays";
import { creases } from "./shapes";
import type { Steps } from "./slices";
import { emptyBox, grow, type Box } from "./vec";

export interface Form {
  triangles: Triangles;
  chunks: Float32Array;
  surface: BufferGeometry;
  edges: BufferGeometry;
  box: Box;
}

/** Corners of triangles: finding creases takes a second per million. */
const kMostCreased = 60_000;
const kPause = 12_000;

/** `normals`: of each position; made where there are none. */
export function* makeForm(mesh: Triangles & { normals?: Float32Array }): Steps<Form> {
  const { positions, indices, normals } = mesh, surface = new BufferGeometry();
  surface.setAttribute("position", new BufferAttribute(positions, 3));
  surface.setIndex(new BufferAttribute(indices, 1));
  if (normals) surface.setAttribute("normal", new BufferAttribute(normals, 3));
  else surface.computeVertexNormals();
  yield;
  const box = emptyBox();
  for (let i = 0; i < positions.length; i += 3) {
    if (i % kPause === 0) yield;
    grow(box, [positions[i]!, positions[i + 1]!, positions[i + 2]!]);
  }
  const edges = new BufferGeometry(), chunks = yield* chunkBoxes(mesh);
  const lines = indices.length < kMostCreased ? yield* creases(mesh) : new Float32Array(0);
  edges.setAttribute("position", new BufferAttribute(lines, 3));
  edges.setAttribute("normal", new BufferAttribute(new Float32Array(lines.length), 3));
  return { triangles: mesh, chunks, surface, edges, box };
}
