// What clicks, stars and keys make of ratings, which are numbers from 0, up and down. None at all is neutral.
import type { BredIndividual, Rating } from "../api";

export type RateBy = "points" | "stars" | "extremes" | "pairs";
export const kRateBy: readonly RateBy[] = ["points", "stars", "extremes", "pairs"];
export const kStars = 5;
const kMiddle = 3, kFurthest = 1000;

/** Three stars are 0: neither for nor against. */
export const ratingOfStars = (stars: number): number => stars - kMiddle;

/** 1..5; null: not rated. */
export function starsOf(rating: number | undefined): number | null {
  return rating === undefined ? null : Math.min(kStars, Math.max(1, Math.round(rating) + kMiddle));
}

/** A point more or less; what is not rated begins at 0. */
export function stepped(rating: number | undefined, step: 1 | -1): number {
  return Math.min(kFurthest, Math.max(-kFurthest, (rating ?? 0) + step));
}

/** As it stands on a tree: +2, 0, -1; a minus as wide as the plus. */
export function ratingWords(rating: number | undefined): string {
  if (rating === undefined) return "not rated";
  const text = String(Math.round(Math.abs(rating) * 10) / 10);
  return rating > 0 ? `+${text}` : rating < 0 ? `−${text}` : "0";
}

/** The best gets as much as five stars, the worst as little as one; who was it before on this screen gives it back. */
export function extremes(
  individuals: readonly { id: number; rating?: number | undefined }[], id: number, which: "best" | "worst",
): Rating[] {
  const value = which === "best" ? ratingOfStars(kStars) : ratingOfStars(1);
  const own = individuals.find((one) => one.id === id);
  if (own?.rating === value) return [{ individual: id }];
  return [...individuals.filter((one) => one.rating === value && one.id !== id).map((one) => ({ individual: one.id })), { individual: id, rating: value }];
}

export type Pair = readonly [number, number];
export const pairKey = (a: number, b: number): string => (a < b ? `${a} ${b}` : `${b} ${a}`);

/** The next two to be compared: never the same two again; those that were looked at least, then those that are nearest to each
 *  other in rating, in the order of the screen. */
export function nextPair(individuals: readonly Pick<BredIndividual, "id" | "rating">[], asked: ReadonlySet<string>): Pair | null {
  const seen = new Map<number, number>(individuals.map((one) => [one.id, 0]));
  for (const key of asked) for (const id of key.split(" ").map(Number)) if (seen.has(id)) seen.set(id, seen.get(id)! + 1);
  let best: Pair | null = null;
  let least = Infinity;
  individuals.forEach((a, i) => {
    for (const b of individuals.slice(i + 1)) {
      if (asked.has(pairKey(a.id, b.id))) continue;
      const cost = 100 * (seen.get(a.id)! + seen.get(b.id)!) + Math.min(99, Math.abs((a.rating ?? 0) - (b.rating ?? 0)));
      if (cost < least) [best, least] = [[a.id, b.id], cost];
    }
  });
  return best;
}

/** Of a screen: how many are rated. */
export function ratedCount(individuals: readonly Pick<BredIndividual, "rating">[]): number {
  return individuals.filter((one) => one.rating !== undefined).length;
}
