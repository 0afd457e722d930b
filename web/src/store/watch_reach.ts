import { effect } from "@preact/signals";
import { kTypingPause } from "./edit_queue";
import type { Studio } from "./studio";

/** Where the rule under the cursor can reach: asked when the cursor rests, and again as soon as a changed grammar was checked:
 * keys rested before that. */
export function watchReach(studio: Studio, later: (milliseconds: number, action: () => void) => () => void): () => void {
  let cancel: (() => void) | null = null;
  let asked: string | null = null;
  return effect(() => {
    const rule = studio.preferences.value.reach ? studio.state.cursorRule.value : null;
    const checked = studio.state.checked.value;
    cancel?.();
    cancel = null;
    if (rule === null || checked === null) {
      asked = null;
      studio.state.cloud.value = null;
      return;
    }
    const known = checked.symbols.some((symbol) => symbol.kind === "rule" && symbol.name === rule);
    if (!known || checked.problems.some((problem) => problem.severity === "error")) return;
    cancel = later(rule === asked ? 0 : kTypingPause, () => {
      asked = rule;
      void studio.connection.request({ kind: "ask_reach", rule }).catch(() => undefined);
    });
  });
}
