import { describe, expect, test } from "vitest";
import { kForMovement, kForSmall } from "../../src/view/coarse_mesh";
import { packsOf } from "../../src/view/mesh_packs";
import { decodeMeshes, type MeshTable } from "../../src/view/messages";
import { meshMessage, treeMeshes } from "./synthetic";

describe("a pack", () => {
  const table = decodeMeshes(meshMessage(1, treeMeshes()));

  test("is its mesh over and over, each time with the next number", () => {
    packsOf(table, kForMovement).forEach(({ copies, position, normal, copy, index }, number) => {
      const mesh = table.meshes[number]!, vertices = mesh.positions.length / 3;
      expect(copies).toBe(Math.min(256, Math.max(1, Math.floor(2048 / vertices))));
      expect([position.count, normal.count, copy.count, index.count]).toEqual([
        copies * vertices, copies * vertices, copies * vertices, copies * mesh.indices.length]);
      for (let i = 0; i < index.count; i += 7) {
        const of = Math.floor(i / mesh.indices.length), vertex = index.getX(i), own = mesh.indices[i % mesh.indices.length]!;
        expect(vertex).toBe(of * vertices + own);
        expect(copy.getX(vertex)).toBe(of);
        expect([position.getY(vertex), normal.getZ(vertex)]).toEqual([mesh.positions[3 * own + 1], mesh.normals[3 * own + 2]]);
      }
    });
  });

  test("of a large mesh is that mesh, of a tiny one at most 256 of it", () => {
    const mesh = (triangles: number) => ({
      cone: false, grows: null, positions: new Float32Array(9 * triangles), normals: new Float32Array(9 * triangles),
      indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => i),
    });
    const sizes: MeshTable = { number: 1, meshes: [mesh(5000), mesh(1), mesh(0)] };
    expect(packsOf(sizes, kForSmall).map((pack) => pack.copies)).toEqual([1, 256, 256]);
  });

  test("is made once for a table and a coarseness", () => {
    expect(packsOf(table, kForMovement)).toBe(packsOf(table, kForMovement));
    expect(packsOf(table, kForSmall)).not.toBe(packsOf(table, kForMovement));
  });
});
