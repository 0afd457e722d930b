// Keys of the breeding room: the same list is on the sheet that `?` shows.
import type { Step } from "./grid_layout";

export type RoomAction =
  | { do: "step"; step: Step }
  | { do: "stars"; stars: number }
  | { do: "point"; by: 1 | -1 }
  | { do: "unrate" | "best" | "worst" | "breed" | "keep" | "more" | "show" | "blend" | "one" | "pairs" | "turning" | "scale" | "copy" | "paste" | "undo" | "redo" | "back" }
  | { do: "pick"; which: 0 | 1 };

export interface RoomKey {
  keys: readonly string[];
  mod?: boolean;
  shift?: boolean;
  words: string;
  action: RoomAction;
  /** Also while text is typed. */
  everywhere?: boolean;
  /** Only while two are compared. */
  pairs?: boolean;
  unlisted?: boolean;
}

const step = (key: string, name: Step, words: string, unlisted = false): RoomKey => ({ keys: [key], words, action: { do: "step", step: name }, unlisted });

export const ROOM_KEYS: readonly RoomKey[] = [
  { keys: ["ArrowLeft", "a"], words: "A is the better one, of A and B", action: { do: "pick", which: 0 }, pairs: true },
  { keys: ["ArrowRight", "b"], words: "B is the better one, of A and B", action: { do: "pick", which: 1 }, pairs: true },
  step("ArrowLeft", "left", "Go through the models, with all arrows"),
  step("ArrowRight", "right", "", true),
  step("ArrowUp", "up", "", true),
  step("ArrowDown", "down", "", true),
  step("Home", "first", "The first one; with End the last"),
  step("End", "last", "", true),
  ...[1, 2, 3, 4, 5].map((stars): RoomKey => ({
    keys: [String(stars)], words: "Stars: 1 bad, 3 neutral, 5 good", action: { do: "stars", stars }, unlisted: stars > 1,
  })),
  { keys: ["+", "="], words: "A point more", action: { do: "point", by: 1 } },
  { keys: ["-", "−"], words: "A point less", action: { do: "point", by: -1 } },
  { keys: ["0", "Delete", "Backspace"], words: "Take the rating away", action: { do: "unrate" } },
  { keys: ["b"], words: "The best of this screen", action: { do: "best" } },
  { keys: ["w"], words: "The worst of this screen", action: { do: "worst" } },
  { keys: ["n"], words: "Next generation; Enter too", action: { do: "breed" } },
  { keys: ["Enter"], words: "", action: { do: "breed" }, unlisted: true },
  { keys: ["m"], words: "More like this", action: { do: "more" } },
  { keys: ["k"], words: "Keep as a favourite", action: { do: "keep" } },
  { keys: ["e"], words: "Show in the editor", action: { do: "show" } },
  { keys: ["x"], words: "Take for a blend, or not", action: { do: "blend" } },
  { keys: ["c"], words: "Copy its genes", action: { do: "copy" } },
  { keys: ["v"], words: "Paste genes into it", action: { do: "paste" } },
  { keys: ["o"], words: "One at a time, beside the grid", action: { do: "one" } },
  { keys: ["p"], words: "A against B", action: { do: "pairs" } },
  { keys: ["t"], words: "Turn, or stand still", action: { do: "turning" } },
  { keys: ["s"], words: "All on one scale", action: { do: "scale" } },
  { keys: ["Escape"], words: "Back to the grid", action: { do: "back" } },
  { keys: ["z"], mod: true, words: "Undo in the room", action: { do: "undo" }, everywhere: true },
  { keys: ["z"], mod: true, shift: true, words: "Redo", action: { do: "redo" }, everywhere: true },
  { keys: ["y"], mod: true, words: "Redo", action: { do: "redo" }, everywhere: true, unlisted: true },
];

/** Where the key was pressed: in a text, on something that arrows move, on something that Enter presses, or elsewhere. */
export type Where = "text" | "arrows" | "button" | "elsewhere";
const kOwn: Record<Where, readonly string[]> = {
  text: [], elsewhere: [], button: ["Enter", " "], arrows: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "Enter", " "],
};

export function roomKeyFor(
  event: Pick<KeyboardEvent, "key" | "code" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">, where: Where, pairs: boolean,
): RoomAction | null {
  if (event.altKey) return null;
  const mod = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  // What a slider or a button understands itself is left to it.
  if (!mod && kOwn[where].includes(key)) return null;
  const found = ROOM_KEYS.find((one) =>
    one.keys.includes(key) && Boolean(one.mod) === mod && (!mod || Boolean(one.shift) === event.shiftKey) &&
    (where !== "text" || one.everywhere) && (!one.pairs || pairs));
  return found?.action ?? null;
}

export function whereOf(target: EventTarget | null | undefined, takesText: boolean): Where {
  if (takesText) return "text";
  if (!(target instanceof HTMLElement || target instanceof SVGElement)) return "elsewhere";
  if (target.matches("input, [role=tab], [role=menuitem], [role=slider], [role=separator]")) return "arrows";
  return target.matches("button, a, summary") ? "button" : "elsewhere";
}
