import { effect } from "@preact/signals";
import { kTypingPause, type Studio } from "./studio";

/** Where the rule under the cursor can reach: asked when the cursor rests, and again when the grammar has changed. */
export function watchReach(studio: Studio, later: (milliseconds: number, action: () => void) => () => void): () => void {
  let cancel: (() => void) | null = null;
  return effect(() => {
    const rule = studio.preferences.value.reach ? studio.state.cursorRule.value : null;
    const checked = studio.state.checked.value;
    cancel?.();
    cancel = null;
    if (rule === null || checked === null) {
      studio.state.cloud.value = null;
      return;
    }
    const known = checked.symbols.some((symbol) => symbol.kind === "rule" && symbol.name === rule);
    if (!known || checked.problems.some((problem) => problem.severity === "error")) return;
    cancel = later(kTypingPause, () => {
      void studio.connection.request({ kind: "ask_reach", rule }).catch(() => undefined);
    });
  });
}
