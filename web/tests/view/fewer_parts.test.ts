import { describe, expect, test } from "vitest";
import { fewerParts } from "../../src/view/fewer_parts";
import { kInstanceWords, type MeshData, type MeshTable, type ModelMessage } from "../../src/view/messages";
import { extentOf } from "../../src/view/part_picker";

/** A box of side 1, or a square upright one without depth. */
function mesh(kind: "cone" | "leaf" | "box"): MeshData {
  const z = kind === "leaf" ? 0 : 0.5;
  return { cone: kind === "cone", grows: kind === "leaf" ? "leaf" : kind === "cone" ? "branch" : null, positions: new Float32Array([-0.5, -0.5, -z, 0.5, 0.5, z]), normals: new Float32Array(6), indices: new Uint32Array() };
}
const kTable: MeshTable = { number: 1, meshes: [mesh("cone"), mesh("leaf"), mesh("box")] };
const kCone = 0, kLeaf = 1, kBox = 2;
const kExtents = kTable.meshes.map(extentOf);

interface Part {
  mesh: number;
  size: [number, number, number];
  at?: number;
  layer?: number;
}

function modelOf(parts: readonly Part[]): ModelMessage {
  const floats = new Float32Array(kInstanceWords * parts.length), words = new Uint32Array(floats.buffer);
  parts.forEach(({ mesh, size, at = 0, layer = 0 }, i) => {
    const w = i * kInstanceWords;
    for (let k = 0; k < 3; ++k) floats[w + 4 * k] = size[k]!;
    floats[w + 9] = at;
    words[w + 14] = mesh | 3 << 16;
    words[w + 15] = layer;
  });
  return {
    number: 1, table: 1, instances: parts.length, floats, words, bones: 0, boneFloats: floats.subarray(0, 0), boneWords: words.subarray(0, 0),
    materials: 4, materialFloats: new Float32Array(48), genes: 1, geneWords: new Int32Array([0, -1]),
  };
}

const partsOf = ({ instances, floats, words }: ModelMessage) => Array.from({ length: instances }, (_, i) => {
  const w = i * kInstanceWords;
  return { mesh: words[w + 14]! & 0xffff, material: words[w + 14]! >>> 16, size: [floats[w]!, floats[w + 4]!, floats[w + 8]!], at: floats[w + 9]! };
});
const area = (parts: readonly { size: readonly number[] }[]) => parts.reduce((sum, { size }) => sum + size[0]! * size[1]!, 0);

describe("fewer parts", () => {
  test("of a model that has few is that model", () => {
    const model = modelOf(Array.from({ length: 100 }, () => ({ mesh: kLeaf, size: [1, 1, 1] })));
    expect(fewerParts(model, kTable, kExtents, 100)).toBe(model);
  });

  test("are as many as asked for, the largest branches as they are, and leaves that cover what all covered", () => {
    const branches = Array.from({ length: 300 }, (_, i): Part => ({ mesh: kCone, size: [0.5, 2 + i / 100, 0.5], at: i }));
    const leaves = Array.from({ length: 7700 }, (_, i): Part => ({ mesh: kLeaf, size: [0.2, 0.3, 0.2], at: i }));
    const few = partsOf(fewerParts(modelOf([...branches, ...leaves]), kTable, kExtents, 1000));
    expect(few.length).toBeLessThanOrEqual(1000);
    expect(few.length).toBeGreaterThan(990);
    const kept = few.filter(({ mesh }) => mesh === kCone);
    expect(kept.map(({ size }) => size[1])).toEqual(branches.map(({ size }) => Math.fround(size[1])));
    expect(few.every(({ material }) => material === 3)).toBe(true);
    const left = few.filter(({ mesh }) => mesh === kLeaf);
    expect(area(left) / area(leaves)).toBeGreaterThan(0.8);
    expect(area(left) / area(leaves)).toBeLessThan(1.05);
    // From one end to the other, not the first ones.
    expect(Math.max(...left.map(({ at }) => at))).toBeGreaterThan(7500);
  });

  test("stay a building", () => {
    const walls = Array.from({ length: 5000 }, (_, i): Part => ({ mesh: kBox, size: [1, 1, 0.1], at: i }));
    const model = modelOf(walls);
    expect(fewerParts(model, kTable, kExtents, 1000)).toBe(model);
    const ivy = Array.from({ length: 5000 }, (_, i): Part => ({ mesh: kLeaf, size: [0.1, 0.1, 0.1], at: i }));
    const few = partsOf(fewerParts(modelOf([...walls, ...ivy]), kTable, kExtents, 1000));
    expect(few.filter(({ mesh }) => mesh === kBox).map(({ at }) => at)).toEqual(walls.map(({ at }) => at));
    expect(few.length).toBeGreaterThan(5200);
    expect(few.length).toBeLessThanOrEqual(5250);
  });

  test("keep what thin branches cover by making them wider, not longer", () => {
    const twigs = Array.from({ length: 4000 }, (_, i): Part => ({ mesh: kCone, size: [0.01, 0.5, 0.01], at: i }));
    const few = partsOf(fewerParts(modelOf(twigs), kTable, kExtents, 2000));
    expect(few.length).toBe(2000);
    for (const { size } of few) {
      expect(size[1]).toBeCloseTo(0.5);
      expect(size[0]).toBeCloseTo(0.02);
    }
  });

  test("have finite frames, whatever comes", () => {
    const odd = Array.from({ length: 3000 }, (_, i): Part => ({ mesh: i % 2, size: i % 3 === 0 ? [0, 0, 0] : [NaN, 1, 1e18], layer: i % 5 === 0 ? 1 : 0 }));
    const few = fewerParts(modelOf(odd), kTable, kExtents, 500);
    expect(few.instances).toBeGreaterThan(0);
    expect(few.instances).toBeLessThanOrEqual(1100);
  });
});
