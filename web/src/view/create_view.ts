// The view: puts drawing, camera, tools and keys together behind StudioView. Frames are drawn when something changed,
// never in a loop.
import type { Camera, Scene } from "../api";
import type { Desk, Under } from "./desk";
import { Draft } from "./draft";
import { Hands } from "./hands";
import { kNoneHidden, type Brush, type Hidden, type Highlight, type Look, type Portrait, type Selection, type Side, type StudioView,
  type Tool, type ViewHost } from "./host";
import { Input } from "./input";
import { ModelLayer } from "./model_layer";
import { Motion } from "./motion";
import { Notices, NoView } from "./notices";
import { cameraOf, eyeOf, framed, orbitOf, rayThrough, snapped, type Eye, type Orbit } from "./orbit";
import type { Hover } from "./overlay";
import { PaintLayer } from "./paint_layer";
import { kDark, kLight, type Palette } from "./palette";
import { Sharpness } from "./sharpness";
import { openContext, Stage, type Opened } from "./stage";
import type { Ink } from "./stroke_placing";
import { TargetLayer } from "./target_layer";
import { Tools } from "./tools";
import { along, emptyBox, isEmpty, join, type Box, type V } from "./vec";

function later(call: () => void, milliseconds: number): () => void {
  const id = setTimeout(call, milliseconds);
  return () => clearTimeout(id);
}

export const kLook: Look = { parts: true, bones: false, field: false, targets: true, ground: true, dark: true };

/** What frames and models cost, for measuring: milliseconds of script. */
export interface Cost {
  frame: number;
  frames: number;
  calls: number;
  model: number;
}

/** Fills `element` with the view. Without WebGL 2 it says so, and does nothing else. */
export function createView(element: HTMLElement, host: ViewHost): StudioView {
  const opened = openContext();
  return opened ? new View(element, host, opened) : new NoView(element);
}

export class View implements StudioView, Desk {
  readonly cost: Cost = { frame: 0, frames: 0, calls: 0, model: 0 };
  readonly draft: Draft;
  selection: Selection | null = null;
  tool: Tool = "select";
  hover: Hover | null = null;
  ink: readonly Ink[] = [];
  snapMark: V | null = null;
  hidden: Hidden = kNoneHidden;
  private look = kLook;
  private highlight: Highlight = { locked: [] };
  private palette: Palette = kDark;
  private size = { width: 1, height: 1 };
  private readonly motion = new Motion();
  private readonly stage: Stage;
  private readonly sharpness: Sharpness;
  private readonly model: ModelLayer;
  private readonly layer: TargetLayer;
  private readonly paint: PaintLayer;
  private readonly notices: Notices;
  private readonly tools: Tools;
  private readonly hands: Hands;
  private readonly input: Input;
  private readonly observer: ResizeObserver;
  private meshUrl: (path: string) => string = (path) => path;
  private request = 0;
  private arrived: { model: number; at: number } | null = null;
  /** Whether the camera was moved by hand: then the first model does not move it. */
  private touched = false;

  constructor(private readonly element: HTMLElement, readonly host: ViewHost, opened: Opened) {
    const { canvas, context, software } = opened;
    element.classList.add("view");
    element.style.position = "relative";
    element.style.overflow = "hidden";
    element.style.touchAction = "none";
    element.tabIndex = 0;
    element.setAttribute("role", "application");
    element.setAttribute("aria-label", "Model and targets in space");
    canvas.style.display = "block";
    canvas.setAttribute("aria-hidden", "true");
    element.replaceChildren(canvas);
    this.notices = new Notices(element);
    this.stage = new Stage(canvas, context, software);
    this.sharpness = new Sharpness({ now: () => performance.now(), later: (milliseconds, call) => later(call, milliseconds) }, () => this.redraw());
    this.model = new ModelLayer(this.stage);
    this.layer = new TargetLayer(this.stage, () => this.applyScene(), (message) => this.notices.complain(message, 8000));
    this.draft = new Draft(host, {
      frame: (call) => void requestAnimationFrame(call),
      later,
    }, () => this.applyScene());
    this.tools = new Tools(this);
    this.paint = new PaintLayer(element, host);
    this.hands = new Hands(element, this, this.tools, this.paint, (tool) => this.setTool(tool));
    this.input = new Input(element, this.hands);
    canvas.addEventListener("webglcontextlost", (e) => {
      e.preventDefault();
      this.notices.complain("The graphics were lost; waiting for them to come back.");
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.notices.complain("");
      this.stage.restore();
      this.setLook(this.look);
    });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(element);
    this.resize();
    this.setLook(this.look);
  }

  // What the page asks for.

  setMeshes(message: ArrayBuffer): void {
    this.notices.guard(() => this.model.setMeshes(message));
  }

  setModel(message: ArrayBuffer | null): void {
    if (message === null) {
      this.model.clear();
      this.arrived = null;
      return this.redraw();
    }
    const at = performance.now();
    this.notices.guard(() => {
      const number = this.model.setModel(message);
      this.arrived = { model: number, at };
      if (!this.touched && !isEmpty(this.model.box)) {
        this.touched = true;
        this.motion.set(framed(this.motion.orbit, this.everything(), this.size.width / this.size.height));
      }
    });
    this.cost.model = performance.now() - at;
    this.redraw();
  }

  setCloud(message: ArrayBuffer | null): void {
    this.notices.guard(() => this.model.setCloud(message));
    this.redraw();
  }

  setRules(names: string[]): void {
    this.model.setRules(names);
    this.redraw();
  }

  setScene(scene: Scene, meshUrl: (path: string) => string): void {
    this.meshUrl = meshUrl;
    this.draft.receive(scene);
  }

  setHidden(hidden: Hidden): void {
    this.hidden = hidden;
    this.hover = null;
    this.applyScene();
  }

  setSelection(selection: Selection | null): void {
    this.selection = selection;
    this.layer.ghosts.select(selection?.kind === "mesh" ? selection.index : -1);
    this.setHighlight(this.highlight);
  }

  setTool(tool: Tool): void {
    if (tool === this.tool) return;
    this.input.cancel();
    this.tools.finish(tool);
    if (this.tool === "paint") this.paint.finish(this.camera());
    this.tool = tool;
    if (tool === "paint") {
      this.motion.set(this.motion.goal);
      const before = this.host.paintedBefore(this.camera()), orbit = before && orbitOf(before.camera);
      if (orbit) this.orbit = orbit;
      this.paint.start(this.size.width, this.size.height, orbit && before);
    }
    this.hands.left();
  }

  setBrush(brush: Brush, radius: number): void {
    this.paint.setBrush(brush, radius);
  }

  setLook(look: Look): void {
    this.look = look;
    this.palette = look.dark ? kDark : kLight;
    this.stage.setPalette(this.palette, look.dark);
    this.notices.setPalette(this.palette);
    for (const part of [this.model, this.layer, this.paint]) part.setPalette(this.palette);
    this.model.setLook(look);
    this.applyScene();
  }

  setHighlight(highlight: Highlight): void {
    this.highlight = highlight;
    this.model.setHighlight(highlight, this.selection?.kind === "gene" ? this.selection.gene : null);
    this.redraw();
  }

  snap(side: Side): void {
    this.snapSide(side);
  }

  camera(): Camera {
    return cameraOf(this.eye());
  }

  async picture(): Promise<Portrait | null> {
    const taken = this.model.portrait(this.motion.goal);
    this.redraw();
    return taken;
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.sharpness.dispose();
    this.input.dispose();
    this.paint.finish(this.camera());
    for (const part of [this.notices, this.model, this.layer, this.stage]) part.dispose();
    this.element.replaceChildren();
  }

  get painting(): boolean {
    return this.paint.unsaved;
  }

  // What the tools ask for.

  get targets(): boolean {
    return this.look.targets;
  }

  get orbit(): Orbit {
    return this.motion.goal;
  }

  set orbit(orbit: Orbit) {
    this.touched = true;
    this.motion.set(orbit);
    this.redraw();
  }

  eye(): Eye {
    return eyeOf(this.motion.orbit, this.size.width, this.size.height);
  }

  under(x: number, y: number): Under | null {
    const { origin, direction } = rayThrough(this.eye(), x, y);
    const hit = this.model.pick(origin, direction);
    if (hit) return { kind: "gene", gene: hit.gene, point: along(origin, hit.t, direction) };
    const ghost = this.look.targets ? this.layer.ghosts.pick(origin, direction) : null;
    return ghost && { kind: "mesh", index: ghost.index, point: along(origin, ghost.t, direction) };
  }

  genes(): readonly number[] {
    return this.model.genes();
  }

  /** Shown at once; the page says the same a moment later. */
  select(selection: Selection | null): void {
    this.setSelection(selection);
    this.host.select(selection);
  }

  snapSide(side: Side): void {
    if (this.tool !== "paint") this.go(snapped(this.motion.goal, side));
  }

  frame(): void {
    if (this.tool !== "paint") this.go(framed(this.motion.goal, this.everything(), this.size.width / this.size.height));
  }

  say(words: string): void {
    this.notices.say(words);
  }

  redraw(): void {
    if (this.request === 0) this.request = requestAnimationFrame((now) => this.draw(now));
  }

  private go(to: Orbit): void {
    this.touched = true;
    this.motion.go(to, window.matchMedia?.("(prefers-reduced-motion: reduce)").matches ?? false);
    this.redraw();
  }

  private applyScene(): void {
    this.layer.setScene(this.draft.scene, this.look, this.hidden, this.meshUrl);
    this.redraw();
  }

  private everything(): Box {
    const box = emptyBox();
    join(box, this.model.box);
    if (this.look.targets) this.layer.addTo(box, this.draft.scene, this.hidden);
    return box;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width < 1 || height < 1) return;
    this.size = { width, height };
    this.stage.resize(width, height);
    this.fit();
    if (this.paint.open) this.paint.resize(width, height);
    // Drawn at once: a canvas that was given a new size is empty until then.
    this.draw(performance.now());
  }

  /** Lines know how many pixels there are. */
  private fit(): void {
    const { width, height } = this.size, ratio = this.stage.renderer.getPixelRatio();
    this.model.resize(width, height, ratio);
    this.layer.resize(width, height, ratio);
  }

  private draw(now: number): void {
    const start = performance.now();
    cancelAnimationFrame(this.request);
    this.request = 0;
    const share = this.sharpness.next();
    if (this.stage.setSharpness(share)) this.fit();
    this.motion.step(now);
    const eye = this.eye(), { draft, palette, hover, ink, snapMark, look, hidden } = this;
    const selection = this.tool === "paint" ? null : this.selection; // handles would be in the brush's way
    this.layer.draw({ eye, scene: draft.scene, palette, selection, hover, targets: look.targets, hidden, ink,
      snap: snapMark });
    const scope = this.everything();
    this.cost.calls = this.stage.render(eye, scope);
    const end = performance.now();
    this.cost.frame = end - start;
    ++this.cost.frames;
    if (this.arrived) this.host.drawn(this.arrived.model, end - this.arrived.at);
    // For e2e/measure.ts.
    const detail = { model: this.arrived?.model ?? null, milliseconds: this.cost.frame, calls: this.cost.calls };
    this.element.dispatchEvent(new CustomEvent("viewframe", { detail, bubbles: true }));
    this.arrived = null;
    if (share === 1) this.stage.whenDrawn(start, (milliseconds) => this.sharpness.took(milliseconds));
    if (this.motion.moving) this.redraw();
  }
}
