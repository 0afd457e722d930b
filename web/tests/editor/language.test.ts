// @vitest-environment node
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { StringStream } from "@codemirror/language";
import { EditorState } from "@codemirror/state";
import { describe, expect, test } from "vitest";
import { foldAt } from "../../src/editor/folding";
import { espalierLanguage, readToken } from "../../src/editor/language";
import { declarations, scan } from "../../src/editor/scan";
import { DECLARATION_WORDS, STATEMENT_WORDS, WORDS } from "../../src/editor/words";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const read = (path: string) => readFileSync(root + path, "utf8");

/** Pairs of text and style, blanks left out. */
function styles(text: string): [string, string | null][] {
  const state = { before: "", inComp: 0, depth: 0 };
  const out: [string, string | null][] = [];
  for (const line of text.split("\n")) {
    const stream = new StringStream(line, 2, 2);
    while (!stream.eol()) {
      stream.start = stream.pos;
      const style = readToken(stream, state);
      if (stream.pos === stream.start) throw new Error(`stuck at ${stream.pos} of ${line}`);
      if (stream.current().trim() !== "") out.push([stream.current(), style]);
    }
  }
  return out;
}

/** All grammars that ship, and those of docs/language.md. */
function allGrammars(): [string, string][] {
  const shipped = readdirSync(`${root}grammars`).filter((name) => name.endsWith(".esp"));
  const examples = [...read("docs/language.md").matchAll(/```esp\n([\s\S]*?)```/g)].map((match, i): [string, string] => [`example ${i}`, match[1]!]);
  return [...shipped.map((name): [string, string] => [name, read(`grammars/${name}`)]), ...examples];
}

describe("tokens", () => {
  test("of a declaration", () => {
    expect(styles('attr tall in 1..5 by 50cm = 2 "Tower/Height" # x')).toEqual([
      ["attr", "keyword"], ["tall", "definition"], ["in", "keyword"], ["1", "number"], ["..", "operator"], ["5", "number"], ["by", "keyword"],
      ["50", "number"], ["cm", "unit"], ["=", "operator"], ["2", "number"], ['"Tower/Height"', "string"], ["# x", "comment"],
    ]);
  });

  test("of a rule", () => {
    expect(styles("rule Twig(k) when depth(Twig) < 3 { bend ~ uniform(-30deg, 1e-3) spawn Twig else detail Leaf }")).toEqual([
      ["rule", "keyword"], ["Twig", "ruleDefinition"], ["(", "bracket"], ["k", "variable"], [")", "bracket"], ["when", "keyword"], ["depth", "atom"],
      ["(", "bracket"], ["Twig", "variable"], [")", "bracket"], ["<", "operator"], ["3", "number"], ["{", "bracket"], ["bend", "draw"],
      ["~", "operator"], ["uniform", "distribution"], ["(", "bracket"], ["-", "operator"], ["30", "number"], ["deg", "unit"], [",", "operator"],
      ["1e-3", "number"], [")", "bracket"], ["spawn", "keyword"], ["Twig", "ruleName"], ["else", "keyword"], ["detail", "keyword"],
      ["Leaf", "ruleName"], ["}", "bracket"],
    ]);
  });

  test("of faces, which are names elsewhere", () => {
    const found = styles("comp { top: { emit box } sides: { } } top");
    expect(found.filter(([text]) => text === "top" || text === "sides").map(([, style]) => style)).toEqual(["face", "face", "variable"]);
  });

  test("of what is no part of the language", () => {
    expect(styles('"open')).toEqual([['"open', "invalid"]]);
    expect(styles("a @ b").map(([, style]) => style)).toEqual(["variable", "invalid", "variable"]);
  });

  test.each(allGrammars())("of %s are all known", (_name, text) => {
    expect(styles(text).filter(([, style]) => style === "invalid" || style === null)).toEqual([]);
  });

  test("there are grammars", () => expect(allGrammars().length).toBeGreaterThan(40));
});

describe("words", () => {
  test("are those of the language's own list", () => {
    const source = read("src/grammar/words.cpp");
    const builtins = [...source.matchAll(/Builtin\{"(\w+)"/g)].map((match) => match[1]!);
    const table = (name: string) => {
      const body = new RegExp(`${name} = [^{]*\\{([^}]*)\\}`).exec(source)![1]!;
      return [...body.matchAll(/"([a-z]+)"/g)].map((word) => word[1]!);
    };
    const own = WORDS.filter((word) => word.sort !== "axis").map((word) => word.name);
    expect(own.toSorted()).toEqual([...builtins, ...table("kKeywords")].toSorted());
    expect([...STATEMENT_WORDS].toSorted()).toEqual(table("kStatementWords").toSorted());
    expect([...DECLARATION_WORDS].toSorted()).toEqual(table("kDeclarationWords").toSorted());
  });
});

describe("scanning", () => {
  test.each(allGrammars())("%s: declarations are those that begin lines, and cover their blocks", (_name, text) => {
    const expected = [...text.matchAll(/^(rule|detail|attr|const|fn|material|mesh) (\w+)/gm)].map((match) => `${match[1]} ${match[2]}`);
    const found = declarations(text);
    expect(found.map((one) => `${one.kind} ${one.name}`)).toEqual(expected);
    for (const one of found.filter(({ kind }) => kind === "rule" || kind === "detail")) expect(text[one.to - 1]).toBe("}");
  });

  test("texts that are too long have no tokens, and nothing fails for it", () => {
    const long = `rule A { }\n${" ".repeat(400_000)}`;
    expect(scan(long)).toEqual([]);
    expect(declarations(long)).toEqual([]);
  });

  test("ranges are no decimals", () => {
    expect(scan("1..5 0.5..2.5").map((token) => token.text)).toEqual(["1", "..", "5", "0.5", "..", "2.5"]);
  });
});

describe("folding", () => {
  const state = EditorState.create({ doc: '# a {\n# b\nrule R {\n  x { # }\n    "}"\n  }\n}\nrule S { }\n' });
  const fold = (line: number) => {
    const range = foldAt(state, state.doc.line(line).from);
    return range === null ? null : state.sliceDoc(range.from, range.to);
  };

  test("goes from brace to brace, whatever comments and texts hold", () => {
    expect(fold(3)).toBe('\n  x { # }\n    "}"\n  }\n');
    expect(fold(4)).toBe(' # }\n    "}"\n  ');
    expect(fold(8)).toBeNull();
  });

  test("takes comments of several lines together", () => {
    expect(fold(1)).toBe("\n# b");
    expect(fold(2)).toBeNull();
  });

  test("needs a closing brace", () => {
    expect(foldAt(EditorState.create({ doc: "rule R {\n x" }), 0)).toBeNull();
  });
});

test("the language indents by braces", () => {
  expect(espalierLanguage.name).toBe("espalier");
});
