import { describe, expect, test } from "vitest";
import type { Attribute } from "../../src/api";
import { agoWords } from "../../src/base/ago_words";
import { clampTo, fromLog, readNumber, showNumber, stepFor, thousands, tidy, toLog } from "../../src/controls/number";
import { attributeValue, isWhole, labelOf, sceneValue } from "../../src/panels/attribute_values";
import { changeEngine, changeSetting, ENGINE_SETTINGS, ENGINES, engineOf, settingOf } from "../../src/panels/engine_settings";
import { boxAround } from "../../src/panels/limits";
import { barsOf } from "../../src/panels/objective";
import { showBytes } from "../../src/panels/problems";
import { kSparkline, sparklinePoints } from "../../src/panels/sparkline";
import { SHORTCUTS, shortcutFor, takesText } from "../../src/page/shortcuts";

describe("numbers", () => {
  test("are shown short and read kindly", () => {
    expect([0, 1, 0.1 + 0.2, 1234.56789, 31931.75, -2.5, 1e-9, 2e9, 1 / 3].map(showNumber)).toEqual(["0", "1", "0.3", "1234.6", "31932", "-2.5", "1e-9", "2e+9", "0.3333"]);
    expect(["1", " -2,5 ", ".5", "1e3", "", "a", "1..2", "0x10", "1e999"].map(readNumber)).toEqual([1, -2.5, 0.5, 1000, null, null, null, null, null]);
  });

  test("step by what suits them, without noise", () => {
    expect([0, 5, 0.3, 4000, -12].map(stepFor)).toEqual([0.1, 0.1, 0.01, 100, 1]);
    expect(tidy(0.1 + 0.2, 0.1)).toBe(0.3);
    expect(clampTo(5, 0, 1)).toBe(1);
    expect(clampTo(-5)).toBe(-5);
  });

  test("on a logarithmic slider come back", () => {
    for (const value of [0.05, 0.5, 5, 60]) expect(fromLog(toLog(value, 0.05, 60), 0.05, 60)).toBeCloseTo(value, 10);
  });
});

describe("attributes", () => {
  const lean: Attribute = { name: "lean", kind: "number", unit: "deg", value: 5, standard: 5, min: 0, max: 40 };

  test("take the scene's value; angles are texts there", () => {
    expect(attributeValue(lean, {})).toBe(5);
    expect(attributeValue(lean, { attributes: { lean: "25deg" } })).toBe(25);
    expect(attributeValue(lean, { attributes: { lean: "1.5707963267948966rad" } })).toBeCloseTo(90);
    expect(attributeValue(lean, { attributes: { lean: "nonsense" } })).toBe(5);
    expect(sceneValue(lean, 12)).toBe("12deg");
    expect(sceneValue({ ...lean, unit: "" }, 12)).toBe(12);
    expect(attributeValue({ name: "on", kind: "bool", value: true, standard: true }, { attributes: { on: false } })).toBe(false);
  });

  test("have a group and a label", () => {
    expect(labelOf({ ...lean, label: "Tree/Leans" })).toEqual({ group: "Tree", label: "Leans" });
    expect(labelOf({ ...lean, label: "Leans" })).toEqual({ group: "", label: "Leans" });
    expect(labelOf(lean)).toEqual({ group: "", label: "lean" });
    expect(labelOf({ ...lean, comment: "Tree/Leans" })).toEqual({ group: "Tree", label: "Leans" });
    expect(labelOf({ ...lean, comment: "How far it leans." })).toEqual({ group: "", label: "lean" });
  });

  test("are whole where they go by whole steps", () => {
    expect(isWhole({ ...lean, step: 1 })).toBe(true);
    expect(isWhole({ ...lean, step: 0.5 })).toBe(false);
    expect(isWhole(lean)).toBe(false);
  });
});

describe("settings of engines", () => {
  test("have defaults within their ranges, and no key twice", () => {
    for (const engine of ENGINES) {
      const settings = ENGINE_SETTINGS[engine];
      expect(new Set(settings.map((one) => one.key)).size).toBe(settings.length);
      for (const one of settings) {
        if (one.kind === "number" && one.standard !== null) expect(one.standard).toBe(clampTo(one.standard, one.min, one.max));
        if (one.kind === "choice") expect(one.choices).toContain(one.standard);
      }
    }
  });

  test("are kept for the engine that is chosen", () => {
    const scene = { search: { engine: "ga", population: 40 }, engine: { ga: { elitism: 2 }, guided: { steps: 7 } } };
    expect(engineOf({})).toBe("ga");
    expect(engineOf({ search: { engine: "nonsense" } })).toBe("ga");
    expect(settingOf(scene, "population")).toBe(40);
    expect(settingOf(scene, "elitism")).toBe(2);
    expect(settingOf(scene, "steps")).toBeUndefined();
    const changed = changeSetting(scene, "population", 60);
    expect(changed).toEqual({ search: { engine: "ga" }, engine: { ga: { elitism: 2, population: 60 }, guided: { steps: 7 } } });
    expect(changeSetting(changed, "population", undefined).engine!["ga"]).toEqual({ elitism: 2 });
  });

  test("do not go over to another engine", () => {
    const scene = { search: { engine: "ga", population: 40 } };
    const other = changeEngine(scene, "guided");
    expect(other).toEqual({ search: { engine: "guided" }, engine: { ga: { population: 40 } } });
    expect(settingOf(changeEngine(other, "ga"), "population")).toBe(40);
  });
});

describe("pictures of numbers", () => {
  test("a sparkline rises in steps from left to right", () => {
    const points = sparklinePoints([[0, 0], [1, 5], [2, 10]]).split(" ").map((pair) => pair.split(",").map(Number));
    expect(points[0]).toEqual([0, kSparkline.height - 2]);
    expect(points.at(-1)).toEqual([kSparkline.width, 2]);
    for (let i = 1; i < points.length; ++i) {
      expect(points[i]![0]!).toBeGreaterThanOrEqual(points[i - 1]![0]!);
      expect(points[i]![1]!).toBeLessThanOrEqual(points[i - 1]![1]!);
    }
  });

  test("a sparkline of nothing, of one, and of nonsense", () => {
    expect(sparklinePoints([])).toBe("");
    expect(sparklinePoints([[0, 3]])).not.toContain("NaN");
    expect(sparklinePoints([[NaN, 3], [1, Infinity]])).toBe("");
  });

  test("bars of terms share their zero", () => {
    const term = (value: number) => ({ target: "t", name: "n", count: 0, of: 0, unit: "", value });
    expect(barsOf([term(30), term(-10)])).toEqual([{ left: 25, width: 75 }, { left: 0, width: 25 }]);
    expect(barsOf([term(0)])).toEqual([{ left: 0, width: 0 }]);
  });

  test("words for sizes and times", () => {
    expect([12, 3400, 999_999, 5_200_000].map(showBytes)).toEqual(["12 B", "3 kB", "1.0 MB", "5.2 MB"]);
    expect([5, 600, 7200, 200_000].map(agoWords)).toEqual(["just now", "10 minutes ago", "2 hours ago", "2 days ago"]);
    expect([999, 12345, 1234567].map(thousands)).toEqual(["999", "12\u2009345", "1\u2009234\u2009567"]);
  });

  test("a box around curves leaves room", () => {
    expect(boxAround([[0, 0, 0], [1, 2, 3]])).toEqual({ min: [-0.5, -0.5, -0.5], max: [1.5, 2.5, 3.5] });
  });
});

describe("shortcuts", () => {
  const press = (key: string, more: Partial<KeyboardEvent> = {}, inText = false) =>
    shortcutFor({ key, code: "", ctrlKey: false, metaKey: false, shiftKey: false, altKey: false, ...more }, inText)?.words;

  test("no two share their keys", () => {
    const keys = SHORTCUTS.map((one) => `${one.mod} ${one.shift} ${one.key}`);
    expect(keys.filter((key, i) => keys.indexOf(key) !== i)).toEqual([]);
  });

  test("letters do nothing while text is typed, undo does", () => {
    expect(press("c")).toBe("Draw a curve");
    expect(press("c", {}, true)).toBeUndefined();
    expect(press("z", { ctrlKey: true }, true)).toBe("Undo, whatever it was");
    expect(press("Z", { metaKey: true, shiftKey: true })).toBe("Redo");
    expect(press("c", { ctrlKey: true })).toBeUndefined();
    expect(press("c", { altKey: true })).toBeUndefined();
    expect(press("C", { shiftKey: true })).toBeUndefined();
    expect(press("?", { shiftKey: true, code: "Minus" })).toBe("This sheet");
  });

  test("digits with Shift are digits on any keyboard", () => {
    expect(press("1", { code: "Digit1" })).toBe("From the front");
    expect(press("!", { code: "Digit1", shiftKey: true })).toBe("From behind");
    expect(press("End", { code: "Numpad1", shiftKey: true })).toBe("From behind");
    expect(press("2", { code: "Digit2" })).toBeUndefined();
  });

  test("fields take text, sliders and buttons do not", () => {
    const input = (type: string) => Object.assign(document.createElement("input"), { type });
    expect([input("text"), document.createElement("textarea"), document.createElement("select")].map(takesText)).toEqual([true, true, true]);
    expect([input("range"), input("checkbox"), document.createElement("button"), null].map(takesText)).toEqual([false, false, false, false]);
  });
});
