import { expect, test } from "vitest";
import { followed } from "../../src/store/visibility";

test("targets are followed where one is taken out, put in, moved or changed", () => {
  expect(followed(["a", "b", "c"], ["a", "c"])).toEqual([0, 2]);
  expect(followed(["a", "c"], ["a", "b", "c"])).toEqual([0, -1, 1]);
  expect(followed(["a", "b", "c"], ["c", "a", "b"])).toEqual([2, 0, 1]);
  expect(followed(["a", "b", "c"], ["a", "B", "c"])).toEqual([0, 1, 2]);
  expect(followed(["a", "b"], ["A", "B"])).toEqual([0, 1]);
  expect(followed([], ["a"])).toEqual([-1]);
  expect(followed(["a"], [])).toEqual([]);
});

test("of equal targets the copy is the new one", () => {
  expect(followed(["a"], ["a", "a"])).toEqual([0, -1]);
  expect(followed(["a", "a", "b"], ["a", "b"])).toEqual([0, 2]);
});

test("where some came and others went, what is known stays known", () => {
  expect(followed(["a", "b", "c"], ["x", "y", "c", "a"])).toEqual([-1, -1, 2, 0]);
});
