// Targets and everything that is drawn over the model: ghosts, tubes, the field, and the overlay of strokes.
import type { Curve, Scene } from "../api";
import { samples } from "./bezier";
import { fieldOf, kFieldFloats, spacing } from "./field";
import { Ghosts } from "./ghosts";
import { isHidden, type Hidden, type Look } from "./host";
import { drawOverlay, type OverlayState } from "./overlay";
import type { Palette } from "./palette";
import { curvesOf } from "./scene_edits";
import type { Stage } from "./stage";
import { fieldStrokes, kOverlay, StrokeBatch } from "./stroke_batch";
import { Strokes } from "./strokes";
import { Tubes } from "./tubes";
import { grow, join, type Box } from "./vec";

const shownCurves = (scene: Scene, hidden: Hidden): readonly Curve[] =>
  curvesOf(scene).filter((_, index) => !isHidden(hidden, { kind: "curve", index }));

export class TargetLayer {
  readonly ghosts: Ghosts;
  private readonly tubes = new Tubes();
  private readonly field = new StrokeBatch(fieldStrokes);
  private readonly overlay = new StrokeBatch(kOverlay);
  private readonly strokes = new Strokes();
  private curves: unknown = null;
  private hidden: unknown = null;
  private fieldOf: unknown = null;

  constructor(stage: Stage, changed: () => void, failed: (message: string) => void) {
    this.ghosts = new Ghosts(changed, failed);
    stage.add(this.ghosts.group, 2);
    stage.add(this.tubes.mesh, 3);
    stage.add(this.field.mesh, 4);
    stage.add(this.overlay.mesh, 9);
  }

  setScene(scene: Scene, look: Look, hidden: Hidden, meshUrl: (path: string) => string): void {
    const curves = scene.curves?.curve;
    this.ghosts.setScene(scene, meshUrl, hidden.meshes);
    this.ghosts.group.visible = look.targets;
    if (this.curves !== curves || this.hidden !== hidden.curves) this.tubes.set(shownCurves(scene, hidden));
    this.curves = curves;
    this.hidden = hidden.curves;
    if (!look.targets) this.tubes.mesh.visible = false;
    else this.tubes.show();
    // The field takes milliseconds: it is made only while it is shown. Hidden curves count, so they are in it.
    if (look.field && this.fieldOf !== curves) {
      const field = fieldOf(curvesOf(scene));
      this.field.set(field, field.length / kFieldFloats);
      this.field.uniform("uLength", 0.72 * spacing(field));
      this.fieldOf = curves;
    }
    this.field.mesh.visible = look.field && this.field.count > 0;
  }

  setPalette(p: Palette): void {
    this.ghosts.setPalette(p);
    this.tubes.setColour(p.curve);
    this.field.uniform("uColour", p.field);
  }

  draw(state: OverlayState): void {
    drawOverlay(this.strokes, state);
    this.overlay.set(this.strokes.data, this.strokes.count);
  }

  resize(width: number, height: number, ratio: number): void {
    this.field.resize(width, height, ratio);
    this.overlay.resize(width, height, ratio);
  }

  addTo(box: Box, scene: Scene, hidden: Hidden): void {
    for (const { points } of shownCurves(scene, hidden)) for (const p of samples(points, 12)) grow(box, p);
    if (scene.curves?.density) join(box, scene.curves.density);
    this.ghosts.addTo(box);
  }

  dispose(): void {
    for (const part of [this.ghosts, this.tubes, this.field, this.overlay]) part.dispose();
  }
}
