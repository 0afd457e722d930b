export const BACKOFF_DEFAULTS = { first: 250, most: 8000 };

/** Milliseconds before the attempt (0 is the first after a loss): doubled each time up to a limit. `random` in 0..1 spreads
 *  many tabs over the upper half. */
export function backoff(attempt: number, random: number, options = BACKOFF_DEFAULTS): number {
  const full = Math.min(options.most, options.first * 2 ** Math.min(attempt, 20));
  return full * (0.5 + 0.5 * random);
}
