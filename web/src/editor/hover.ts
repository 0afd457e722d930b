import type { Symbol } from "../api";
import { commentBefore, declarations, localAt, scan } from "./scan";
import { findWord } from "./words";

export interface HoverText {
  from: number;
  to: number;
  signature: string;
  text: string;
}

/** What is known of the word at a place: a name of the rule, a declaration, or a word of the language. */
export function hoverAt(text: string, at: number, symbols: readonly Symbol[]): HoverText | null {
  const tokens = scan(text);
  const word = tokens.find((token) => token.kind === "word" && token.from <= at && at < token.to);
  if (word === undefined) return null;
  const { from, to } = word;
  const local = localAt(text, tokens, word);
  if (local !== undefined)
    return { from, to, signature: local.signature, text: { draw: "A draw of this rule.", let: "", loop: "Counts the turns of the loop.", parameter: "A parameter." }[local.kind] };
  const symbol = symbols.find((one) => one.name === word.text);
  if (symbol !== undefined) return { from, to, signature: symbol.signature, text: symbol.comment ?? "" };
  const own = declarations(text, tokens).find((one) => one.name === word.text);
  if (own !== undefined)
    return { from, to, signature: (text.slice(own.from, own.to).split(/[\n{]/)[0] ?? "").trim(), text: commentBefore(text, own.from) };
  const known = findWord(word.text);
  return known === undefined ? null : { from, to, signature: known.signature, text: known.text };
}
