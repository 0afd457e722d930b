// Words for where an individual comes from, and for numbers about it.
import type { BredIndividual } from "../api";

const kOrigins: Record<BredIndividual["origin"], string> = {
  sampled: "drawn anew", kept: "copy", crossed: "crossed", mutated: "mutated", edited: "edited", blended: "blended", sibling: "relative",
};
export const kRoles: Record<NonNullable<BredIndividual["role"]>, { name: string; words: string }> = {
  best: { name: "Best guess", words: "The taste model expects you to like it best" },
  different: { name: "Different", words: "Unlike the others, so that nothing is missed" },
  uncertain: { name: "Unsure", words: "The taste model knows least about it: your rating teaches it most" },
};

export const originWords = (one: Pick<BredIndividual, "origin">): string => kOrigins[one.origin];

/** Crossed from 3 and 7. */
export function originSentence(one: Pick<BredIndividual, "origin" | "parents">): string {
  const words = kOrigins[one.origin];
  const parents = one.parents.map(String);
  const list = parents.length > 1 ? `${parents.slice(0, -1).join(", ")} and ${parents.at(-1)}` : parents[0];
  const text = list === undefined ? words : `${words} ${one.origin === "kept" || one.origin === "sibling" ? "of" : "from"} ${list}`;
  return text[0]!.toUpperCase() + text.slice(1);
}

/** 0.43 m, 4.3 m, 128 m. */
export function metres(value: number): string {
  return `${value >= 100 ? Math.round(value) : value >= 10 ? value.toFixed(1) : value.toFixed(2)} m`;
}

/** 9 seconds, 2 minutes. */
export function lastingWords(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 90 ? `${minutes} min` : `${(minutes / 60).toFixed(1)} h`;
}

const kDiversity: readonly [number, string][] = [[0.08, "nearly the same"], [0.2, "alike"], [0.4, "varied"], [1.01, "very varied"]];
export const diversityWords = (value: number): string => kDiversity.find(([below]) => value < below)?.[1] ?? "very varied";

const kDial: readonly [number, string][] = [[0.1, "subtle"], [0.3, "gentle"], [0.55, "lively"], [0.8, "bold"], [1.01, "wild"]];
export const dialWords = (value: number): string => kDial.find(([below]) => value < below)?.[1] ?? "wild";
