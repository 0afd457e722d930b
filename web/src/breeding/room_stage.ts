// All models of a screen on one canvas: one drawing context, a viewport for each. A frame draws what turned or changed; where the
// machine is slow, a part of that, and the rest in the next frames.
import { Color, PerspectiveCamera, SRGBColorSpace, Vector3, WebGLRenderer, WebGLRenderTarget } from "three";
import { MessageError, decodeMeshes, type MeshTable } from "../view/messages";
import { hex, kDark, kLight, type Palette } from "../view/palette";
import { encodePortrait, kPortraitHeight, kPortraitScale, kPortraitWidth } from "../view/portrait";
import { openContext, type Opened } from "../view/stage";
import { commonSpan, frameOf, kElevation, kFov, tilted, type Span } from "./framing";
import type { Rect } from "./grid_layout";
import { StandingModel } from "./standing_model";

export interface StagePlace {
  individual: number;
  rect: Rect;
  /** Can be turned by hand. */
  large: boolean;
}

/** Radians in a second: a turn takes 20. */
const kTurn = 2 * Math.PI / 20;
/** Milliseconds from frame to frame; where they are more, fewer models are drawn the next time. */
const kSlow = 40;
/** Models that are kept though nobody shows them: a generation and what is looked at. */
const kSpare = 22;
/** Models in a frame; at first, where the processor draws. */
const kMost = 64, kMostSlow = 5;
/** Where the processor draws, frames would keep it from taking in models: it waits until no more come for so many milliseconds, but no
 *  longer than that from frame to frame. */
const kArriving = 80, kMostHeld = 300;
/** Between the models: the background of the page. */
const kGapDark = new Color(0x17191c), kGapLight = new Color(0xdde1e5);
/** Small pictures need more of a difference from what is around them than the one large view. */
const kCellLight: Palette = { ...kLight, background: hex(0xf2f4f6), ground: hex(0xe2e6ea) };

export class RoomStage {
  readonly element: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly camera = new PerspectiveCamera(kFov * 180 / Math.PI, 1, 0.01, 1000);
  private readonly models = new Map<number, { drawn: StandingModel; message: ArrayBuffer }>();
  /** For the models to come: shaders are compiled, and buffers large enough. */
  private readonly spare: StandingModel[] = [];
  private table: { message: ArrayBuffer; decoded: MeshTable } | null = null;
  private places: readonly StagePlace[] = [];
  /** Which places are to be drawn. */
  private stale = new Set<number>();
  private wholly = true;
  private turning = false;
  private oneScale = false;
  private dark = true;
  private azimuth = 0.6;
  private elevation = kElevation;
  private byHand = 0;
  private width = 0;
  private height = 0;
  private frame = 0;
  private last = 0;
  private most: number;
  private readonly software: boolean;
  private next = 0;
  /** When the newest model came, and when the last frame was drawn. */
  private arrived = 0;
  private drew = 0;
  private readonly back = new Vector3();
  private readonly right = new Vector3();
  private readonly up = new Vector3();

  /** Null where the browser cannot draw. */
  static open(complain: (text: string) => void): RoomStage | null {
    const opened = openContext(true);
    return opened === null ? null : new RoomStage(opened, complain);
  }

  private constructor(opened: Opened, private readonly complain: (text: string) => void) {
    this.element = opened.canvas;
    this.software = opened.software;
    this.most = opened.software ? kMostSlow : kMost;
    this.renderer = new WebGLRenderer({ canvas: opened.canvas, context: opened.context });
    this.renderer.autoClear = false;
    this.renderer.sortObjects = false;
    this.renderer.setPixelRatio(opened.software ? 1 : Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setScissorTest(true);
    this.camera.matrixAutoUpdate = false;
    document.addEventListener("visibilitychange", this.onVisible);
    opened.canvas.addEventListener("webglcontextlost", this.onLost);
    opened.canvas.addEventListener("webglcontextrestored", this.onRestored);
  }

  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    [this.width, this.height] = [width, height];
    this.renderer.setSize(width, height, true);
    this.redraw();
  }

  setMeshes(message: ArrayBuffer): void {
    if (this.table?.message === message) return;
    this.guard(() => {
      this.table = { message, decoded: decodeMeshes(message) };
    });
  }

  /** The newest of each individual; those that are not named are gone. */
  setModels(models: ReadonlyMap<number, { model: ArrayBuffer }>): void {
    for (const [id, { drawn }] of this.models) {
      if (models.has(id)) continue;
      if (this.spare.length < kSpare) this.spare.push(drawn);
      else drawn.dispose();
      this.models.delete(id);
      this.staleOf(id);
    }
    const table = this.table?.decoded;
    if (table === undefined) return;
    for (const [id, { model }] of models) {
      const before = this.models.get(id);
      if (before?.message === model) continue;
      this.guard(() => {
        if (before === undefined) {
          const drawn = this.spare.pop() ?? new StandingModel(this.software);
          drawn.set(model, table);
          drawn.setPalette(this.dark ? kDark : kCellLight, this.dark);
          this.models.set(id, { drawn, message: model });
        } else {
          before.message = model;
          before.drawn.set(model, table);
        }
      });
      this.staleOf(id);
      this.arrived = performance.now();
    }
    if (this.oneScale) this.redraw();
    this.wake();
  }

  setPlaces(places: readonly StagePlace[]): void {
    this.places = places;
    this.stale.clear(); // there may be fewer
    this.redraw();
  }

  setLook(look: { dark: boolean; oneScale: boolean; turning: boolean }): void {
    this.dark = look.dark;
    this.oneScale = look.oneScale;
    this.turning = look.turning;
    const palette = look.dark ? kDark : kCellLight;
    for (const { drawn } of this.models.values()) drawn.setPalette(palette, look.dark);
    this.redraw();
  }

  /** Radians, by dragging the large model. */
  turnBy(azimuth: number, elevation: number): void {
    this.byHand += azimuth;
    this.elevation = tilted(this.elevation, elevation);
    this.places.forEach((place, i) => place.large && this.stale.add(i));
    this.wake();
  }

  /** The model alone, small, as it is seen at the moment; null where there is nothing to be seen. */
  async portrait(individual: number): Promise<Blob | null> {
    const model = this.models.get(individual)?.drawn;
    if (model === undefined) return null;
    const { renderer } = this, width = kPortraitScale * kPortraitWidth, height = kPortraitScale * kPortraitHeight;
    const target = new WebGLRenderTarget(width, height, { generateMipmaps: false });
    const bytes = new Uint8ClampedArray(4 * width * height);
    const before = renderer.getClearColor(new Color());
    this.aim(model.span, null, width / height, this.azimuth, kElevation);
    model.light(this.azimuth);
    model.setSmall(false);
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(target);
    renderer.clear();
    model.withoutDisc(() => renderer.render(model.scene, this.camera));
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
    renderer.setRenderTarget(null);
    renderer.setClearColor(before, 1);
    target.dispose();
    return encodePortrait(bytes, width, height);
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    document.removeEventListener("visibilitychange", this.onVisible);
    for (const drawn of [...this.spare, ...[...this.models.values()].map((one) => one.drawn)]) drawn.dispose();
    this.models.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.element.remove();
  }

  private readonly onVisible = (): void => {
    this.last = 0;
    this.wake();
  };

  private readonly onLost = (event: Event): void => {
    event.preventDefault(); // then it comes back
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  };

  private readonly onRestored = (): void => this.redraw();

  private guard(action: () => void): void {
    try {
      action();
    } catch (error) {
      if (!(error instanceof MessageError)) throw error;
      this.complain(error.message);
    }
  }

  private staleOf(id: number): void {
    this.places.forEach((place, i) => place.individual === id && this.stale.add(i));
  }

  private redraw(): void {
    this.wholly = true;
    this.places.forEach((_, i) => this.stale.add(i));
    this.wake();
  }

  private wake(): void {
    this.tellUndrawn();
    if (this.frame === 0 && !document.hidden) this.frame = requestAnimationFrame(this.draw);
  }

  private readonly draw = (now: number): void => {
    this.frame = 0;
    if (document.hidden) return;
    if (this.software && now - this.arrived < kArriving && now - this.drew < kMostHeld) return this.wake();
    this.drew = now;
    const passed = this.last === 0 ? 0 : now - this.last;
    this.last = now;
    if (this.turning) this.azimuth += kTurn * Math.min(passed, 100) / 1000;
    if (this.turning && passed > 0) {
      const { most } = this;
      this.most = passed > kSlow ? Math.max(1, Math.floor(Math.min(most, this.places.length) * 0.6)) : Math.min(kMost, most + 1);
    }
    if (this.wholly) this.clearAll();
    const shared = this.oneScale ? commonSpan(this.places.flatMap((place) => this.models.get(place.individual)?.drawn.span ?? [])) : null;
    const count = this.places.length;
    let drawn = 0;
    for (let i = 0; i < count && drawn < this.most; ++i) {
      const at = (this.next + i) % count;
      if (!this.turning && !this.stale.has(at)) continue;
      this.drawPlace(this.places[at]!, shared);
      this.stale.delete(at);
      ++drawn;
      if (drawn === this.most) this.next = (at + 1) % count;
    }
    if ((this.turning && this.models.size > 0) || this.stale.size > 0) this.wake();
    else this.last = 0;
    this.tellUndrawn();
  };

  /** On the canvas: how many of the places do not show yet what they are to show. */
  private tellUndrawn(): void {
    const undrawn = String(this.stale.size), { dataset } = this.element;
    if (dataset.undrawn !== undrawn) dataset.undrawn = undrawn;
  }

  private clearAll(): void {
    this.wholly = false;
    const { renderer } = this;
    renderer.setViewport(0, 0, this.width, this.height);
    renderer.setScissor(0, 0, this.width, this.height);
    renderer.setClearColor(this.dark ? kGapDark : kGapLight, 1);
    renderer.clear();
    renderer.setClearColor(new Color().setRGB(...(this.dark ? kDark : kCellLight).background, SRGBColorSpace), 1);
  }

  private drawPlace({ individual, rect, large }: StagePlace, shared: Span | null): void {
    const { renderer } = this, y = this.height - rect.y - rect.height;
    renderer.setViewport(rect.x, y, rect.width, rect.height);
    renderer.setScissor(rect.x, y, rect.width, rect.height);
    renderer.clear();
    const model = this.models.get(individual)?.drawn;
    if (model === undefined) return;
    const azimuth = this.azimuth + (large ? this.byHand : 0);
    this.aim(model.span, shared, rect.width / rect.height, azimuth, large ? this.elevation : kElevation);
    model.light(azimuth);
    model.setSmall(!large);
    renderer.render(model.scene, this.camera);
  }

  private aim(own: Span, shared: Span | null, aspect: number, azimuth: number, elevation: number): void {
    const { camera, back, right, up } = this;
    const frame = frameOf(shared ?? own, aspect, elevation);
    const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
    back.set(sa * ce, se, ca * ce);
    right.set(ca, 0, -sa);
    up.set(-sa * se, ce, -ca * se);
    camera.aspect = aspect;
    camera.near = frame.distance * 0.02;
    camera.far = frame.distance * 4 + 4 * Math.abs(own.low);
    camera.updateProjectionMatrix();
    camera.matrix.makeBasis(right, up, back).setPosition(
      own.x + back.x * frame.distance, frame.height + back.y * frame.distance, own.z + back.z * frame.distance);
    camera.matrixWorldNeedsUpdate = true;
  }
}
