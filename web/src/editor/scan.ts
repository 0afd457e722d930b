// A quick reading of a grammar's text as it stands, right or wrong: tokens, declarations, and which names a place sees. The
// checker on the server knows better, but it does not know the text of this very moment.
import { findWord } from "./words";

export type TokenKind = "word" | "number" | "string" | "punctuation";

export interface Token {
  kind: TokenKind;
  text: string;
  from: number;
  to: number;
}

const kToken = /#[^\n]*|"[^"\n]*"?|(?:\d+(?:\.(?!\.)\d*)?(?:[eE][+-]?\d+)?)(?:deg|rad|mm|cm|m|%)?(?![A-Za-z_0-9])|\d+|[A-Za-z_]\w*|->|\.\.|[<>=!]=|[^\s]/g;

/** Longer texts are not read here: keys shall not wait for that. */
export const kMostScanned = 400_000;

/** Comments are left out. */
export function scan(text: string): Token[] {
  const out: Token[] = [];
  if (text.length > kMostScanned) return out;
  for (const match of text.matchAll(kToken)) {
    const word = match[0];
    const first = word[0]!;
    if (first === "#") continue;
    const kind = /[A-Za-z_]/.test(first) ? "word" : /\d/.test(first) ? "number" : first === '"' ? "string" : "punctuation";
    out.push({ kind, text: word, from: match.index, to: match.index + word.length });
  }
  return out;
}

export type DeclarationKind = "rule" | "detail" | "attr" | "const" | "fn" | "material" | "mesh";

export interface Declaration {
  kind: DeclarationKind;
  name: string;
  /** Of the name. */
  nameFrom: number;
  nameTo: number;
  from: number;
  to: number;
  /** Index of its first and one past its last token. */
  first: number;
  end: number;
}

const kDeclares = new Set(["rule", "detail", "attr", "const", "fn", "material", "mesh"]);
const kBegins = new Set(["rule", "detail", "attr", "const", "fn", "material", "mesh", "import", "start", "grammar"]);

/** What is declared, in the order of the text. A declaration ends where the next one begins outside of braces. A brace that is
 *  missing is made up for at the next `rule`, or `detail` with a body, at the beginning of a line. */
export function declarations(text: string, tokens: readonly Token[] = scan(text)): Declaration[] {
  const out: Declaration[] = [];
  let depth = 0;
  let open: Declaration | null = null;
  const close = (index: number) => {
    if (open === null) return;
    open.end = index;
    open.to = tokens[index - 1]?.to ?? open.to;
    out.push(open);
    open = null;
  };
  tokens.forEach((token, i) => {
    const lineStart = token.from === 0 || text[token.from - 1] === "\n";
    if (token.kind === "word" && kBegins.has(token.text) && (depth === 0 || (lineStart && token.text === "rule"))) {
      depth = 0;
      close(i);
      const name = tokens[i + 1];
      if (kDeclares.has(token.text) && name?.kind === "word")
        open = {
          kind: token.text as DeclarationKind, name: name.text, nameFrom: name.from, nameTo: name.to, from: token.from, to: name.to,
          first: i, end: i,
        };
    } else if (token.text === "{") depth += 1;
    else if (token.text === "}") depth = Math.max(0, depth - 1);
  });
  close(tokens.length);
  return out;
}

export function declarationAt(all: readonly Declaration[], at: number): Declaration | null {
  return all.find((one) => one.from <= at && at <= one.to) ?? null;
}

/** The rule or detail that holds the place. */
export function ruleAt(text: string, at: number): string | null {
  const found = declarationAt(declarations(text), at);
  return found !== null && (found.kind === "rule" || found.kind === "detail") ? found.name : null;
}

export interface LocalName {
  kind: "draw" | "let" | "loop" | "parameter";
  name: string;
  /** One line as it is written. */
  signature: string;
  from: number;
  to: number;
}

/** Draws, lets, loop variables and parameters that the place sees; the start rule's own at its top are seen everywhere. */
export function namesInScope(text: string, at: number): LocalName[] {
  const tokens = scan(text);
  const all = declarations(text, tokens);
  const here = declarationAt(all, at);
  const names = here === null ? [] : namesOf(text, tokens, here, at);
  const starts = tokens.findIndex((token, i) => token.text === "start" && tokens[i + 1]?.kind === "word");
  const start = all.find((one) => one.kind === "rule" && one.name === tokens[starts + 1]?.text);
  if (starts >= 0 && start !== undefined && start !== here) names.push(...namesOf(text, tokens, start, start.to));
  return names;
}

/** Names of a declaration that are visible at `at`: those whose block is still open there. */
function namesOf(text: string, tokens: readonly Token[], declaration: Declaration, at: number): LocalName[] {
  const stack: LocalName[][] = [[]];
  let pending: LocalName[] = [];
  const named = (kind: LocalName["kind"], token: Token, to: number): LocalName => ({
    kind, name: token.text, from: token.from, to: token.to, signature: text.slice(token.from, to).replace(/\s+/g, " ").trim(),
  });
  let i = declaration.first + 2;
  if (tokens[i]?.text === "(" && declaration.kind !== "attr") {
    for (i += 1; i < declaration.end && tokens[i]!.text !== ")"; ++i)
      if (tokens[i]!.kind === "word") stack[0]!.push(named("parameter", tokens[i]!, tokens[i]!.to));
  }
  let top: LocalName[] | null = null;
  for (; i < declaration.end && tokens[i]!.from < at; ++i) {
    const token = tokens[i]!;
    const next = tokens[i + 1];
    if (token.text === "{") {
      stack.push(pending);
      pending = [];
    } else if (token.text === "}") {
      if (stack.length === 2) top = stack[1]!;
      if (stack.length > 1) stack.pop();
    } else if (token.text === "for" && next?.kind === "word") pending = [named("loop", next, next.to)];
    else if (token.text === "let" && next?.kind === "word" && next.to < at) stack.at(-1)!.push(named("let", next, endOfLine(text, next.to)));
    else if (token.kind === "word" && next?.text === "~" && next.from < at && findWord(token.text) === undefined)
      stack.at(-1)!.push(named("draw", token, endOfCall(text, tokens, i + 2)));
  }
  // At the end of the start rule its own top level counts.
  return at >= declaration.to && top !== null ? [...stack[0]!, ...top] : stack.flat();
}

function endOfLine(text: string, from: number): number {
  const end = text.indexOf("\n", from);
  return Math.min(end < 0 ? text.length : end, from + 80);
}

function endOfCall(text: string, tokens: readonly Token[], at: number): number {
  let depth = 0;
  for (let i = at; i < tokens.length && i < at + 100; ++i) {
    const token = tokens[i]!;
    if (token.text === "(") depth += 1;
    if (token.text === ")" && --depth === 0) return token.to;
    if (depth === 0 && i > at) return tokens[i - 1]!.to;
  }
  return tokens[at]?.to ?? text.length;
}

/** What a word is within its rule: a draw or let where it is made, too. */
export function localAt(text: string, tokens: readonly Token[], word: Token): LocalName | undefined {
  const next = tokens[tokens.indexOf(word) + 1];
  const seenFrom = next?.text === "~" ? next.to : word.to + 1;
  return namesInScope(text, seenFrom).filter((one) => one.name === word.text).at(-1);
}

/** Where the name that stands at `at` is declared. */
export function definitionOf(text: string, at: number): { from: number; to: number } | null {
  const tokens = scan(text);
  const word = tokens.find((token) => token.kind === "word" && token.from <= at && at <= token.to);
  if (word === undefined) return null;
  const local = localAt(text, tokens, word);
  if (local !== undefined) return { from: local.from, to: local.to };
  const own = declarations(text, tokens).find((one) => one.name === word.text);
  return own === undefined ? null : { from: own.nameFrom, to: own.nameTo };
}

/** The comment lines right before a place at the beginning of a line. */
export function commentBefore(text: string, from: number): string {
  const lines = text.slice(0, from).split("\n");
  lines.pop();
  const out: string[] = [];
  for (let line = lines.pop(); line !== undefined && line.trimStart().startsWith("#"); line = lines.pop())
    out.unshift(line.trim().replace(/^#\s?/, ""));
  return out.join(" ");
}

/** Where a `mesh` line belongs: after the last of them, else before the first declaration that is not an import or const. */
export function placeForMesh(text: string): number {
  const tokens = scan(text);
  const last = declarations(text, tokens).filter((one) => one.kind === "mesh").at(-1);
  if (last !== undefined) return lineEnd(text, last.to);
  const header = tokens.findIndex((token) => token.text === "grammar");
  const version = tokens[header + 2];
  return header >= 0 && version !== undefined ? lineEndOfComments(text, version.to) : 0;
}

function lineEnd(text: string, from: number): number {
  const end = text.indexOf("\n", from);
  return end < 0 ? text.length : end + 1;
}

/** After the line, and the comment lines that follow it. */
function lineEndOfComments(text: string, from: number): number {
  let at = lineEnd(text, from);
  while (text[at] === "#") at = lineEnd(text, at);
  return at;
}

/** A name for a mesh of a file that the grammar does not use yet: `Old tree.obj` -> `old_tree`. */
export function meshName(text: string, file: string): string {
  const stem = file.replace(/\.[^.]*$/, "").toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_+|_+$/g, "") || "shape";
  const base = /^\d/.test(stem) ? `mesh_${stem}` : stem;
  const taken = new Set(scan(text).filter((token) => token.kind === "word").map((token) => token.text));
  for (let n = 1; ; ++n) {
    const name = n === 1 ? base : `${base}_${n}`;
    if (!taken.has(name) && findWord(name) === undefined) return name;
  }
}
