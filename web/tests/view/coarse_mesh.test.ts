import { describe, expect, test } from "vitest";
import { coarseIndices, kForMovement, kForSmall } from "../../src/view/coarse_mesh";

/** A ball of rings and segments, its poles many vertices each, radius 0.5. */
function ball(rings: number, segments: number) {
  const positions: number[] = [], indices: number[] = [];
  for (let i = 0; i <= rings; ++i) {
    for (let k = 0; k < segments; ++k) {
      const t = (Math.PI * i) / rings, p = (2 * Math.PI * k) / segments;
      positions.push(0.5 * Math.sin(t) * Math.cos(p), 0.5 * Math.cos(t), 0.5 * Math.sin(t) * Math.sin(p));
      if (i === rings) continue;
      const a = i * segments + k, b = i * segments + ((k + 1) % segments);
      indices.push(a, b, a + segments, b, b + segments, a + segments);
    }
  }
  const normals = Float32Array.from(positions, (number) => 2 * number);
  return { positions: Float32Array.from(positions), normals, indices: Uint32Array.from(indices) };
}

/** A cylinder of that many sides, its lids with vertices of their own that come first. */
function cylinder(sides: number) {
  const positions: number[] = [], normals: number[] = [], indices: number[] = [];
  const ring = (y: number, up: number): number => {
    const first = positions.length / 3;
    for (let k = 0; k < sides; ++k) {
      const x = Math.cos(2 * Math.PI * k / sides), z = Math.sin(2 * Math.PI * k / sides);
      positions.push(0.5 * x, y, 0.5 * z);
      normals.push(...(up === 0 ? [x, 0, z] : [0, up, 0]));
    }
    return first;
  };
  for (const up of [-1, 1]) {
    const lid = ring(0.5 * up, up);
    for (let k = 1; k + 1 < sides; ++k) indices.push(lid, lid + k, lid + k + 1);
  }
  const below = ring(-0.5, 0), above = ring(0.5, 0);
  for (let k = 0; k < sides; ++k) {
    const next = (k + 1) % sides;
    indices.push(below + k, below + next, above + k, above + k, below + next, above + next);
  }
  return { positions: Float32Array.from(positions), normals: Float32Array.from(normals), indices: Uint32Array.from(indices) };
}

function volume(positions: Float32Array, indices: Uint32Array): number {
  let six = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [...positions.subarray(3 * indices[i + k]!, 3 * indices[i + k]! + 3)]) as [number[], number[], number[]];
    six += a[0]! * (b[1]! * c[2]! - b[2]! * c[1]!) + a[1]! * (b[2]! * c[0]! - b[0]! * c[2]!) + a[2]! * (b[0]! * c[1]! - b[1]! * c[0]!);
  }
  return Math.abs(six) / 6;
}

describe("a coarse mesh", () => {
  test("of a ball has a fraction of its triangles, and nearly its volume", () => {
    const fine = ball(20, 24), { positions, indices } = fine, coarse = coarseIndices(fine, kForMovement)!;
    expect(coarse.length).toBeLessThan(indices.length / 3);
    expect(coarse.length).toBeGreaterThan(3 * 60);
    expect(volume(positions, coarse) / volume(positions, indices)).toBeGreaterThan(0.8);
    expect(volume(positions, coarse) / volume(positions, indices)).toBeLessThan(1.2);
  });

  test("has the vertices of the fine one, three different ones to a triangle", () => {
    const fine = ball(20, 24), { positions } = fine, coarse = coarseIndices(fine, kForMovement)!;
    for (let i = 0; i < coarse.length; i += 3) {
      const corners = [...coarse.subarray(i, i + 3)];
      expect(new Set(corners).size).toBe(3);
      expect(Math.max(...corners)).toBeLessThan(positions.length / 3);
    }
  });

  test("of a cylinder is a box whose sides keep the light of their sides, and whose lids that of lids", () => {
    const fine = cylinder(8), coarse = coarseIndices(fine, kForSmall)!;
    expect(fine.indices.length / 3).toBe(28);
    expect(coarse.length / 3).toBe(12);
    for (let i = 0; i < coarse.length; i += 3) {
      const up = [...coarse.subarray(i, i + 3)].map((v) => fine.normals[3 * v + 1]!);
      expect(new Set(up).size).toBe(1);
    }
    expect(coarseIndices(fine, kForMovement)).toBeNull();
  });

  test("of what is round stays round: trunks are seen from near", () => {
    expect(coarseIndices(cylinder(12), kForSmall)).toBeNull();
    expect(coarseIndices(cylinder(32), kForSmall)!.length / 3).toBe(28);
  });

  test("is not made of few triangles, of a mesh without size, or where it saves nothing", () => {
    const small = ball(4, 8);
    expect(coarseIndices(small, kForMovement)).toBeNull();
    const fine = ball(20, 24);
    expect(coarseIndices({ ...fine, positions: new Float32Array(fine.positions.length) }, kForMovement)).toBeNull();
    const apart = Float32Array.from({ length: 9 * 150 }, (_, i) => Math.floor(i / 9) * 0 + [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!);
    expect(coarseIndices({ positions: apart, normals: apart, indices: Uint32Array.from({ length: 450 }, (_, i) => i) }, kForMovement)).toBeNull();
  });
});
