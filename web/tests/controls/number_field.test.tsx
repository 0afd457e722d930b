import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test } from "vitest";
import { NumberBox, NumberField } from "../../src/controls/number_field";

const root = document.createElement("div");
document.body.append(root);
afterEach(() => act(() => render(null, root)));

/** A field whose value follows what is done to it. */
function field(start: number) {
  const seen: { value: number; gesture: string }[] = [];
  let captured = false;
  const show = (value: number) => act(() => render(<NumberBox label="Alignment" value={value} min={0} onChange={(next, gesture) => {
    seen.push({ value: next, gesture });
    show(next);
  }} />, root));
  show(start);
  const input = root.querySelector("input")!;
  input.setPointerCapture = () => {
    captured = true;
  };
  const point = (type: string, x: number, buttons = 1) =>
    act(() => void input.dispatchEvent(new PointerEvent(type, { clientX: x, buttons, button: 0, pointerId: 1, bubbles: true })));
  return { seen, input, point, captured: () => captured, values: () => seen.map((one) => one.value) };
}

describe("a number that is scrubbed", () => {
  test("goes by one step from end to end, though it grows by a digit, and back to where it was", () => {
    const { point, values, seen } = field(980);
    point("pointerdown", 100);
    for (const x of [106, 112, 118, 112, 106, 100]) point("pointermove", x);
    point("pointerup", 100, 0);
    expect(values()).toEqual([1000, 1020, 1040, 1020, 1000, 980]);
    expect(new Set(seen.map((one) => one.gesture)).size).toBe(1);
  });

  test("is held from the press on, and let go of wherever the button was released", () => {
    const { point, values, captured } = field(5);
    point("pointerdown", 100);
    expect(captured()).toBe(true);
    point("pointermove", 200, 0);
    point("pointermove", 230, 0);
    expect(values()).toEqual([]);
  });
});

describe("a number that is typed", () => {
  test("is taken on Enter; Escape and nonsense leave it", () => {
    const { input, values } = field(5);
    const type = (text: string, key: string) => {
      input.value = text;
      act(() => void input.dispatchEvent(new Event("input", { bubbles: true })));
      act(() => void input.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true })));
    };
    type("7,5", "Enter");
    type("9", "Escape");
    type("tall", "Enter");
    expect(values()).toEqual([7.5]);
    expect(input.value).toBe("7.5");
  });

  test("steps with the arrow keys", () => {
    const { input, values } = field(5);
    const press = (key: string, more = {}) => act(() => void input.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more })));
    press("ArrowUp");
    press("ArrowDown", { shiftKey: true });
    press("ArrowUp", { altKey: true });
    expect(values()).toEqual([5.1, 4.1, 4.11]);
  });
});

test("Alt+Backspace in a row takes the default, Backspace alone does not", () => {
  let resets = 0;
  act(() => render(<NumberField label="Alignment" value={3} onChange={() => {}} onReset={() => void ++resets} />, root));
  const press = (altKey: boolean) => {
    const event = new KeyboardEvent("keydown", { key: "Backspace", altKey, bubbles: true, cancelable: true });
    root.querySelector("input")!.dispatchEvent(event);
    return event.defaultPrevented;
  };
  expect([press(false), resets]).toEqual([false, 0]);
  expect([press(true), resets]).toEqual([true, 1]);
});
