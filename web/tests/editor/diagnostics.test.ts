// @vitest-environment node
import { describe, expect, test } from "vitest";
import type { Problem } from "../../src/api";
import { changeBetween, changesByLine, movedPlace, type Change } from "../../src/editor/changes";
import { toDiagnostics } from "../../src/editor/diagnostics";
import { kBurstPause, TypingBursts } from "../../src/editor/typing";

function applied(text: string, changes: readonly Change[]): string {
  let out = text;
  for (const change of changes.toReversed()) out = out.slice(0, change.from) + change.insert + out.slice(change.to);
  return out;
}

describe("the difference of two texts", () => {
  test("is one change between what they share", () => {
    expect(changeBetween("abcdef", "abXdef")).toEqual({ from: 2, to: 3, insert: "X" });
    expect(changeBetween("aa", "aaa")).toEqual({ from: 2, to: 2, insert: "a" });
    expect(changeBetween("same", "same")).toBeNull();
    expect(changeBetween("", "x")).toEqual({ from: 0, to: 0, insert: "x" });
  });

  test("never parts a character", () => {
    expect(changeBetween("a😀b", "a😁b")).toEqual({ from: 1, to: 3, insert: "😁" });
  });

  test("by lines, each for itself", () => {
    const before = "a\n  b   \nc\nd\n";
    const after = "a\n b\nc\n  d\n";
    const changes = changesByLine(before, after);
    expect(applied(before, changes)).toBe(after);
    expect(changes.length).toBeGreaterThan(1);
    expect(changesByLine("a\nb", "a\nb\nc")).toEqual([{ from: 3, to: 3, insert: "\nc" }]);
  });

  test("applied is the other text, for many pairs", () => {
    const texts = ["", "a", "\n", "a\nb", "b\na", "a\nb\nc\n", "x\nb\nz\n", "aaaa\naaaa", "aaa\naaaaa"];
    for (const before of texts) for (const after of texts) {
      expect(applied(before, changesByLine(before, after))).toBe(after);
      const change = changeBetween(before, after);
      expect(applied(before, change === null ? [] : [change])).toBe(after);
    }
  });

  test("moves places behind it", () => {
    const change = { from: 2, to: 4, insert: "xyz" };
    expect([0, 2, 3, 4, 9].map((at) => movedPlace(change, at))).toEqual([0, 2, 3, 5, 10]);
    expect(movedPlace(null, 7)).toBe(7);
  });
});

describe("problems in the text", () => {
  const problem = (from: number, to: number, more: Partial<Problem> = {}): Problem => ({ severity: "error", code: "E0202", text: "no", at: { from, to }, ...more });

  test("stand where they belong", () => {
    expect(toDiagnostics([problem(2, 4, { help: "Try this." })], "abcdef", "abcdef")).toEqual([
      { from: 2, to: 4, severity: "error", source: "E0202", message: "no\nTry this." },
    ]);
  });

  test("move with what was typed since", () => {
    expect(toDiagnostics([problem(4, 6)], "abcdef", "abXYcdef")).toMatchObject([{ from: 6, to: 8 }]);
    expect(toDiagnostics([problem(0, 2)], "abcdef", "abXYcdef")).toMatchObject([{ from: 0, to: 2 }]);
  });

  test("are seen although they have no length, and stay within the text", () => {
    expect(toDiagnostics([problem(1, 1)], null, "abc")).toMatchObject([{ from: 1, to: 2 }]);
    expect(toDiagnostics([problem(3, 3)], null, "abc")).toMatchObject([{ from: 3, to: 3 }]);
    expect(toDiagnostics([problem(1, 1)], null, "a\nb")).toMatchObject([{ from: 1, to: 1 }]);
    expect(toDiagnostics([problem(50, 90), problem(-4, 2)], null, "abc")).toMatchObject([{ from: 0, to: 2 }, { from: 3, to: 3 }]);
  });

  test("of other files and without a place are not in the text", () => {
    expect(toDiagnostics([problem(0, 1, { file: "b.esp" }), { severity: "error", code: "E0208", text: "no start" }], "a", "a")).toEqual([]);
  });

  test("have three degrees", () => {
    const three = (["error", "warning", "note"] as const).map((severity, i) => problem(i, i + 1, { severity }));
    expect(toDiagnostics(three, null, "abcd").map((one) => one.severity)).toEqual(["error", "warning", "info"]);
  });
});

describe("bursts of typing", () => {
  const key = (from: number, at: number, erased = false) => ({ from, to: erased ? from : from + 1, erased, at });

  test("go on while keys follow each other", () => {
    const bursts = new TypingBursts();
    const first = bursts.gesture(key(5, 0));
    expect(bursts.gesture(key(6, 100))).toBe(first);
    expect(bursts.gesture(key(7, 100 + kBurstPause - 1))).toBe(first);
  });

  test("end with a pause, elsewhere, with erasing, and when told", () => {
    const bursts = new TypingBursts();
    const names = [
      bursts.gesture(key(5, 0)),
      bursts.gesture(key(6, kBurstPause)),
      bursts.gesture(key(90, kBurstPause + 1)),
      bursts.gesture(key(90, kBurstPause + 2, true)),
    ];
    bursts.end();
    names.push(bursts.gesture(key(89, kBurstPause + 3, true)));
    expect(new Set(names).size).toBe(5);
  });
});
