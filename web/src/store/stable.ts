import { computed, type ReadonlySignal } from "@preact/signals";

/** A computed value that stays the same object while it says the same, so that what depends on it rests. For small values: they
 *  are compared as JSON. */
export function stable<T>(compute: () => T): ReadonlySignal<T> {
  let last: { value: T; text: string } | null = null;
  return computed(() => {
    const value = compute();
    const text = JSON.stringify(value) ?? "";
    if (last === null || last.text !== text) last = { value, text };
    return last.value;
  });
}
