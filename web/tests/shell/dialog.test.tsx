import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, test } from "vitest";
import { Dialog } from "../../src/shell/dialog";

test("a dialog is closed by a click beside it, not by selecting text that ends there", () => {
  const root = document.createElement("div");
  document.body.append(root);
  let closed = 0;
  act(() => render(<Dialog title="T" kind="k" onClose={() => (closed += 1)}><input /></Dialog>, root));
  const dialog = root.querySelector("dialog")!;
  const send = (target: Element, type: string) => target.dispatchEvent(new PointerEvent(type, { bubbles: true }));
  send(root.querySelector("input")!, "pointerdown");
  send(dialog, "click");
  expect(closed).toBe(0);
  send(dialog, "pointerdown");
  send(dialog, "click");
  expect(closed).toBe(1);
  act(() => render(null, root));
});
