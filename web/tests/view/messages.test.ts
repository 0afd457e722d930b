import { describe, expect, it } from "vitest";
import { decodeCloud, decodeMeshes, decodeModel, MessageError } from "../../src/view/messages";
import { cloudMessage, meshMessage, modelMessage, treeMeshes, treeModel } from "./synthetic";

const frame = [1, 0, 0, 0, 2, 0, 0, 0, 3, 4, 5, 6];

/** A copy with one word changed. */
function changed(message: ArrayBuffer, word: number, value: number): ArrayBuffer {
  const copy = message.slice(0);
  new DataView(copy).setUint32(4 * word, value, true);
  return copy;
}

describe("ESPG", () => {
  const message = meshMessage(7, treeMeshes());

  it("gives the meshes as they were written", () => {
    const table = decodeMeshes(message);
    expect(table.number).toBe(7);
    expect(table.meshes.map((m) => m.cone)).toEqual([false, true, false, false]);
    const leaf = table.meshes[3]!;
    expect([...leaf.positions]).toEqual([-0.5, 0, 0, 0, -0.5, 0, 0.5, 0, 0, 0, 0.5, 0]);
    expect([...leaf.normals.slice(0, 3)]).toEqual([0, 0, 1]);
    expect([...leaf.indices]).toEqual([0, 1, 2, 0, 2, 3]);
  });

  it("names what is wrong", () => {
    expect(() => decodeMeshes(new ArrayBuffer(0))).toThrow(/0 bytes, its head has 16/);
    expect(() => decodeMeshes(changed(message, 0, 0x4d505345))).toThrow(/"ESPM", not ESPG/);
    expect(() => decodeMeshes(changed(message, 1, 2))).toThrow(/version 2/);
    expect(() => decodeMeshes(changed(message, 3, 5000))).toThrow(/5000 meshes/);
    expect(() => decodeMeshes(changed(message, 3, 5))).toThrow(/ends before mesh 4 of 5/);
    expect(() => decodeMeshes(changed(message, 3, 3))).toThrow(/announces/);
    expect(() => decodeMeshes(changed(message, 4, 0xffffffff))).toThrow(/ends within mesh 0/);
    expect(() => decodeMeshes(changed(message, 6, 4))).toThrow(/kind 4/);
    const vertices = 24;
    expect(() => decodeMeshes(changed(message, 7 + vertices * 6,
      vertices))).toThrow(/has 24 vertices, a triangle names 24/);
  });
});

describe("ESPM", () => {
  const message = modelMessage({
    number: 3, table: 9, instances: [{ frame, top: 0.5, gene: 1, mesh: 2, material: 1, layer: 2 }, { frame }],
    bones: [{ from: [0, 0, 0], to: [0, 1, 0], gene: 1 }, { from: [0, 1, 0], to: [1, 1, 0], gene: 0, parent: 0 }],
    materials: [new Array<number>(12).fill(0), new Array<number>(12).fill(1)], genes: [[0, -1], [2, 0]],
  });

  it("gives views into the message", () => {
    const m = decodeModel(message, 3);
    expect([m.number, m.table, m.instances, m.bones, m.materials, m.genes]).toEqual([3, 9, 2, 2, 2, 2]);
    expect([...m.floats.slice(0, 13)]).toEqual([...frame, 0.5]);
    expect(m.words[13]).toBe(1);
    expect(m.words[14]).toBe(2 | 1 << 16);
    expect(m.boneWords[15]).toBe(0);
    expect(m.boneWords[7]! | 0).toBe(-1);
    expect([...m.geneWords]).toEqual([0, -1, 2, 0]);
    expect(m.floats.buffer).toBe(message);
  });

  it("reads a model without anything", () => {
    expect(decodeModel(modelMessage({ instances: [], materials: [], genes: [] }), 0).instances).toBe(0);
  });

  it("refuses indices that lead nowhere", () => {
    expect(() => decodeModel(message, 2)).toThrow(/instance 0 names gene 1 of 2, mesh 2 of 2/);
    expect(() => decodeModel(changed(message, 8 + 13, 2), 3)).toThrow(/gene 2 of 2/);
    expect(() => decodeModel(changed(message, 8 + 14, 2 << 16), 3)).toThrow(/material 2 of 2/);
    expect(() => decodeModel(changed(message, 8 + 15, 3), 3)).toThrow(/layer 3/);
    const bone = 8 + 32;
    expect(() => decodeModel(changed(message, bone + 6, 2), 3)).toThrow(/bone 0 names gene 2 of 2/);
    expect(() => decodeModel(changed(message, bone + 7, -2), 3)).toThrow(/bone -2 of 2/);
    const gene = bone + 16 + 24;
    expect(() => decodeModel(changed(message, gene + 1, 2), 3)).toThrow(/gene 0 stands on gene 2 of 2/);
  });

  it("refuses every length but its own, and counts that do not fit", () => {
    for (let bytes = 0; bytes < message.byteLength; bytes += 4) {
      expect(() => decodeModel(message.slice(0, bytes), 3), `${bytes}`).toThrow(MessageError);
    }
    expect(() => decodeModel(message.slice(0, 33), 3)).toThrow(/whole words/);
    for (const word of [3, 4, 5, 6]) expect(() => decodeModel(changed(message, word, 0xffffffff),
      3)).toThrow(/announces/);
  });

  it("reads a large tree whole", () => {
    const m = decodeModel(treeModel(2000), 4);
    expect(m.instances).toBeGreaterThanOrEqual(2000);
    expect(m.bones).toBeGreaterThan(100);
  });
});

describe("ESPC", () => {
  const message = cloudMessage("Böugh", [[1, 2, 3, 0], [4, 5, 6, 2]]);

  it("gives rule and points", () => {
    const cloud = decodeCloud(message);
    expect(cloud.rule).toBe("Böugh");
    expect([...cloud.floats.slice(4, 7)]).toEqual([4, 5, 6]);
    expect(cloud.words[7]).toBe(2);
  });

  it("refuses what does not fit", () => {
    expect(() => decodeCloud(message.slice(0, 24))).toThrow(MessageError);
    expect(() => decodeCloud(changed(message, 2, 0xffffffff))).toThrow(/announces/);
    expect(() => decodeCloud(changed(message, 4 + 2 + 3, 3))).toThrow(/kind 3/);
  });
});
