import { expect, test } from "vitest";
import { ModelLayer } from "../../src/view/model_layer";
import { kForMovement } from "../../src/view/coarse_mesh";
import { Parts } from "../../src/view/parts";
import type { Stage } from "../../src/view/stage";
import { isEmpty, type Box } from "../../src/view/vec";
import { meshMessage, treeMeshes, treeModel } from "./synthetic";

/** All of a stage that needs no graphics. */
function setup() {
  const casters: Box[] = [], patches: unknown[] = [], parts = new Parts(false, kForMovement);
  const stage = {
    parts, add: () => {}, setCasters: (box: Box) => casters.push(box),
    ground: { bytes: new Uint8Array(2 ** 16), setPatch: (square: unknown) => patches.push(square) },
  };
  return { layer: new ModelLayer(stage as unknown as Stage), parts, casters, patches };
}

const drawn = ({ group }: Parts): number => group.children.filter((child) => child.visible).length;

test("a model that is taken away leaves nothing to see, to pick or to stand on, and another may come", () => {
  const { layer, parts, casters, patches } = setup();
  layer.setMeshes(meshMessage(1, treeMeshes()));
  layer.setModel(treeModel(200));
  const { min, max } = layer.box, middle = min.map((low, i) => (low + max[i]!) / 2);
  const down = [middle[0]!, max[1] + 1, middle[2]!] as const;
  expect(drawn(parts)).toBeGreaterThan(0);
  expect(layer.pick(down, [0, -1, 0])).not.toBeNull();

  layer.clear();
  expect(drawn(parts)).toBe(0);
  expect([isEmpty(layer.box), isEmpty(casters.at(-1)!), patches.at(-1)]).toEqual([true, true, null]);
  expect(layer.bones.mesh.visible).toBe(false);
  expect(layer.pick(down, [0, -1, 0])).toBeNull();
  // Tables are numbered by project: one of before says nothing about the next model.
  expect(() => layer.setModel(treeModel(200))).toThrow("before the meshes");
  layer.setMeshes(meshMessage(1, treeMeshes()));
  layer.setModel(treeModel(200));
  expect(layer.pick(down, [0, -1, 0])).not.toBeNull();
});
