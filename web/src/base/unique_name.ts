const kPage = Math.floor(Math.random() * 2 ** 32).toString(36);
let count = 0;

/** A name that nothing had before, on no other page and not before a reload: the server joins steps of undo whose gestures
 *  are called alike. `what` begins it, for people who look at messages. */
export function uniqueName(what: string): string {
  return `${what.slice(0, 40)} ${kPage} ${++count}`;
}
