import { describe, expect, it } from "vitest";
import { decodeMeshes, decodeModel } from "../../src/view/messages";
import { extentOf, PartPicker } from "../../src/view/part_picker";
import { hitBox, hitTriangles } from "../../src/view/rays";
import { shapeTriangles } from "../../src/view/shapes";
import { unit } from "../../src/view/vec";
import { meshMessage, modelMessage, treeMeshes, treeModel, type TestInstance } from "./synthetic";

const table = decodeMeshes(meshMessage(1, treeMeshes()));
const extents = table.meshes.map(extentOf);

function picker(instances: readonly TestInstance[]): PartPicker {
  const genes = instances.map((i) => [0, (i.gene ?? 0) - 1] as const);
  const picker = new PartPicker();
  picker.setModel(decodeModel(modelMessage({ instances, genes }), table.meshes.length), table.meshes, extents);
  return picker;
}

const cube = (x: number, y: number, z: number, s = 1): number[] => [s, 0, 0, 0, s, 0, 0, 0, s, x, y, z];

describe("rays", () => {
  it("meets boxes from outside, inside and along their faces", () => {
    expect(hitBox([-3, 0, 0], [1, 0, 0], [-1, -1, -1], [1, 1, 1])).toBe(2);
    expect(hitBox([0, 0, 0], [1, 0, 0], [-1, -1, -1], [1, 1, 1])).toBe(0);
    expect(hitBox([-3, 2, 0], [1, 0, 0], [-1, -1, -1], [1, 1, 1])).toBe(Infinity);
    expect(hitBox([3, 0, 0], [1, 0, 0], [-1, -1, -1], [1, 1, 1])).toBe(Infinity);
    expect(hitBox([-3, 1, 0], [1, 0, 0], [-1, -1, -1], [1, 1, 1])).toBe(2);
  });

  it("meets triangles from both sides, the nearest first", () => {
    const box = shapeTriangles("box");
    expect(hitTriangles([-3, 0.1, 0.2], [1, 0, 0], box)).toBeCloseTo(2.5);
    expect(hitTriangles([0, 0.1, 0.2], [1, 0, 0], box)).toBeCloseTo(0.5);
    expect(hitTriangles([0.1, 3, 0.2], [0, -2, 0], box)).toBeCloseTo(1.25);
    expect(hitTriangles([3, 0.1, 0.2], [1, 0, 0], box)).toBe(Infinity);
  });

  it("knows that a cone is narrow above", () => {
    const cone = table.meshes[1]!;
    expect(hitTriangles([-3, 0.45, 0], [1, 0, 0], cone, 1)).toBeCloseTo(2.5);
    expect(hitTriangles([-3, 0.4, 0], [1, 0, 0], cone, 0)).toBeCloseTo(2.95);
    expect(hitTriangles([-3, 0.4, 0.2], [1, 0, 0], cone, 0)).toBe(Infinity);
    expect(hitTriangles([-3, 0.5, 0], [1, 0, 0], cone, 2)).toBeLessThan(2.1);
  });
});

describe("PartPicker", () => {
  it("gives the gene of the nearest part", () => {
    const p = picker([{ frame: cube(0, 0, -5), gene: 0 }, { frame: cube(0, 0, 0), gene: 1 },
      { frame: cube(0, 3, 0), gene: 2 }]);
    expect(p.pick([0.1, 0.2, 10], [0, 0, -1])).toMatchObject({ gene: 1, instance: 1 });
    expect(p.pick([0.1, 0.2, 10], [0, 0, -1])!.t).toBeCloseTo(9.5);
    expect(p.pick([0.1, 0.2, -10], [0, 0, 1])).toMatchObject({ gene: 0 });
    expect(p.pick([2, 0, 10], [0, 0, -1])).toBeNull();
  });

  it("follows turned, mirrored and stretched frames", () => {
    const c = Math.SQRT1_2;
    const p = picker([{ frame: [-4 * c, 0, 4 * c, 0, 0.2, 0, c, 0, c, 0, 0, 0], gene: 0 }]);
    expect(p.pick([1.2, 3, -1.2], [0, -1, 0])!.t).toBeCloseTo(2.9);
    expect(p.pick([1.2, 3, 1.2], [0, -1, 0])).toBeNull();
  });

  it("passes over proxies and parts that are no numbers, and finds flat ones", () => {
    const p = picker([
      { frame: cube(0, 0, 2), layer: 1, gene: 0 }, { frame: [NaN, ...cube(0, 0, 1).slice(1)], gene: 1 },
      { frame: [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0], mesh: 3, gene: 2 },
    ]);
    expect(p.pick([0.1, 0.1, 10], [0, 0, -1])).toMatchObject({ gene: 2 });
  });

  it("sees wide cones beyond their mesh's box", () => {
    const p = picker([{ frame: cube(0, 0, 0), mesh: 1, top: 4, gene: 0 }]);
    expect(p.pick([1.5, 10, 0], unit([0, -1, 0]))).not.toBeNull();
    expect(p.pick([1.5, -0.4, 10], [0, 0, -1])).toBeNull();
  });

  it("agrees with trying every part of a tree", () => {
    const model = decodeModel(treeModel(800), table.meshes.length);
    const all = new PartPicker();
    all.setModel(model, table.meshes, extents);
    let hits = 0;
    for (let i = 0; i < 60; ++i) {
      const origin = [6 * Math.sin(i), 2 + Math.sin(i * 1.3), 6 * Math.cos(i)] as const;
      const direction = unit([Math.sin(i * 2.1) * 0.8 - origin[0], 2 + Math.cos(i * 1.9) - origin[1],
        Math.cos(i * 2.7) * 0.8 - origin[2]]);
      let nearest = Infinity;
      for (let k = 0; k < model.instances; ++k) {
        const f = model.floats.subarray(16 * k, 16 * k + 12), mesh = table.meshes[model.words[16 * k + 14]! & 0xffff]!;
        const positions = new Float32Array(mesh.positions.length), top = mesh.cone ? model.floats[16 * k + 12]! : 1;
        for (let v = 0; v < positions.length; v += 3) {
          const s = 1 + (top - 1) * (mesh.positions[v + 1]! + 0.5);
          for (let a = 0; a < 3; ++a) {
            positions[v + a] = f[9 + a]! + f[a]! * mesh.positions[v]! * s + f[3 + a]! * mesh.positions[v + 1]! +
              f[6 + a]! * mesh.positions[v + 2]! * s;
          }
        }
        nearest = Math.min(nearest, hitTriangles(origin, direction, { positions, indices: mesh.indices }));
      }
      const hit = all.pick(origin, direction);
      if (nearest < Infinity) ++hits;
      expect(hit?.t ?? Infinity).toBeCloseTo(nearest, 3);
    }
    expect(hits).toBeGreaterThan(10);
  });

  it("knows nothing without a model", () => {
    expect(new PartPicker().pick([0, 0, 0], [0, 0, 1])).toBeNull();
  });
});
