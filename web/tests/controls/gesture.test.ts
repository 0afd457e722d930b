import { expect, test, vi } from "vitest";

test("gestures of a page are called otherwise after a reload", async () => {
  const names: string[] = [];
  for (let load = 0; load < 2; ++load) {
    vi.resetModules();
    const { TypingBursts } = await import("../../src/editor/typing");
    const { uniqueName } = await import("../../src/base/unique_name");
    names.push(new TypingBursts().gesture({ from: 0, to: 1, erased: false, at: 0 }), uniqueName("Height"), uniqueName("a".repeat(200)));
  }
  expect(new Set(names).size).toBe(6);
  expect(names.every((name) => name.length < 100)).toBe(true);
});
