// What the checker says, at the places of the text as it stands now.
import type { Diagnostic } from "@codemirror/lint";
import type { Problem } from "../api";
import { changeBetween, movedPlace } from "./changes";

/** `checkedText`: the text that the problems speak of; null: unknown, taken for the present one. Problems of imported files,
 *  and such without a place, have none in the text. */
export function toDiagnostics(problems: readonly Problem[], checkedText: string | null, text: string): Diagnostic[] {
  const change = checkedText === null ? null : changeBetween(checkedText, text);
  const inside = (at: number) => Math.max(0, Math.min(text.length, at));
  const out: Diagnostic[] = [];
  for (const problem of problems) {
    if (problem.at === undefined || problem.file !== undefined) continue;
    const from = inside(movedPlace(change, problem.at.from));
    let to = Math.max(from, inside(movedPlace(change, problem.at.to)));
    // Something must be visible, but no line end.
    if (to === from && to < text.length && text[to] !== "\n") to += 1;
    out.push({
      from,
      to,
      severity: problem.severity === "note" ? "info" : problem.severity,
      source: problem.code,
      message: problem.help === undefined ? problem.text : `${problem.text}\n${problem.help}`,
    });
  }
  return out.sort((a, b) => a.from - b.from || a.to - b.to);
}
