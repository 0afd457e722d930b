// Which drag a press begins, what the pointer hovers over, and what the keys do.
import type { Desk, Drag, Pointer } from "./desk";
import { hitCurve, hitPoint } from "./curve_picking";
import { cameraDrag, clickOnly, curveDrag, gizmoDrag, pointDrag, shapeDrag, strokeDrag,
  type HeightStep } from "./drags";
import { gizmoHandles, hitGizmo } from "./gizmo";
import { hitGnomon } from "./gnomon";
import { isHidden, type Tool } from "./host";
import { depthOf } from "./orbit";
import type { Hover } from "./overlay";
import { placingOf } from "./placing";
import { point as pointAt, nearest } from "./bezier";
import { rayThrough } from "./orbit";
import { curvesOf, meshesOf } from "./scene_edits";
import { kShapes, type Shape } from "./shapes";
import { along } from "./vec";

export class Tools {
  private height: HeightStep | null = null;

  constructor(private readonly desk: Desk) {}

  /** What lies under the pointer that can be taken. */
  hoverAt(x: number, y: number): Hover | null {
    const { desk } = this, eye = desk.eye(), side = hitGnomon(eye, x, y);
    if (side) return { kind: "side", side };
    if (!desk.targets) return null;
    const { hidden } = desk, scene = desk.draft.scene;
    const selection = desk.selection && isHidden(hidden, desk.selection) ? null : desk.selection;
    if (selection?.kind === "mesh" && meshesOf(scene)[selection.index]) {
      const handle = hitGizmo(gizmoHandles(eye, placingOf(meshesOf(scene)[selection.index]!)), x, y);
      if (handle) return { kind: "gizmo", handle };
    }
    if (selection?.kind === "curve" && curvesOf(scene)[selection.index]) {
      const point = hitPoint(eye, curvesOf(scene)[selection.index]!.points, x, y);
      if (point !== null) return { kind: "point", index: selection.index, point };
    }
    const index = hitCurve(eye, curvesOf(scene), x, y, hidden.curves);
    return index === null ? null : { kind: "curve", index };
  }

  hover(p: Pointer): void {
    if (this.height) return this.height.move(p);
    this.desk.hover = this.hoverAt(p.x, p.y);
  }

  press(p: Pointer): Drag | null {
    const { desk } = this;
    if (this.height && p.button === 0) {
      const step = this.height;
      this.height = null;
      step.move(p);
      step.finish();
      return null;
    }
    if (p.button === 1 || p.alt) return cameraDrag(desk, p, p.shift ? "pan" : p.ctrl ? "zoom" : "orbit");
    if (p.button === 2) return cameraDrag(desk, p, "pan");
    if (p.button !== 0) return null;
    const over = this.hoverAt(p.x, p.y);
    desk.hover = over;
    if (over?.kind === "side") return clickOnly(() => desk.snapSide(over.side));
    if (over?.kind === "gizmo" && desk.selection?.kind === "mesh") {
      const { index } = desk.selection, eye = desk.eye();
      const handle = gizmoHandles(eye, placingOf(meshesOf(desk.draft.scene)[index]!))
        .find((h) => h.kind === over.handle.kind && h.axis === over.handle.axis)!;
      return gizmoDrag(desk, index, handle, p);
    }
    if (over?.kind === "point") {
      desk.select({ kind: "curve", index: over.index, point: over.point });
      return pointDrag(desk, over.index, over.point, p);
    }
    if (desk.tool === "curve" || (desk.tool === "select" && p.ctrl)) {
      return strokeDrag(desk, p, () => {
        if (over?.kind === "curve") desk.select({ kind: "curve", index: over.index });
        else desk.select(null);
      });
    }
    if (kShapes.includes(desk.tool as Shape)) {
      return shapeDrag(desk, desk.tool as Shape, p, (step) => { this.height = step; });
    }
    if (over?.kind === "curve") {
      desk.select({ kind: "curve", index: over.index });
      return curveDrag(desk, over.index, p, this.depthOfCurve(over.index, p));
    }
    return cameraDrag(desk, p, p.shift ? "pan" : "orbit", (q) => this.click(q));
  }

  /** Leaves what is half done: Escape. True where there was something. */
  cancel(): boolean {
    const step = this.height;
    this.height = null;
    step?.cancel();
    return step !== null;
  }

  /** Takes the height as it is: by the keyboard, or because another tool was chosen. */
  finish(next?: Tool): boolean {
    const step = this.height;
    this.height = null;
    step?.finish(next);
    return step !== null;
  }

  private click(p: Pointer): void {
    const under = this.desk.under(p.x, p.y);
    if (!under) this.desk.select(null);
    else if (under.kind === "gene") this.desk.select({ kind: "gene", gene: under.gene });
    else if (this.desk.targets) this.desk.select({ kind: "mesh", index: under.index });
  }

  /** Depth at which a curve lies under the pointer: of its point nearest to the pointer's ray. */
  private depthOfCurve(index: number, p: Pointer): number {
    const eye = this.desk.eye(), { points } = curvesOf(this.desk.draft.scene)[index]!;
    const ray = rayThrough(eye, p.x, p.y);
    let depth = depthOf(eye, points[0]);
    for (let k = 0; k < 4; ++k) {
      const reach = depth / -(ray.direction[0] * eye.back[0] + ray.direction[1] * eye.back[1] +
        ray.direction[2] * eye.back[2]);
      depth = depthOf(eye, pointAt(points, nearest(points, along(ray.origin, reach, ray.direction))));
    }
    return Math.max(depth, 1e-3 * eye.distance);
  }
}
