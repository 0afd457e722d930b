// @vitest-environment node
import { CompletionContext } from "@codemirror/autocomplete";
import { EditorState } from "@codemirror/state";
import { describe, expect, test } from "vitest";
import type { Symbol } from "../../src/api";
import { completionsAt, completionSource } from "../../src/editor/completion";
import { hoverAt } from "../../src/editor/hover";
import { commentBefore, definitionOf, meshName, namesInScope, placeForMesh, ruleAt } from "../../src/editor/scan";

const grammar = `grammar tree 1
# of oak
attr tall in 1..5 = 2 "Tree/Height"
mesh trunk = cone(top: 0.6)
material bark = surface("#6b4f3a")
start Tree
rule Tree {
  wind ~ uniform(0, 1)
  spawn Twig(1)
}
# It bends.
rule Twig(thick) when depth < 8 {
  bend ~ uniform(-30deg, 30deg)
  let half = thick / 2
  for side in [-1, 1] { lean ~ angle()  turn z lean * side }
  turn z |
}
detail Leaf { emit leaf }
`;
const at = grammar.indexOf("|");
const text = grammar.replace("|", "");
const symbols: Symbol[] = [
  { kind: "rule", name: "Twig", signature: "rule Twig(thick)", comment: "It bends.", at: { from: 0, to: 1 } },
  { kind: "rule", name: "Imported", signature: "rule Imported", at: { from: 0, to: 1 } },
];

/** Labels at the end of `typed`, put at the marked place; the likely first. */
function labels(typed: string): string[] {
  return completionsAt(text.slice(0, at) + typed + text.slice(at), at + typed.length, symbols)
    .toSorted((a, b) => (b.boost ?? 0) - (a.boost ?? 0))
    .map((one) => one.label);
}

describe("completion", () => {
  test("after spawn and detail: rules and details, imported ones too", () => {
    expect(labels("0 spawn T").toSorted()).toEqual(["Imported", "Tree", "Twig"]);
    expect(labels("0 detail ")).toEqual(["Leaf"]);
  });

  test("after ~: distributions", () => {
    expect(labels("0 x ~ ").toSorted()).toEqual(["angle", "chance", "integer", "loguniform", "normal", "pick", "uniform"]);
  });

  test("after paint and emit: materials and meshes first", () => {
    expect(labels("0 paint ")[0]).toBe("bark");
    expect(labels("0 emit ")[0]).toBe("trunk");
    expect(labels("0 emit ")).toContain("sphere");
    expect(labels("0 emit ")).not.toContain("uniform");
  });

  test("where a value stands: names in scope first", () => {
    const found = labels("0 move ");
    expect(found.slice(0, 4).toSorted()).toEqual(["bend", "half", "thick", "wind"]);
    expect(found).toContain("tall");
    expect(found).not.toContain("lean");
    expect(found).not.toContain("side");
  });

  test("where a statement stands: statements; outside of braces: declarations", () => {
    expect(labels("0 m")).toEqual(expect.arrayContaining(["move", "maybe", "mirror"]));
    expect(completionsAt(`${text}\nru`, text.length + 3, []).map((one) => one.label)).toEqual(expect.arrayContaining(["rule", "attr"]));
    expect(completionsAt(`${text}\nru`, text.length + 3, []).map((one) => one.label)).not.toContain("move");
  });

  test("a new name is not completed", () => {
    expect(labels("0 let a")).toEqual([]);
    expect(completionsAt("grammar x 1\nrule T", 18, [])).toEqual([]);
  });

  test("shows what a rule takes, and its comment", () => {
    const twig = completionsAt(`${text.slice(0, at)}0 spawn ${text.slice(at)}`, at + 8, symbols).find((one) => one.label === "Twig")!;
    expect(twig.detail).toBe("(thick)");
    expect(twig.info).toBe("It bends.");
  });

  test("keeps out of comments, texts and numbers", () => {
    const ask = (line: string) => {
      const doc = `grammar a 1\nrule R { ${line}`;
      return completionSource(() => [])(new CompletionContext(EditorState.create({ doc }), doc.length, false));
    };
    expect(ask("mo")).not.toBeNull();
    expect(ask("# mo")).toBeNull();
    expect(ask('paint surface("mo')).toBeNull();
    expect(ask('paint surface("#ffffff") mo')).not.toBeNull();
    expect(ask("move 30de")).toBeNull();
    expect(ask("")).toBeNull();
    expect(ask("emit ")).not.toBeNull();
  });
});

describe("names", () => {
  test("in scope, with their lines", () => {
    expect(namesInScope(text, at).map((one) => `${one.kind} ${one.signature}`)).toEqual([
      "parameter thick", "draw bend ~ uniform(-30deg, 30deg)", "let half = thick / 2", "draw wind ~ uniform(0, 1)",
    ]);
    const inside = text.indexOf("lean * side");
    expect(namesInScope(text, inside).map((one) => one.name)).toEqual(["thick", "bend", "half", "side", "lean", "wind"]);
    expect(namesInScope(text, text.indexOf("emit leaf")).map((one) => one.name)).toEqual(["wind"]);
  });

  test("lead to their definitions", () => {
    const from = (needle: string, after = 0) => definitionOf(text, text.indexOf(needle, after) + 1)?.from;
    expect(from("Twig(1)")).toBe(text.indexOf("Twig(thick)"));
    expect(from("thick / 2")).toBe(text.indexOf("thick)"));
    expect(from("lean * side")).toBe(text.indexOf("lean ~"));
    expect(from("uniform")).toBeUndefined();
  });

  test("of the rule around a place", () => {
    expect(ruleAt(text, at)).toBe("Twig");
    expect(ruleAt(text, text.indexOf("emit leaf"))).toBe("Leaf");
    expect(ruleAt(text, 3)).toBeNull();
    expect(ruleAt("rule A {\n x {\n}\nrule B { }", 24)).toBe("B");
  });
});

describe("hovering", () => {
  test("tells of draws, symbols, declarations and words", () => {
    const hover = (needle: string) => hoverAt(text, text.indexOf(needle), symbols);
    expect(hover("bend ~")?.signature).toBe("bend ~ uniform(-30deg, 30deg)");
    expect(hover("Twig(1)")).toMatchObject({ signature: "rule Twig(thick)", text: "It bends." });
    expect(hover("tall in")).toMatchObject({ signature: 'attr tall in 1..5 = 2 "Tree/Height"', text: "of oak" });
    expect(hover("uniform(0, 1)")?.signature).toBe("uniform(a, b)");
    expect(hover("#6b4f3a")).toBeNull();
  });

  test("comments before a declaration are joined", () => {
    expect(commentBefore("a\n# one\n#two\nrule R", 13)).toBe("one two");
    expect(commentBefore("rule R", 0)).toBe("");
  });
});

describe("meshes that are dropped", () => {
  test("get a line after the other meshes, or after the head", () => {
    expect(text.slice(placeForMesh(text)).startsWith("material bark")).toBe(true);
    const head = "grammar a 1 # x\n# about\n\nrule R { }\n";
    expect(head.slice(placeForMesh(head))).toBe("\nrule R { }\n");
    expect(placeForMesh("")).toBe(0);
  });

  test("get a name that is free and allowed", () => {
    expect(meshName("", "Old Tree.OBJ")).toBe("old_tree");
    expect(meshName("mesh old_tree = box", "old tree.obj")).toBe("old_tree_2");
    expect(meshName("", "box.obj")).toBe("box_2");
    expect(meshName("", "3d.glb")).toBe("mesh_3d");
    expect(meshName("", "日.glb")).toBe("shape");
  });
});
