// What can be folded: a block whose brace ends a line, and comments of several lines.
import { foldService } from "@codemirror/language";
import type { EditorState } from "@codemirror/state";

export function foldAt(state: EditorState, lineStart: number): { from: number; to: number } | null {
  const line = state.doc.lineAt(lineStart);
  const code = withoutComment(line.text);
  if (/[{([]$/.test(code)) {
    const to = closing(state, line.from + code.length - 1);
    return to !== null && state.doc.lineAt(to).number > line.number ? { from: line.from + code.length, to } : null;
  }
  const comment = /^\s*#/;
  if (!comment.test(line.text) || (line.number > 1 && comment.test(state.doc.line(line.number - 1).text))) return null;
  let last = line.number;
  while (last < state.doc.lines && comment.test(state.doc.line(last + 1).text)) last += 1;
  return last > line.number ? { from: line.to, to: state.doc.line(last).to } : null;
}

/** The line up to its comment, blanks at the end removed. A `#` in a text is no comment. */
export function withoutComment(line: string): string {
  let quoted = false;
  for (let i = 0; i < line.length; ++i) {
    if (line[i] === '"') quoted = !quoted;
    else if (line[i] === "#" && !quoted) return line.slice(0, i).trimEnd();
  }
  return line.trimEnd();
}

/** Place of the bracket that closes the one at `open`. */
function closing(state: EditorState, open: number): number | null {
  let depth = 0;
  for (let number = state.doc.lineAt(open).number; number <= state.doc.lines; ++number) {
    const line = state.doc.line(number);
    const code = withoutComment(line.text);
    let quoted = false;
    for (let i = Math.max(0, open - line.from); i < code.length; ++i) {
      const character = code[i]!;
      if (character === '"') quoted = !quoted;
      if (quoted) continue;
      if ("{([".includes(character)) depth += 1;
      else if ("})]".includes(character) && --depth === 0) return line.from + i;
    }
  }
  return null;
}

export const espalierFolding = foldService.of((state, from) => foldAt(state, from));
