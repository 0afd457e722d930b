// What pointers, wheel and keys do to the view: which of painting, tools, camera and keys they are meant for, and the
// cursor.
import type { Desk, Drag, Pointer } from "./desk";
import type { Tool } from "./host";
import type { InputTarget } from "./input";
import { Keys, type Key } from "./keys";
import { cameraOf, panned, wheelFactor, zoomed } from "./orbit";
import { paintDrag, paintKey } from "./paint_input";
import type { PaintLayer } from "./paint_layer";
import type { Tools } from "./tools";

export class Hands implements InputTarget {
  private readonly keys: Keys;

  constructor(
    private readonly element: HTMLElement,
    private readonly desk: Desk,
    private readonly tools: Tools,
    private readonly paint: PaintLayer,
    private readonly setTool: (tool: Tool) => void,
  ) {
    this.keys = new Keys(desk, () => performance.now());
  }

  press(p: Pointer): Drag | null {
    return this.desk.tool === "paint" ? paintDrag(this.paint, p) : this.tools.press(p);
  }

  hovered(p: Pointer): void {
    const { desk } = this;
    if (desk.tool === "paint") return this.paint.hover(p.x, p.y);
    const before = JSON.stringify(desk.hover);
    this.tools.hover(p);
    if (JSON.stringify(desk.hover) !== before) desk.redraw();
    if (desk.hover) this.element.style.cursor = desk.hover.kind === "side" ? "pointer" : "grab";
    else this.plainCursor();
  }

  left(): void {
    this.desk.hover = null;
    this.plainCursor();
    this.desk.redraw();
  }

  pinch(x: number, y: number, dx: number, dy: number, factor: number): void {
    const { desk } = this;
    if (desk.tool === "paint") return;
    desk.orbit = panned(desk.orbit, desk.eye(), dx, dy);
    desk.orbit = zoomed(desk.orbit, desk.eye(), factor, x, y);
  }

  wheel(x: number, y: number, e: WheelEvent): void {
    const { desk } = this;
    if (desk.tool === "paint") return;
    desk.orbit = zoomed(desk.orbit, desk.eye(), wheelFactor(e.deltaY, e.deltaMode, e.ctrlKey), x, y);
  }

  key(k: Key): boolean {
    if (this.desk.tool === "paint") return paintKey(this.paint, k, () => this.leavePaint());
    if (k.key === "Escape") return this.escape();
    if (k.key === "Enter") return this.tools.finish();
    return this.keys.press(k);
  }

  dragging(drag: Drag | null): void {
    if (drag && this.desk.tool !== "paint") this.element.style.cursor = "grabbing";
    this.desk.redraw();
  }

  private plainCursor(): void {
    const { tool } = this.desk;
    this.element.style.cursor = tool === "select" ? "default" : tool === "paint" ? "none" : "crosshair";
  }

  private leavePaint(): void {
    this.paint.finish(cameraOf(this.desk.eye()));
    this.setTool("select");
    this.desk.host.setTool("select");
  }

  /** What is half done, else the selection, else the tool. */
  private escape(): boolean {
    const { desk } = this;
    if (this.tools.cancel()) return true;
    if (desk.selection) desk.select(null);
    else if (desk.tool !== "select") desk.host.setTool("select");
    else return false;
    return true;
  }
}
