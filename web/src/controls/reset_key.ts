// Alt+Backspace in a row of a panel does what a double click on its name does: it takes the default.

/** For the row's onKeyDown; none where there is nothing to go back to. */
export function resetKey(reset: (() => void) | undefined): ((event: KeyboardEvent) => void) | undefined {
  return reset && ((event) => {
    if (event.key !== "Backspace" || !event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    reset();
  });
}
