// The difference of two texts as one change: what they share at both ends stays.
export interface Change {
  from: number;
  to: number;
  insert: string;
}

/** What makes `after` of `before`; null where they are the same. */
export function changeBetween(before: string, after: string): Change | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let start = 0;
  while (start < shorter && before.charCodeAt(start) === after.charCodeAt(start)) start += 1;
  let end = 0;
  while (end < shorter - start && before.charCodeAt(before.length - 1 - end) === after.charCodeAt(after.length - 1 - end)) end += 1;
  // Never between the halves of one character.
  if (start > 0 && isHigh(before.charCodeAt(start - 1))) start -= 1;
  if (end > 0 && isLow(before.charCodeAt(before.length - end))) end -= 1;
  return { from: start, to: before.length - end, insert: after.slice(start, after.length - end) };
}

const isHigh = (code: number) => code >= 0xd800 && code < 0xdc00;
const isLow = (code: number) => code >= 0xdc00 && code < 0xe000;

/** Line by line, so that after formatting the cursor stays where it was: changes of lines that are not in both. */
export function changesByLine(before: string, after: string): Change[] {
  const whole = changeBetween(before, after);
  if (whole === null) return [];
  const from = whole.from === 0 ? 0 : before.lastIndexOf("\n", whole.from - 1) + 1;
  const tail = before.length - whole.to;
  const oldLines = before.slice(from, whole.to).split("\n");
  const newLines = after.slice(from, after.length - tail).split("\n");
  // As many lines: each for itself. Else one change.
  if (oldLines.length !== newLines.length || oldLines.length > 5000) return [whole];
  const out: Change[] = [];
  let at = from;
  oldLines.forEach((line, i) => {
    const change = changeBetween(line, newLines[i]!);
    if (change !== null) out.push({ from: at + change.from, to: at + change.to, insert: change.insert });
    at += line.length + 1;
  });
  return out;
}

/** Where a place of `before` is in `after`. */
export function movedPlace(change: Change | null, at: number): number {
  if (change === null || at <= change.from) return at;
  if (at >= change.to) return at + change.insert.length - (change.to - change.from);
  return Math.min(at, change.from + change.insert.length);
}
