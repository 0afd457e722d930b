// What this browser remembers: nothing of it belongs to a project.
import { effect, signal, type Signal } from "@preact/signals";
import { kRateBy, type RateBy } from "../breeding/rating";

export type Theme = "system" | "dark" | "light";

export interface Preferences {
  theme: Theme;
  /** Sizes in pixels. */
  left: number;
  right: number;
  bottom: number;
  /** Names of panels that are folded. */
  folded: string[];
  /** Search anew after each change. */
  live: boolean;
  /** Where the rule under the cursor can reach is shown. */
  reach: boolean;
  parts: boolean;
  bones: boolean;
  field: boolean;
  targets: boolean;
  ground: boolean;
  /** Of the breeding room: what clicks on models mean, whether all are seen on one scale, and whether they turn. */
  rateBy: RateBy;
  oneScale: boolean;
  turning: boolean;
}

export const PREFERENCE_DEFAULTS: Preferences = {
  theme: "system",
  left: 400,
  right: 320,
  bottom: 150,
  folded: ["limits", "density"],
  live: true,
  reach: true,
  parts: true,
  bones: false,
  field: false,
  targets: true,
  ground: true,
  rateBy: "points",
  oneScale: false,
  turning: true,
};

const kKey = "espalier-studio";

/** What of `text` is usable: unknown and wrong things are left out. */
export function readPreferences(text: string | null): Preferences {
  const out: Record<string, unknown> = { ...PREFERENCE_DEFAULTS };
  let stored: unknown;
  try {
    stored = JSON.parse(text ?? "{}");
  } catch {
    stored = {};
  }
  if (typeof stored === "object" && stored !== null)
    for (const [key, value] of Object.entries(stored)) {
      const standard = out[key];
      if (Array.isArray(standard)) {
        if (Array.isArray(value)) out[key] = value.filter((item) => typeof item === "string").slice(0, 100);
      } else if (typeof value === typeof standard && (typeof value !== "number" || Number.isFinite(value))) out[key] = value;
    }
  if (!["system", "dark", "light"].includes(out["theme"] as string)) out["theme"] = "system";
  if (!(kRateBy as readonly unknown[]).includes(out["rateBy"])) out["rateBy"] = PREFERENCE_DEFAULTS.rateBy;
  return out as unknown as Preferences;
}

export function keptPreferences(storage: Pick<Storage, "getItem" | "setItem">): Signal<Preferences> {
  let text: string | null = null;
  try {
    text = storage.getItem(kKey);
  } catch {
    // Some browsers forbid storage: then nothing is remembered.
  }
  const preferences = signal(readPreferences(text));
  effect(() => {
    try {
      storage.setItem(kKey, JSON.stringify(preferences.value));
    } catch {
      // Full or forbidden.
    }
  });
  return preferences;
}
