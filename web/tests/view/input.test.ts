import { beforeEach, describe, expect, it } from "vitest";
import type { Drag } from "../../src/view/desk";
import { Input, type InputTarget } from "../../src/view/input";

let log: string[], element: HTMLElement, input: Input, keys: boolean;

function send(type: string, x: number, y: number, more: object = {}): PointerEvent {
  const event = new PointerEvent(type, { clientX: x, clientY: y, pointerId: 1, bubbles: true, cancelable: true,
    ...more });
  element.dispatchEvent(event);
  return event;
}

beforeEach(() => {
  log = [];
  keys = true;
  element = document.createElement("div");
  element.tabIndex = 0;
  document.body.append(element);
  const drag: Drag = {
    move: (p) => log.push(`move ${p.x} ${p.y}`), end: (p, click) => log.push(`end ${p.x} ${p.y} ${click}`),
    cancel: () => log.push("cancel"),
  };
  const target: InputTarget = {
    press: (p) => { log.push(`press ${p.x} ${p.y}`); return p.x < 0 ? null : drag; },
    hovered: (p) => log.push(`hover ${p.x}`), left: () => log.push("left"),
    pinch: (x, y, _dx, _dy, factor) => log.push(`pinch ${x} ${y} ${factor.toFixed(2)}`),
    wheel: (_x, _y, e) => log.push(`wheel ${e.deltaY}`), key: (k) => { log.push(`key ${k.key}`); return keys; },
    dragging: () => {},
  };
  input = new Input(element, target);
});

describe("Input", () => {
  it("tells clicks from drags by how far the pointer went", () => {
    send("pointerdown", 10, 10);
    send("pointermove", 12, 11);
    send("pointerup", 12, 11);
    expect(log.slice(0, 2)).toEqual(["press 10 10", "end 12 11 true"]);
    log.length = 0;
    send("pointerdown", 10, 10);
    send("pointermove", 20, 10);
    send("pointermove", 11, 10);
    send("pointerup", 11, 10);
    expect(log.slice(0, 4)).toEqual(["press 10 10", "move 20 10", "move 11 10", "end 11 10 false"]);
  });

  it("hovers between drags only", () => {
    send("pointermove", 5, 5);
    send("pointerdown", 10, 10);
    send("pointermove", 40, 10);
    expect(log).toEqual(["hover 5", "press 10 10", "move 40 10"]);
    send("pointerup", 40, 10);
    expect(log.at(-1)).toBe("hover 40");
  });

  it("cancels by Escape and when the pointer is lost; then nothing moves", () => {
    send("pointerdown", 10, 10);
    send("pointermove", 40, 10);
    const escape = new KeyboardEvent("keydown", { key: "Escape", cancelable: true });
    element.dispatchEvent(escape);
    expect(escape.defaultPrevented).toBe(true);
    send("pointermove", 60, 10);
    send("pointerup", 60, 10);
    expect(log).toEqual(["press 10 10", "move 40 10", "cancel"]);
    send("pointerdown", 10, 10);
    send("pointercancel", 10, 10);
    expect(log.at(-1)).toBe("cancel");
    expect(input.active).toBe(false);
  });

  it("leaves no key to others while something is dragged: undo would change what is in the hand", () => {
    const press = (): boolean => {
      const undo = new KeyboardEvent("keydown", { key: "z", ctrlKey: true, cancelable: true });
      element.dispatchEvent(undo);
      return undo.defaultPrevented;
    };
    keys = false;
    expect(press()).toBe(false);
    send("pointerdown", 10, 10);
    expect(press()).toBe(true);
    expect(log).toEqual(["key z", "press 10 10"]);
    send("pointerup", 10, 10);
  });

  it("pinches with two fingers, and drops what one had begun", () => {
    send("pointerdown", 100, 100, { pointerType: "touch" });
    send("pointerdown", 200, 100, { pointerType: "touch", pointerId: 2 });
    send("pointermove", 300, 100, { pointerType: "touch", pointerId: 2 });
    expect(log).toEqual(["press 100 100", "cancel", "pinch 200 100 0.50"]);
    send("pointerup", 300, 100, { pointerType: "touch", pointerId: 2 });
    send("pointermove", 150, 100, { pointerType: "touch" });
    expect(log.at(-1)).toBe("pinch 200 100 0.50");
  });

  it("keeps wheel and keys from the page only where they mean something", () => {
    const wheel = new WheelEvent("wheel", { deltaY: 3, cancelable: true });
    element.dispatchEvent(wheel);
    expect(wheel.defaultPrevented).toBe(true);
    const used = new KeyboardEvent("keydown", { key: "f", cancelable: true });
    element.dispatchEvent(used);
    expect(used.defaultPrevented).toBe(true);
    keys = false;
    const other = new KeyboardEvent("keydown", { key: "q", cancelable: true });
    element.dispatchEvent(other);
    expect(other.defaultPrevented).toBe(false);
    expect(log).toEqual(["wheel 3", "key f", "key q"]);
  });

  it("hears nothing more when it is disposed of", () => {
    input.dispose();
    send("pointerdown", 10, 10);
    expect(log).toEqual([]);
  });
});
