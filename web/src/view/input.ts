// Pointer, wheel and key events of the view, as presses, drags, pinches and keys. Holds which pointers are down,
// nothing else.
import type { Drag, Pointer } from "./desk";
import type { Key } from "./keys";

export interface InputTarget {
  /** A press; null where it means nothing more. */
  press(p: Pointer): Drag | null;
  hovered(p: Pointer): void;
  left(): void;
  /** Two fingers: their middle moved, and their distance changed by a factor. */
  pinch(x: number, y: number, dx: number, dy: number, factor: number): void;
  wheel(x: number, y: number, event: WheelEvent): void;
  key(k: Key): boolean;
  /** A drag began, went on, or ended (null). */
  dragging(drag: Drag | null): void;
}

const kClick = 4, kTouchClick = 9;

interface Down {
  x: number;
  y: number;
}

export class Input {
  private drag: Drag | null = null;
  private owner = -1;
  private start: Pointer | null = null;
  private moved = false;
  private readonly down = new Map<number, Down>();
  private readonly leave = new AbortController();

  constructor(private readonly element: HTMLElement, private readonly target: InputTarget) {
    const options = { signal: this.leave.signal };
    const on = <K extends keyof HTMLElementEventMap>(name: K, call: (e: HTMLElementEventMap[K]) => void): void =>
      element.addEventListener(name, call, { ...options, passive: false });
    on("pointerdown", (e) => this.pointerDown(e));
    on("pointermove", (e) => this.pointerMove(e));
    on("pointerup", (e) => this.pointerUp(e));
    on("pointercancel", (e) => this.pointerLost(e));
    on("lostpointercapture", (e) => { if (this.down.has(e.pointerId)) this.pointerLost(e); });
    on("pointerleave", () => { if (!this.drag) target.left(); });
    on("contextmenu", (e) => e.preventDefault());
    on("wheel", (e) => {
      e.preventDefault();
      const p = this.at(e);
      target.wheel(p.x, p.y, e);
    });
    on("keydown", (e) => this.keyDown(e));
  }

  get active(): boolean {
    return this.drag !== null;
  }

  cancel(): boolean {
    if (!this.drag) return false;
    const { drag } = this;
    this.setDrag(null);
    drag.cancel();
    return true;
  }

  dispose(): void {
    this.cancel();
    this.leave.abort();
  }

  private at(e: MouseEvent): Down {
    const box = this.element.getBoundingClientRect();
    return { x: e.clientX - box.left, y: e.clientY - box.top };
  }

  private pointer(e: PointerEvent, coalesced = false): Pointer {
    const all = coalesced && e.getCoalescedEvents ? e.getCoalescedEvents() : [];
    const ink = (all.length > 0 ? all : [e]).map((each) => ({ ...this.at(each), pressure: each.pressure }));
    return {
      ...this.at(e), button: e.button, shift: e.shiftKey, ctrl: e.ctrlKey || e.metaKey, alt: e.altKey,
      pen: e.pointerType === "pen", ink,
    };
  }

  private setDrag(drag: Drag | null): void {
    this.drag = drag;
    this.target.dragging(drag);
  }

  private pointerDown(e: PointerEvent): void {
    this.element.focus({ preventScroll: true });
    const p = this.pointer(e);
    this.down.set(e.pointerId, { x: p.x, y: p.y });
    if (e.pointerType === "touch" && this.down.size === 2) return void this.cancel();
    if (this.drag || this.down.size > 1) return;
    e.preventDefault();
    try {
      this.element.setPointerCapture(e.pointerId);
    } catch {
      // A pointer that is gone already, or was made by a script.
    }
    this.owner = e.pointerId;
    this.start = p;
    this.moved = false;
    this.setDrag(this.target.press(p));
  }

  private pointerMove(e: PointerEvent): void {
    const p = this.pointer(e, true), before = this.down.get(e.pointerId);
    if (before && this.down.size === 2 && e.pointerType === "touch") {
      const other = [...this.down].find(([id]) => id !== e.pointerId)![1];
      const was = Math.hypot(before.x - other.x, before.y - other.y), is = Math.hypot(p.x - other.x, p.y - other.y);
      this.target.pinch((p.x + other.x) / 2, (p.y + other.y) / 2, (p.x - before.x) / 2, (p.y - before.y) / 2, is > 8 &&
        was > 8 ? was / is : 1);
    }
    if (before) this.down.set(e.pointerId, { x: p.x, y: p.y });
    if (!this.drag) {
      if (!before) this.target.hovered(p);
      return;
    }
    if (e.pointerId !== this.owner) return;
    const far = Math.hypot(p.x - this.start!.x, p.y - this.start!.y);
    if (!this.moved && far <= (e.pointerType === "touch" ? kTouchClick : kClick)) return;
    this.moved = true;
    this.drag.move(p);
    this.target.dragging(this.drag);
  }

  private pointerUp(e: PointerEvent): void {
    this.down.delete(e.pointerId);
    if (!this.drag || e.pointerId !== this.owner) return;
    const { drag } = this;
    this.setDrag(null);
    drag.end(this.pointer(e), !this.moved);
    this.target.hovered(this.pointer(e));
  }

  private pointerLost(e: PointerEvent): void {
    this.down.delete(e.pointerId);
    if (e.pointerId === this.owner) this.cancel();
  }

  private keyDown(e: KeyboardEvent): void {
    if (e.defaultPrevented || e.target !== this.element) return;
    const key: Key = { key: e.key, shift: e.shiftKey, ctrl: e.ctrlKey || e.metaKey, alt: e.altKey };
    // While something is dragged, what else a key would change is in the hand: only Escape means anything.
    const handled = this.drag ? e.key !== "Escape" || this.cancel() : this.target.key(key);
    if (!handled) return;
    e.preventDefault();
    e.stopPropagation();
  }
}
