// Painting by pointer and by keys.
import type { Drag, Pointer } from "./desk";
import type { Key } from "./keys";
import type { PaintLayer } from "./paint_layer";

export function paintDrag(paint: PaintLayer, p: Pointer): Drag | null {
  if (p.button !== 0) return null;
  paint.press(p);
  return { move: (q) => paint.move(q), end: () => paint.release(), cancel: () => paint.cancelStroke() };
}

/** Arrows move the brush, with shift they paint. `leave` ends the tool. */
export function paintKey(paint: PaintLayer, k: Key, leave: () => void): boolean {
  const arrows: Record<string, readonly [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1],
    ArrowDown: [0, 1] };
  const arrow = arrows[k.key];
  if (arrow) return paint.step(arrow[0], arrow[1], k.shift), true;
  if (k.ctrl && k.key.toLowerCase() === "z") return k.shift ? paint.redo() : paint.undo();
  if (k.ctrl && k.key.toLowerCase() === "y") return paint.redo();
  if (k.ctrl || k.alt) return false;
  if (k.key === "Enter" || k.key === "Escape") return leave(), true;
  return false;
}
