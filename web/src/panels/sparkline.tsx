import { showNumber } from "../controls/number";

export const kSparkline = { width: 140, height: 44 };

/** Steps up: the best stays what it was until it rises. Points of an SVG; the highest is 2 pixels from the top. */
export function sparklinePoints(rises: readonly (readonly number[])[], size = kSparkline): string {
  const good = rises.filter(([seconds, best]) => Number.isFinite(seconds) && Number.isFinite(best));
  if (good.length === 0) return "";
  const last = good.at(-1)![0]!;
  // A first model is often so bad that all rises after it would be one line: the scale begins at the tenth part of the rises.
  const bests = good.map(([, best]) => best!);
  const low = bests[Math.floor(bests.length / 10)]!;
  const high = bests.at(-1)!;
  const x = (seconds: number) => (last > 0 ? (seconds / last) * size.width : 0);
  const y = (best: number) => {
    const share = high > low ? Math.max(0, (best - low) / (high - low)) : 0.5;
    return size.height - 2 - share * (size.height - 4);
  };
  const points: string[] = [];
  let before: number | null = null;
  for (const [seconds, best] of good) {
    if (before !== null) points.push(`${x(seconds!).toFixed(1)},${y(before).toFixed(1)}`);
    points.push(`${x(seconds!).toFixed(1)},${y(best!).toFixed(1)}`);
    before = best!;
  }
  points.push(`${size.width.toFixed(1)},${y(before!).toFixed(1)}`);
  return points.join(" ");
}

export function Sparkline({ rises }: { rises: readonly (readonly number[])[] }) {
  const first = rises[0]?.[1];
  const last = rises.at(-1)?.[1];
  const words = first === undefined || last === undefined ? "No search yet" : `The best score rose from ${showNumber(first)} to ${showNumber(last)}`;
  return (
    <svg class="sparkline" viewBox={`0 0 ${kSparkline.width} ${kSparkline.height}`} preserveAspectRatio="none" role="img" aria-label={words}>
      <polyline points={sparklinePoints(rises)} />
    </svg>
  );
}
