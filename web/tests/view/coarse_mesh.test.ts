import { describe, expect, test } from "vitest";
import { coarseIndices } from "../../src/view/coarse_mesh";

/** A ball of rings and segments, its poles many vertices each, radius 0.5. */
function ball(rings: number, segments: number): { positions: Float32Array; indices: Uint32Array } {
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
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
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
    const { positions, indices } = ball(20, 24), coarse = coarseIndices(positions, indices)!;
    expect(coarse.length).toBeLessThan(indices.length / 3);
    expect(coarse.length).toBeGreaterThan(3 * 60);
    expect(volume(positions, coarse) / volume(positions, indices)).toBeGreaterThan(0.8);
    expect(volume(positions, coarse) / volume(positions, indices)).toBeLessThan(1.2);
  });

  test("has the vertices of the fine one, three different ones to a triangle", () => {
    const { positions, indices } = ball(20, 24), coarse = coarseIndices(positions, indices)!;
    for (let i = 0; i < coarse.length; i += 3) {
      const corners = [...coarse.subarray(i, i + 3)];
      expect(new Set(corners).size).toBe(3);
      expect(Math.max(...corners)).toBeLessThan(positions.length / 3);
    }
  });

  test("is not made of few triangles, of a mesh without size, or where it saves nothing", () => {
    const small = ball(4, 8);
    expect(coarseIndices(small.positions, small.indices)).toBeNull();
    const { positions, indices } = ball(20, 24);
    expect(coarseIndices(new Float32Array(positions.length), indices)).toBeNull();
    const apart = Float32Array.from({ length: 9 * 150 }, (_, i) => Math.floor(i / 9) * 0 + [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!);
    expect(coarseIndices(apart, Uint32Array.from({ length: 450 }, (_, i) => i))).toBeNull();
  });
});
