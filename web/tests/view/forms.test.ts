import { describe, expect, it } from "vitest";
import { contactPatch, contactSquare, kContactCells } from "../../src/view/contact";
import { fieldOf, kFieldFloats } from "../../src/view/field";
import { kHighlighted, kLocked, kSelected, markGenes } from "../../src/view/gene_marks";
import { decodeMeshes, decodeModel } from "../../src/view/messages";
import { makeForm } from "../../src/view/form";
import { kForMovement } from "../../src/view/coarse_mesh";
import { Parts } from "../../src/view/parts";
import { extentOf } from "../../src/view/part_picker";
import { creases, kShapes, shapeFile, shapeOf, shapeTriangles } from "../../src/view/shapes";
import { atOnce } from "../../src/view/slices";
import { clipped, kStrokeFloats, Strokes } from "../../src/view/strokes";
import { eyeOf, project } from "../../src/view/orbit";
import { chunkBoxes, hitChunks, hitTriangles } from "../../src/view/rays";
import { tubeArrays } from "../../src/view/tubes";
import { meshMessage, modelMessage, treeMeshes, treeModel } from "./synthetic";

/** What is read of a geometry of parts. */
interface Drawn {
  instanceCount: number;
  drawRange: { count: number };
  index: { count: number };
  attributes: { position: { count: number }; range: { array: Float32Array }; copy: { array: Float32Array } };
}

describe("large meshes", () => {
  it("are hit as small ones are", () => {
    const sphere = shapeTriangles("sphere"), boxes = atOnce(chunkBoxes(sphere));
    expect(boxes.length / 6).toBe(Math.ceil(sphere.indices.length / 768));
    for (let i = 0; i < 40; ++i) {
      const origin = [2 * Math.sin(i), Math.cos(2 * i), 2 * Math.cos(i)] as const;
      const direction = [-origin[0] + 0.5 * Math.sin(3 * i), -origin[1], -origin[2] + 0.3 * Math.cos(5 * i)] as const;
      expect(hitChunks(origin, direction, sphere, boxes)).toBe(hitTriangles(origin, direction, sphere));
    }
  });

  it("are made ready in slices, as many more as they are larger", () => {
    const slices = (triangles: number): number => {
      const positions = Float32Array.from({ length: 9 * triangles }, (_, i) => Math.sin(i));
      const steps = makeForm({ positions, normals: positions, indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => i) });
      let count = 1;
      while (!steps.next().done) ++count;
      return count;
    };
    for (const few of [4_000, 40_000]) expect(slices(4 * few)).toBeGreaterThan(3 * slices(few));
    expect(slices(19_000)).toBeGreaterThan(60); // with creases
  });
});

describe("shapes", () => {
  it.each(kShapes)("%s fills the unit box and faces outwards", (shape) => {
    const { positions, indices } = shapeTriangles(shape), { box } = extentOf({ positions, cone: false });
    expect(box).toEqual({ min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, 0.5] });
    let volume = 0;
    for (let t = 0; t < indices.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => [...positions.slice(3 * indices[t + k]!, 3 * indices[t + k]! + 3)]);
      volume += (a![0]! * (b![1]! * c![2]! - b![2]! * c![1]!) + a![1]! * (b![2]! * c![0]! - b![0]! * c![2]!) +
        a![2]! * (b![0]! * c![1]! - b![1]! * c![0]!)) / 6;
    }
    expect(volume).toBeCloseTo({ box: 1, sphere: Math.PI / 6, cylinder: Math.PI / 4 }[shape], 1);
    expect(shapeOf(shapeFile(shape))).toBe(shape);
    expect(shapeOf("box.obj")).toBeUndefined();
  });

  it("has creases where faces meet, and open edges", () => {
    expect(atOnce(creases(shapeTriangles("box")))).toHaveLength(12 * 6);
    expect(atOnce(creases(shapeTriangles("cylinder")))).toHaveLength(2 * 48 * 6);
    expect(atOnce(creases(shapeTriangles("sphere")))).toHaveLength(0);
    expect(atOnce(creases({ positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]),
      indices: new Uint32Array([0, 1, 2]) }))).toHaveLength(18);
  });
});

describe("marks of genes", () => {
  // 0 - 1 - 3, 0 - 2 - 4, 2 - 5; parents may come after their children.
  const words = new Int32Array([0, -1, 1, 0, 2, 0, 2, 1, 1, 2, 2, 2]);

  it("go up to all that stands on a gene", () => {
    const marks = new Uint8Array(6);
    expect(markGenes(words, ["A", "B", "C"], { gene: 2, locked: [1] }, 4, marks)).toBe(true);
    expect([...marks]).toEqual([0, kLocked, kHighlighted, kLocked, kHighlighted | kSelected, kHighlighted]);
  });

  it("of a rule mark its own genes only", () => {
    const marks = new Uint8Array(6).fill(255);
    markGenes(words, ["A", "B", "C"], { rule: "C", locked: [] }, null, marks);
    expect([...marks]).toEqual([0, 0, kHighlighted, kHighlighted, 0, kHighlighted]);
    expect(markGenes(words, ["A"], { rule: "D", locked: [99, -1] }, 77, marks)).toBe(false);
    expect([...marks]).toEqual([0, 0, 0, 0, 0, 0]);
  });

  it("reach children that come before their parents, and end in loops", () => {
    const marks = new Uint8Array(4);
    markGenes(new Int32Array([0, 1, 0, 2, 0, -1, 0, 3]), [], { gene: 2, locked: [] }, null, marks);
    expect([...marks]).toEqual([1, 1, 1, 0]);
    markGenes(new Int32Array([0, 1, 0, 0]), [], { gene: 0, locked: [] }, null, new Uint8Array(2));
  });
});

describe("parts", () => {
  const table = decodeMeshes(meshMessage(1, treeMeshes()));

  it("draws one call per mesh, whatever the order of instances, and reuses its buffers", () => {
    const parts = new Parts(false, kForMovement);
    parts.setMeshes(table);
    const big = decodeModel(treeModel(3000), 4);
    parts.setModel(big, table);
    const geometryOf = (object: unknown): Drawn => (object as { geometry: Drawn }).geometry;
    const counts = parts.group.children.map((mesh) => {
      const { attributes: { range, copy }, instanceCount: packs } = geometryOf(mesh), copies = copy.array.at(-1)! + 1;
      for (let i = 0; i < packs; ++i) expect([...range.array.slice(2 * i, 2 * i + 2)]).toEqual([range.array[0]! + i * copies, range.array[1]]);
      const count = packs === 0 ? 0 : range.array[1]! - range.array[0]!;
      expect(packs).toBe(Math.ceil(count / copies));
      return count;
    });
    expect(counts).toHaveLength(4);
    expect(counts.reduce((a, b) => a + b)).toBe(big.instances);
    const before = [...parts.group.children];
    const frame = (x: number): number[] => [1, 0, 0, 0, 2, 0, 0, 0, 1, x, 1, 0];
    const small = decodeModel(modelMessage({
      instances: [
        { frame: frame(1), mesh: 1, top: 0.5, gene: 3, material: 1, layer: 2 }, { frame: frame(2), mesh: 0, top: 7 },
        { frame: frame(3), mesh: 1, top: -1 },
        { frame: frame(99), mesh: 0, layer: 1 },
      ],
      materials: [new Array<number>(12).fill(0.25), new Array<number>(12).fill(0.5)],
      genes: [[0, -1], [0, 0], [0, 0], [0, 0]],
    }), 4);
    const box = parts.setModel(small, table);
    expect([...parts.group.children]).toEqual(before);
    const boxes = geometryOf(before[0]), cones = geometryOf(before[1]);
    expect([...boxes.attributes.range.array.slice(0, 2), ...cones.attributes.range.array.slice(0, 2)]).toEqual([0, 2, 2, 4]);
    // Of a pack that is not full, what there is.
    expect(cones.drawRange.count).toBe(2 * table.meshes[1]!.indices.length);
    const uniforms = parts.material.uniforms as { uInstances: { value: { image: { data: Float32Array } } } };
    const record = (i: number): number[] => [...uniforms.uInstances.value.image.data.slice(16 * i, 16 * i + 16)];
    expect(record(2)).toEqual([...frame(1), 0.5, 3, 1, 2]);
    expect(record(3)[12]).toBe(0);
    expect(record(0)[12]).toBe(1);
    expect(box).toEqual({ min: [0.5, 0, -0.5], max: [3.5, 2, 0.5] });
  });

  it("has a dark patch below what stands on the ground", () => {
    const instances = [{ frame: [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0] },
      { frame: [1, 0, 0, 0, 1, 0, 0, 0, 1, 6, 40, 0] }];
    const model = decodeModel(modelMessage({ instances }), 4),
      box = { min: [-0.5, 0, -0.5], max: [6.5, 40.5, 0.5] } as const;
    const patch = new Uint8Array(kContactCells ** 2);
    contactPatch(model, table.meshes.map(extentOf), box as never, new Float32Array(kContactCells ** 2), patch);
    const { x, z, side } = contactSquare(box as never);
    const at = (px: number, pz: number): number =>
      patch[Math.floor((pz - z) / side * kContactCells + kContactCells / 2) * kContactCells +
        Math.floor((px - x) / side * kContactCells + kContactCells / 2)]!;
    expect(at(0, 0)).toBeGreaterThan(60);
    expect(at(6, 0)).toBeLessThan(40);
    expect(at(3, 4)).toBe(0);
  });
});

describe("field", () => {
  it("points along the nearest curve, and fades away from it", () => {
    const field = fieldOf([{ points: [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]] },
      { points: [[4, 0, 0], [5, 0, 0], [6, 0, 0], [7, 0, 0]] }]);
    expect(field.length / kFieldFloats).toBeGreaterThan(500);
    expect(field.length / kFieldFloats).toBeLessThan(14000);
    for (let i = 0; i < field.length; i += kFieldFloats) {
      const [x, y, , dx, dy, , strength] = field.subarray(i, i + kFieldFloats);
      if (x! < 1 && y! > 0 && y! < 3) expect(dy).toBeCloseTo(1);
      if (x! > 5) expect(dx).toBeCloseTo(1);
      expect(strength).toBeLessThanOrEqual(1);
    }
    expect(fieldOf([])).toHaveLength(0);
    expect(fieldOf([{ points: [[1, 1, 1], [1, 1, 1], [1, 1, 1], [1, 1, 1]] }]).every(Number.isFinite)).toBe(true);
  });
});

describe("tubes", () => {
  it("are as thick as their curves say, and only there", () => {
    const line = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]] as never;
    const { positions, normals, indices } = tubeArrays([{ points: line, thickness: [0.5, 0.1] }, { points: line },
      { points: line, thickness: [0, 0] }]);
    expect(Math.hypot(positions[1]!, positions[2]!)).toBeCloseTo(0.5);
    expect(Math.hypot(positions.at(-2)!, positions.at(-1)!)).toBeCloseTo(0.1);
    expect(normals).toHaveLength(positions.length);
    expect(Math.max(...indices)).toBe(positions.length / 3 - 1);
    expect(tubeArrays([{ points: line }]).indices).toHaveLength(0);
  });
});

describe("strokes", () => {
  const eye = eyeOf({ target: [0, 0, 0], distance: 5, azimuth: 0, elevation: 0 }, 400, 300);

  it("grow, and leave out what is no number", () => {
    const strokes = new Strokes();
    for (let i = 0; i < 2000; ++i) strokes.dot(i, 1, 2, [1, 0, 0]);
    strokes.dot(NaN, 0, 1, [1, 1, 1]);
    expect(strokes.count).toBe(2000);
    expect(strokes.data[1999 * kStrokeFloats]).toBe(1999);
    strokes.clear();
    expect(strokes.count).toBe(0);
  });

  it("are cut off behind the camera", () => {
    expect(clipped(eye, [0, 0, 6], [0, 0, 7])).toBeNull();
    const cut = clipped(eye, [0.5, 0, 0], [0.5, 0, 20])!;
    expect(cut.every(Number.isFinite)).toBe(true);
    const s = project(eye, [0.5, 0, 0]);
    expect(cut[0]).toBeCloseTo(s.x);
    expect(cut[2]).toBeGreaterThan(400);
  });
});
