// Small meshes in packs: many copies one after another in one buffer, drawn by one call for a pack of instances. An instance of a
// call of its own costs as much as hundreds of triangles: always where the processor draws, and on graphics cards where meshes
// have fewer vertices than a card works on at once.
import { BufferAttribute } from "three";
import { coarseIndices, type Coarseness } from "./coarse_mesh";
import type { MeshData, MeshTable } from "./messages";

/** Vertices in a pack, unless one mesh has more. */
const kVertices = 2048;
const kMostCopies = 256;

/** Shared by all who draw a mesh of the table, with the same renderer. */
export interface MeshPack {
  copies: number;
  position: BufferAttribute;
  normal: BufferAttribute;
  /** Per vertex: of which copy, 0 .. copies - 1. */
  copy: BufferAttribute;
  index: BufferAttribute;
  /** For quick frames; the same as `index` where that is coarse enough. */
  coarse: BufferAttribute;
}

const known = new WeakMap<Coarseness, WeakMap<MeshTable, MeshPack[]>>();

/** One of each mesh of the table. Made once. */
export function packsOf(table: MeshTable, coarseness: Coarseness): readonly MeshPack[] {
  let tables = known.get(coarseness);
  if (tables === undefined) known.set(coarseness, tables = new WeakMap());
  let packs = tables.get(table);
  if (packs === undefined) tables.set(table, packs = table.meshes.map((mesh) => packOf(mesh, coarseness)));
  return packs;
}

function packOf(mesh: MeshData, coarseness: Coarseness): MeshPack {
  const vertices = mesh.positions.length / 3;
  const copies = Math.max(1, Math.min(kMostCopies, Math.floor(kVertices / Math.max(vertices, 1))));
  const copy = new Float32Array(vertices * copies);
  for (let i = 0; i < copies; ++i) copy.fill(i, i * vertices, (i + 1) * vertices);
  const index = new BufferAttribute(repeatedIndices(mesh.indices, copies, vertices), 1);
  const fewer = coarseIndices(mesh, coarseness);
  return {
    copies, index, copy: new BufferAttribute(copy, 1),
    position: new BufferAttribute(repeated(mesh.positions, copies), 3),
    normal: new BufferAttribute(repeated(mesh.normals, copies), 3),
    coarse: fewer === null ? index : new BufferAttribute(repeatedIndices(fewer, copies, vertices), 1),
  };
}

function repeated(numbers: Float32Array, copies: number): Float32Array {
  const all = new Float32Array(numbers.length * copies);
  for (let i = 0; i < copies; ++i) all.set(numbers, i * numbers.length);
  return all;
}

function repeatedIndices(indices: Uint32Array, copies: number, vertices: number): Uint32Array {
  const all = new Uint32Array(indices.length * copies);
  for (let i = 0, at = 0; i < copies; ++i) for (const vertex of indices) all[at++] = vertex + i * vertices;
  return all;
}
