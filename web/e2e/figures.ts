// One line of a measurement.

/** Prints median and 95th percentile of milliseconds, how many they are, and what was wanted. */
export function tell(name: string, values: readonly number[], wanted = ""): void {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (share: number) => (sorted.length === 0 ? "–" : sorted[Math.min(sorted.length - 1, Math.ceil(share * sorted.length) - 1)]!.toFixed(1));
  console.log(`${name.padEnd(26)} median ${at(0.5).padStart(8)}   p95 ${at(0.95).padStart(8)}   of ${String(sorted.length).padEnd(4)} ${wanted}`);
}
