// Files that become meshes of the grammar, however they came.
import { expect, test } from "vitest";
import { addMeshFiles } from "../../src/editor/drop_mesh";
import { Bench, settle } from "../fakes";

test("a mesh that is added gets its line in the grammar, as a step of its own", async () => {
  const bench = await new Bench().open('grammar a 1\nmesh chip = "chip.obj"\nstart A\n');
  const uploaded: string[] = [];
  bench.studio.files.upload = (_project, name) => {
    uploaded.push(name);
    return Promise.resolve();
  };
  void addMeshFiles(bench.studio, [new File(["v 0 0 0"], "Chip.obj")]);
  await settle();
  expect(uploaded).toEqual(["Chip.obj"]);
  expect(bench.edits()).toMatchObject([{ label: "Add mesh chip_2", grammar: 'grammar a 1\nmesh chip = "chip.obj"\nmesh chip_2 = "Chip.obj"\nstart A\n' }]);
  const line = bench.studio.grammar.value.slice(0, bench.studio.state.jump.value!.at.from);
  expect(line.endsWith('mesh chip_2 = "Chip.obj"')).toBe(true);
});
