/** Numbers as fields show them: at most four digits that matter after the point, no tail of zeros. */
export function showNumber(value: number): string {
  if (!Number.isFinite(value)) return "";
  if (value !== 0 && (Math.abs(value) >= 1e7 || Math.abs(value) < 1e-4)) return value.toExponential(3).replace(/\.?0+e/, "e");
  const digits = Math.max(0, 4 - Math.max(0, Math.floor(Math.log10(Math.abs(value) || 1))));
  return String(Number(value.toFixed(digits)));
}

/** 12 345: with thin spaces. */
export function thousands(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, "\u2009");
}

/** What was typed, as a number; a comma is a point. Null where it is none. */
export function readNumber(text: string): number | null {
  const trimmed = text.trim().replace(",", ".");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(trimmed)) return null;
  const value = Number(trimmed);
  return Number.isFinite(value) ? value : null;
}

export function clampTo(value: number, min?: number, max?: number): number {
  return Math.min(max ?? Infinity, Math.max(min ?? -Infinity, value));
}

/** Without the noise of repeated additions: rounded to a thousandth of the step. */
export function tidy(value: number, step: number): number {
  const unit = step / 1000;
  return Number((Math.round(value / unit) * unit).toPrecision(12));
}

/** A step that suits a value where none is given: a hundredth of its size. */
export function stepFor(value: number): number {
  return Math.abs(value) < 1e-6 ? 0.1 : 10 ** (Math.floor(Math.log10(Math.abs(value))) - 1);
}

/** Place 0..1 of a value on a logarithmic slider, and back. */
export const toLog = (value: number, min: number, max: number) => Math.log(value / min) / Math.log(max / min);
export const fromLog = (place: number, min: number, max: number) => Number((min * (max / min) ** place).toPrecision(2));
