// Triangles for frames that must be quick: a mesh with fewer of them over the same vertices.
import type { MeshData } from "./messages";

export interface Coarseness {
  /** Meshes with fewer triangles are as coarse as they need to be. */
  few: number;
  /** Along the longest side of a mesh. */
  cells: number;
  /** With so many triangles a mesh is round enough to have one cell more. */
  round: number;
}
/** For movement in a large view: a ball keeps about 150 triangles. */
export const kForMovement: Coarseness = { few: 128, cells: 6, round: Infinity };
/** For models of a few hundred pixels, whose branches are a few of them wide: these become square. */
export const kForSmall: Coarseness = { few: 20, cells: 2, round: 40 };

/** The triangles whose corners lie in three different cells of a grid, each corner moved to the first vertex of its cell
 *  (Rossignac and Borrel 1993) that looks straight up, straight down, or else, as it does; three vertices a triangle, as in `indices`.
 *  Null where that saves less than half. */
export function coarseIndices({ positions, normals, indices }: Pick<MeshData, "positions" | "normals" | "indices">,
  coarseness: Coarseness): Uint32Array | null {
  if (indices.length < 3 * coarseness.few) return null;
  const cells = coarseness.cells + (indices.length < 3 * coarseness.round ? 0 : 1);
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    least[i % 3] = Math.min(least[i % 3]!, positions[i]!);
    most[i % 3] = Math.max(most[i % 3]!, positions[i]!);
  }
  const longest = Math.max(most[0]! - least[0]!, most[1]! - least[1]!, most[2]! - least[2]!);
  if (!(longest > 0)) return null;
  const scale = cells / longest, firsts = new Map<number, number>(), first = new Uint32Array(positions.length / 3);
  for (let v = 0; v < first.length; ++v) {
    // The lids of a cylinder share their corners with its side, and nothing else.
    let cell = Math.trunc(1.001 * normals[3 * v + 1]!) + 1;
    for (let i = 0; i < 3; ++i) cell = cell * cells + Math.min(Math.floor((positions[3 * v + i]! - least[i]!) * scale), cells - 1);
    const known = firsts.get(cell);
    if (known === undefined) firsts.set(cell, v);
    first[v] = known ?? v;
  }
  const coarse = new Uint32Array(indices.length);
  let count = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const a = first[indices[i]!]!, b = first[indices[i + 1]!]!, c = first[indices[i + 2]!]!;
    if (a === b || b === c || c === a) continue;
    coarse[count] = a;
    coarse[count + 1] = b;
    coarse[count + 2] = c;
    count += 3;
  }
  return count > 0 && 2 * count <= indices.length ? coarse.slice(0, count) : null;
}
