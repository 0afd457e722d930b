import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import type { Symbol } from "../api";
import { declarationAt, declarations, namesInScope, scan, type Token } from "./scan";
import { DECLARATION_WORDS, FACES, STATEMENT_WORDS, WORDS, type Word } from "./words";

/** What may stand at a place, told by the token before it. */
export type Expected = "rule" | "detail" | "distribution" | "material" | "mesh" | "axis" | "declaration" | "statement" | "value" | "name" | "nothing";

const kAxisAfter = new Set(["mirror", "around", "split", "reflect", "aim"]);
const kNameAfter = new Set(["rule", "attr", "const", "fn", "let", "for", "grammar"]);
const kValueAfter = new Set([
  "move", "turn", "scale", "size", "resize", "forward", "yaw", "pitch", "roll", "extrude", "reseed", "bone", "if", "when", "maybe",
  "in", "by", "and", "or", "not", "mod", "toward", "at", "repeat", "limit",
]);

/** `before`: the tokens that end before the word which is being typed; `inBlock`: within braces. */
export function expectedAfter(before: readonly Token[], inBlock: boolean): Expected {
  const last = before.at(-1);
  if (last === undefined) return "declaration";
  const text = last.text;
  if (text === "~") return before.at(-2)?.kind === "word" ? "distribution" : "value";
  if (text === "spawn" || text === "start") return "rule";
  if (text === "detail") return inBlock ? "detail" : "name";
  if (text === "paint") return "material";
  if (text === "emit") return "mesh";
  if (kAxisAfter.has(text)) return "axis";
  if (kNameAfter.has(text)) return "name";
  if (text === "mesh" || text === "material") return "name";
  if (kValueAfter.has(text)) return "value";
  if (last.kind === "punctuation" && !["{", "}", ")", "]"].includes(text)) return "value";
  return inBlock ? "statement" : "declaration";
}

const kTypes: Record<Word["sort"], string> = {
  keyword: "keyword", value: "constant", distribution: "function", function: "function", primitive: "class", surface: "function",
  texture: "function", axis: "property",
};

function ofWord(word: Word, boost: number): Completion {
  return { label: word.name, detail: word.signature === word.name ? "" : word.signature.slice(word.name.length), info: word.text, type: kTypes[word.sort], boost };
}

const kSymbolTypes: Record<string, string> = {
  rule: "type", detail: "interface", attr: "property", const: "constant", fn: "function", material: "enum", mesh: "class", texture: "enum",
};

/** All that can be typed at the place, the likely first. */
export function completionsAt(text: string, at: number, symbols: readonly Symbol[]): Completion[] {
  const tokens = scan(text);
  const word = tokens.find((token) => token.kind === "word" && token.from < at && at <= token.to);
  const before = tokens.filter((token) => token.to <= (word?.from ?? at));
  const all = declarations(text, tokens);
  const here = declarationAt(all, at);
  let depth = 0;
  for (const token of before) if (here === null || token.from >= here.from) depth += token.text === "{" ? 1 : token.text === "}" ? -1 : 0;
  const expected = expectedAfter(before, depth > 0);
  if (expected === "name" || expected === "nothing") return [];

  const known = new Map(symbols.map((symbol) => [symbol.name, symbol]));
  const declared = all
    .filter((one) => one !== here || one.kind === "rule" || one.kind === "detail")
    .filter((one) => one.nameTo !== at)
    .map((one) => ({ kind: one.kind as string, name: one.name }));
  for (const symbol of symbols) if (!declared.some((one) => one.name === symbol.name)) declared.push(symbol);
  const ofSymbols = (kinds: readonly string[], boost: number): Completion[] =>
    declared
      .filter((one) => kinds.includes(one.kind))
      .map(({ kind, name }) => {
        const symbol = known.get(name);
        const detail = symbol?.signature.replace(new RegExp(`^${kind}\\s+${name}`), "").trim() ?? "";
        return {
          label: name, type: kSymbolTypes[kind] ?? "variable", detail: detail.length > 40 ? `${detail.slice(0, 39)}…` : detail, boost,
          ...(symbol?.comment ? { info: symbol.comment } : {}),
        };
      });
  const words = (sorts: readonly Word["sort"][], boost: number) =>
    WORDS.filter((one) => sorts.includes(one.sort)).map((one) => ofWord(one, boost));
  const keywords = (names: readonly string[], boost: number) =>
    WORDS.filter((one) => one.sort === "keyword" && names.includes(one.name)).map((one) => ofWord(one, boost));
  const locals = (boost: number): Completion[] =>
    namesInScope(text, word?.from ?? at).map((one) => ({ label: one.name, type: "variable", detail: one.signature.slice(one.name.length), boost }));

  switch (expected) {
    case "rule":
      return ofSymbols(["rule"], 0);
    case "detail":
      return ofSymbols(["detail"], 0);
    case "distribution":
      return words(["distribution"], 0);
    case "axis":
      return words(["axis"], 0);
    case "declaration":
      return keywords(DECLARATION_WORDS, 0);
    case "material":
      return [...ofSymbols(["material"], 3), ...words(["surface"], 2), ...locals(1), ...words(["function"], -1)];
    case "mesh":
      return [...ofSymbols(["mesh"], 3), ...words(["primitive"], 2), ...locals(1)];
    case "value":
      return [
        ...locals(3), ...ofSymbols(["attr", "const", "fn", "material", "mesh"], 1), ...words(["value", "axis"], 0),
        ...words(["function", "primitive", "surface", "texture"], 0), ...keywords(["true", "false", "not", "repeat"], -1),
      ];
    default:
      return [
        ...keywords(STATEMENT_WORDS, 2), ...locals(1), ...ofSymbols(["attr", "const", "fn"], 0), ...words(["value", "function", "axis"], -1),
        ...keywords(["else", "otherwise", "as", "and", "or", "mod", "in", "by", "at", "toward", "when", "limit"], -1),
        ...FACES.map((face): Completion => ({ label: face, type: "property", boost: -2 })),
      ];
  }
}

/** For autocompletion: nothing in comments and texts, nor in numbers. */
export function completionSource(symbols: () => readonly Symbol[]) {
  return (context: CompletionContext): CompletionResult | null => {
    const line = context.state.doc.lineAt(context.pos);
    const start = line.text.slice(0, context.pos - line.from);
    if (/#/.test(start.replace(/"[^"]*"/g, "")) || (start.split('"').length - 1) % 2 === 1) return null;
    const word = context.matchBefore(/[A-Za-z_]\w*/);
    if (word === null && !context.explicit && !/(?:spawn|detail|paint|emit|~|start)\s$/.test(start)) return null;
    if (word !== null && /\d$/.test(context.state.sliceDoc(Math.max(0, word.from - 1), word.from))) return null;
    const options = completionsAt(context.state.doc.toString(), context.pos, symbols());
    return options.length === 0 ? null : { from: word?.from ?? context.pos, options, validFor: /^\w*$/ };
  };
}
