// Highlighting: a reader of one line at a time.
import { HighlightStyle, StreamLanguage, syntaxHighlighting, type StringStream } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import { FACES, findWord, type WordSort } from "./words";

interface LineState {
  /** The word before, as it decides what a name is. */
  before: string;
  inComp: number;
  depth: number;
}

const kSorts: Record<WordSort, string> = {
  keyword: "keyword", value: "atom", distribution: "distribution", function: "function", primitive: "primitive",
  surface: "function", texture: "function", axis: "axis",
};
const kRefers = new Set(["rule", "detail", "spawn", "start"]);
const kDeclares = new Set(["attr", "const", "fn", "material", "mesh", "grammar"]);

/** Name of the token's style, or null. */
export function readToken(stream: StringStream, state: LineState): string | null {
  if (stream.eatSpace()) return null;
  if (stream.match(/^#.*/)) return "comment";
  if (stream.match(/^"[^"]*"/)) return note(state, '"', "string");
  if (stream.match(/^".*/)) return note(state, '"', "invalid");
  if (stream.match(/^\d+(?:\.(?!\.)\d*)?(?:[eE][+-]?\d+)?(?=deg|rad|mm|cm|m|%)/)) return note(state, "0", "number");
  if (state.before === "0" && stream.match(/^(?:deg|rad|mm|cm|m|%)(?!\w)/)) return note(state, "unit", "unit");
  if (stream.match(/^\d+(?:\.(?!\.)\d*)?(?:[eE][+-]?\d+)?/)) return note(state, "1", "number");
  const match = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null;
  if (match) {
    const word = match[0];
    const before = state.before;
    state.before = word;
    if (word === "true" || word === "false") return "atom";
    const known = findWord(word);
    // `depth`, `top` and the like may be labels of arguments.
    if (known !== undefined) return kSorts[known.sort];
    if (kRefers.has(before)) return before === "rule" || (before === "detail" && state.depth === 0) ? "ruleDefinition" : "ruleName";
    if (kDeclares.has(before)) return "definition";
    if (state.inComp > 0 && state.depth === state.inComp && (FACES as readonly string[]).includes(word)) return "face";
    if (stream.match(/^\s*~(?!\d)/, false)) return "draw";
    if (stream.match(/^\s*\(/, false)) return "call";
    return "variable";
  }
  if (stream.match(/^(?:->|\.\.|[<>=!]=)/)) return note(state, "op", "operator");
  const character = stream.next()!;
  if (character === "{") {
    state.depth += 1;
    if (state.before === "comp") state.inComp = state.depth;
  } else if (character === "}") {
    if (state.inComp === state.depth) state.inComp = 0;
    state.depth = Math.max(0, state.depth - 1);
  }
  state.before = character;
  if ("{}()[]".includes(character)) return "bracket";
  return "+-*/^<>=?:~.,".includes(character) ? "operator" : "invalid";
}

function note(state: LineState, before: string, style: string): string {
  state.before = before;
  return style;
}

export const espalierLanguage = StreamLanguage.define<LineState>({
  name: "espalier",
  startState: () => ({ before: "", inComp: 0, depth: 0 }),
  copyState: (state) => ({ ...state }),
  token: readToken,
  indent: (state, after, context) => context.unit * Math.max(0, state.depth - (/^\s*\}/.test(after) ? 1 : 0)),
  languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: ["(", "[", "{", '"'] }, indentOnInput: /^\s*[}\])]$/ },
  tokenTable: {
    comment: tags.lineComment, string: tags.string, number: tags.number, unit: tags.unit, keyword: tags.keyword, atom: tags.atom,
    distribution: tags.standard(tags.function(tags.variableName)), function: tags.standard(tags.function(tags.variableName)),
    primitive: tags.standard(tags.variableName), axis: tags.propertyName, face: tags.propertyName,
    ruleDefinition: tags.definition(tags.typeName), ruleName: tags.typeName, definition: tags.definition(tags.variableName),
    draw: tags.definition(tags.variableName), call: tags.function(tags.variableName), variable: tags.variableName,
    bracket: tags.bracket, operator: tags.operator, invalid: tags.invalid,
  },
});

/** Colours are variables of the page's theme (styles/theme.css). */
export const espalierHighlighting = syntaxHighlighting(
  HighlightStyle.define([
    { tag: tags.lineComment, color: "var(--code-comment)", fontStyle: "italic" },
    { tag: tags.string, color: "var(--code-string)" },
    { tag: [tags.number, tags.atom], color: "var(--code-number)" },
    { tag: tags.unit, color: "var(--code-unit)" },
    { tag: tags.keyword, color: "var(--code-keyword)" },
    { tag: tags.standard(tags.function(tags.variableName)), color: "var(--code-function)" },
    { tag: tags.standard(tags.variableName), color: "var(--code-function)" },
    { tag: tags.function(tags.variableName), color: "var(--code-function)" },
    { tag: tags.propertyName, color: "var(--code-unit)" },
    { tag: tags.definition(tags.typeName), color: "var(--code-rule)", fontWeight: "600" },
    { tag: tags.typeName, color: "var(--code-rule)" },
    { tag: tags.definition(tags.variableName), color: "var(--code-name)", fontWeight: "600" },
    { tag: tags.variableName, color: "var(--code-name)" },
    { tag: [tags.operator, tags.bracket], color: "var(--code-operator)" },
    { tag: tags.invalid, color: "var(--bad)" },
  ]),
);
