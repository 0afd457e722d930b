// Marks of genes: which are highlighted, selected, locked. One byte per gene, which the shaders read from a texture.
import type { Highlight } from "./host";

export const kHighlighted = 1, kSelected = 2, kLocked = 4;

/** `words`: rule and parent of each gene. A gene is marked with all that stands on it. Parents may come in any
 *  order; loops,  which no model has, end. */
export function markGenes(
  words: Int32Array, rules: readonly string[], highlight: Highlight, selected: number | null,
  marks: Uint8Array): boolean {
  const genes = words.length / 2;
  marks.fill(0, 0, genes);
  const rule = highlight.rule === undefined ? -1 : rules.indexOf(highlight.rule);
  let any = false;
  const set = (gene: number | null | undefined, mark: number): void => {
    if (gene === null || gene === undefined || !(gene >= 0 && gene < genes)) return;
    marks[gene]! |= mark;
  };
  set(highlight.gene, kHighlighted);
  set(selected, kSelected);
  for (const gene of highlight.locked) set(gene, kLocked);
  inherit(words, marks);
  for (let i = 0; i < genes; ++i) {
    if (rule >= 0 && words[2 * i] === rule) marks[i]! |= kHighlighted;
    any ||= (marks[i]! & (kHighlighted | kSelected)) !== 0;
  }
  return any;
}

/** Every gene gets the marks of those it stands on. A gene's way down to the root is walked once. */
function inherit(words: Int32Array, marks: Uint8Array): void {
  const genes = words.length / 2;
  const done = new Uint8Array(genes), path: number[] = [];
  for (let i = 0; i < genes; ++i) {
    let gene = i;
    while (gene >= 0 && !done[gene]) {
      done[gene] = 1;
      path.push(gene);
      gene = words[2 * gene + 1]!;
    }
    let mark = gene >= 0 ? marks[gene]! : 0;
    while (path.length > 0) {
      const top = path.pop()!;
      mark |= marks[top]!;
      marks[top] = mark;
    }
  }
}
