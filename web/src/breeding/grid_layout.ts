// Where the models of a screen stand: pixels from the upper left of the stage. The page's cells and the drawing's viewports
// both follow from this.

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Grid {
  columns: number;
  rows: number;
  cells: Rect[];
}

export const kGap = 6;
/** Trees are taller than wide, and a line of words stands below them. */
const kWanted = 0.92;

/** As many columns as give the largest models; all rows equally high. */
export function gridLayout(count: number, area: Rect): Grid {
  if (count === 0) return { columns: 1, rows: 1, cells: [] };
  let columns = 1, best = -1;
  for (let c = 1; c <= count; ++c) {
    const rows = Math.ceil(count / c);
    const width = (area.width - (c - 1) * kGap) / c, height = (area.height - (rows - 1) * kGap) / rows;
    // Empty places are a waste, but a small one.
    const size = Math.min(width / kWanted, height) * (1 - 0.04 * (c * rows - count) / c);
    if (size > best) [columns, best] = [c, size];
  }
  const rows = Math.ceil(count / columns);
  const line = (length: number, parts: number, i: number) => Math.round(i * (length + kGap) / parts);
  const cells = Array.from({ length: count }, (_, i) => {
    const c = i % columns, r = Math.floor(i / columns);
    const x = line(area.width, columns, c), y = line(area.height, rows, r);
    return { x: area.x + x, y: area.y + y, width: line(area.width, columns, c + 1) - kGap - x, height: line(area.height, rows, r + 1) - kGap - y };
  });
  return { columns, rows, cells };
}

export interface StageLayout {
  /** Of the models that are looked at closely: none, one, or two. */
  large: Rect[];
  grid: Grid;
}

/** A large model stands left of the grid, which shows itself smaller then; two take all of it. */
export function stageLayout(count: number, large: 0 | 1 | 2, width: number, height: number): StageLayout {
  const all = { x: 0, y: 0, width: Math.max(width, 1), height: Math.max(height, 1) };
  if (large === 0) return { large: [], grid: gridLayout(count, all) };
  if (large === 2) {
    const half = Math.floor((all.width - kGap) / 2);
    return {
      large: [{ ...all, width: half }, { ...all, x: all.width - half, width: half }],
      grid: { columns: 1, rows: 1, cells: [] },
    };
  }
  const wide = Math.round(all.width * 0.58);
  return { large: [{ ...all, width: wide }], grid: gridLayout(count, { ...all, x: wide + kGap, width: all.width - wide - kGap }) };
}

export type Step = "left" | "right" | "up" | "down" | "first" | "last";

/** The place in the grid after a key; keys at its border stay. */
export function stepInGrid(at: number, step: Step, columns: number, count: number): number {
  if (count === 0) return -1;
  if (at < 0) return step === "last" ? count - 1 : 0;
  switch (step) {
    case "first": return 0;
    case "last": return count - 1;
    case "left": return Math.max(0, at - 1);
    case "right": return Math.min(count - 1, at + 1);
    case "up": return at >= columns ? at - columns : at;
    case "down": {
      if (at + columns < count) return at + columns;
      // The last row may end before this column.
      return Math.floor(at / columns) < Math.floor((count - 1) / columns) ? count - 1 : at;
    }
  }
}
