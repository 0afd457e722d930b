// Renderer, camera and the order of drawing: parts with the key light's shadow map, ground, glass of targets, lines
// over all. Under software rendering there are no shadows and no antialiasing by the context; lines are smooth anyway.
import {
  Color, DepthTexture, LessEqualCompare, LinearFilter, Matrix4, OrthographicCamera, PerspectiveCamera, Scene,
  SRGBColorSpace,
  UnsignedIntType, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget, type Object3D,
} from "three";
import { Ground } from "./ground";
import { kFovDeg, type Eye } from "./orbit";
import type { Palette } from "./palette";
import { kForMovement } from "./coarse_mesh";
import { Parts } from "./parts";
import { isEmpty, type Box } from "./vec";

const kShadowSide = 2048;
/** Milliseconds after which nobody waits for a frame's pixels any more. */
const kLongest = 1000;

export interface Opened {
  canvas: HTMLCanvasElement;
  context: WebGL2RenderingContext;
  software: boolean;
}

/** A context on a canvas of its own, and whether the machine draws by processor. `lasting`: what was drawn stays until it is drawn
 *  over, smooth on any machine: for many small pictures that are not all drawn anew in every frame. */
export function openContext(lasting = false): Opened | null {
  const create = (antialias: boolean): [HTMLCanvasElement, WebGL2RenderingContext | null] => {
    const canvas = document.createElement("canvas");
    const options = { antialias, alpha: false, powerPreference: "high-performance", stencil: false, preserveDrawingBuffer: lasting } as const;
    return [canvas, canvas.getContext("webgl2", options) as WebGL2RenderingContext | null];
  };
  const [canvas, context] = create(lasting);
  if (!context) return null;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  if (/swiftshader|llvmpipe|software|basic render/i.test(name)) return { canvas, context, software: true };
  if (lasting) return { canvas, context, software: false };
  const [smooth, smoothContext] = create(true);
  if (!smoothContext) return { canvas, context, software: false };
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return { canvas: smooth, context: smoothContext, software: false };
}

export class Stage {
  readonly renderer: WebGLRenderer;
  readonly parts: Parts;
  readonly ground: Ground;
  private readonly solid = new Scene();
  private readonly over = new Scene();
  private readonly camera = new PerspectiveCamera(kFovDeg, 1, 0.01, 1000);
  private readonly shadowCamera = new OrthographicCamera();
  private readonly shadowTarget: WebGLRenderTarget | null;
  private readonly shadowMatrix = new Matrix4();
  private readonly shadowSize = new Vector2(1 / kShadowSide, 1);
  private shadowBox: Box | null = null;
  /** Pixels of the screen in one of the page, when frames are sharp. */
  private readonly full: number;
  private awaited: WebGLSync | null = null;

  constructor(canvas: HTMLCanvasElement, context: WebGL2RenderingContext, readonly software: boolean) {
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    this.renderer.sortObjects = false; // `add` keeps the order; sorting would measure every geometry
    this.full = software ? 1 : Math.min(window.devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(this.full);
    this.parts = new Parts(!software, kForMovement);
    this.ground = new Ground(!software);
    this.camera.matrixAutoUpdate = false;
    this.shadowCamera.matrixAutoUpdate = false;
    this.solid.add(this.parts.group);
    this.add(this.ground.mesh, 0);
    this.shadowTarget = software ? null : this.makeShadowTarget();
    if (this.shadowTarget) {
      const map = this.shadowTarget.depthTexture!;
      this.parts.uniform("uShadow", map);
      this.parts.uniform("uShadowMatrix", this.shadowMatrix);
      this.parts.uniform("uShadowSize", this.shadowSize);
      this.ground.setShadow(map, this.shadowMatrix, this.shadowSize);
    }
  }

  /** After the context was lost and came back; palette and casters have to be set again. */
  restore(): void {
    if (this.shadowTarget) this.empty(this.shadowTarget);
  }

  /** Drawn after the parts, in this order. */
  add(object: Object3D, order: number): void {
    object.renderOrder = order;
    this.over.add(object);
    this.over.children.sort((a, b) => a.renderOrder - b.renderOrder);
  }

  remove(object: Object3D): void {
    this.over.remove(object);
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, true);
  }

  /** Draws with a share of the screen's pixels on a side from here on, and meshes coarse where that is less than 1; what is drawn
   *  is gone. Returns whether the share is another. */
  setSharpness(share: number): boolean {
    if (this.renderer.getPixelRatio() === this.full * share) return false;
    this.renderer.setPixelRatio(this.full * share);
    this.parts.setQuick(share < 1);
    return true;
  }

  /** Calls with the milliseconds since `began` once all that was drawn has its pixels; not if it is asked again before that. */
  whenDrawn(began: number, call: (milliseconds: number) => void): void {
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const sync = this.awaited = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (sync === null || this.awaited !== sync || gl.isContextLost()) return gl.deleteSync(sync);
      const took = performance.now() - began;
      if (gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED && took < kLongest) return void setTimeout(look, 4);
      gl.deleteSync(sync);
      this.awaited = null;
      call(took);
    };
    setTimeout(look, 4);
  }

  setPalette(p: Palette, dark: boolean): void {
    this.renderer.setClearColor(new Color().setRGB(...p.background, SRGBColorSpace), 1);
    this.ground.setPalette(p, dark);
    this.parts.uniform("uLight", dark ? 0.92 : 1.04);
    this.parts.uniform("uAccent", p.selected.map((x) => x * x));
    this.parts.uniform("uLocked", p.want.map((x) => x * x));
  }

  /** The parts changed: their shadow is drawn with the next frame. */
  setCasters(box: Box): void {
    this.shadowBox = isEmpty(box) ? null : box;
  }

  /** Returns the number of draw calls. */
  render(eye: Eye, scope: Box): number {
    const { renderer } = this;
    renderer.info.reset();
    if (this.shadowTarget && this.shadowBox && this.parts.group.visible) this.renderShadow(this.shadowBox);
    this.aim(eye, scope);
    this.ground.follow(eye);
    renderer.clear();
    renderer.render(this.solid, this.camera);
    renderer.render(this.over, this.camera);
    return renderer.info.render.calls;
  }

  /** The parts alone before nothing: rows of RGBA from below, of the eye's width and height. */
  portrait(eye: Eye, scope: Box): Uint8ClampedArray<ArrayBuffer> {
    const { renderer, parts } = this, { width, height } = eye;
    const target = new WebGLRenderTarget(width, height, { generateMipmaps: false });
    const bytes = new Uint8ClampedArray(4 * width * height), shown = parts.group.visible;
    const colour = renderer.getClearColor(new Color()), alpha = renderer.getClearAlpha();
    if (this.shadowTarget && this.shadowBox) this.renderShadow(this.shadowBox);
    this.aim(eye, scope);
    parts.group.visible = true;
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(this.solid, this.camera);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
    parts.group.visible = shown;
    target.dispose();
    return bytes;
  }

  dispose(): void {
    this.awaited = null;
    this.parts.dispose();
    this.ground.dispose();
    this.shadowTarget?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private aim(eye: Eye, scope: Box): void {
    const { camera } = this;
    const radius = isEmpty(scope) ? 10 : Math.hypot(...[0, 1, 2].map((i) => Math.max(
      Math.abs(scope.min[i]! - eye.position[i]!), Math.abs(scope.max[i]! - eye.position[i]!))));
    camera.aspect = eye.width / eye.height;
    camera.far = Math.max(radius, 30 * eye.distance, 100);
    camera.near = Math.min(Math.max(eye.distance * 0.01, camera.far * 1e-5), eye.distance * 0.3);
    camera.updateProjectionMatrix();
    camera.matrix.makeBasis(new Vector3(...eye.right), new Vector3(...eye.up),
      new Vector3(...eye.back)).setPosition(...eye.position as [number, number, number]);
    camera.matrixWorldNeedsUpdate = true;
  }

  private makeShadowTarget(): WebGLRenderTarget {
    const depthTexture = new DepthTexture(kShadowSide, kShadowSide, UnsignedIntType);
    depthTexture.compareFunction = LessEqualCompare;
    depthTexture.minFilter = depthTexture.magFilter = LinearFilter;
    const target = new WebGLRenderTarget(kShadowSide, kShadowSide, { depthTexture, generateMipmaps: false });
    this.empty(target);
    return target;
  }

  /** Nothing is in the way of the light: a texture that was never drawn to is none. */
  private empty(target: WebGLRenderTarget): void {
    this.renderer.setRenderTarget(target);
    this.renderer.clear();
    this.renderer.setRenderTarget(null);
  }

  private renderShadow(box: Box): void {
    const { renderer, shadowCamera: light } = this;
    const key = (this.parts.material.uniforms["uKey"]!.value as Vector3).clone();
    const middle = new Vector3(...box.min).add(new Vector3(...box.max)).multiplyScalar(0.5);
    const radius = Math.max(new Vector3(...box.max).distanceTo(middle), 1e-4) * 1.02;
    const across = new Vector3(key.z, 0, -key.x).normalize(), up = key.clone().cross(across);
    light.left = light.bottom = -radius;
    light.right = light.top = radius;
    light.near = 0;
    light.far = 3 * radius; // on beyond the model, to the ground below it
    light.updateProjectionMatrix();
    light.matrix.makeBasis(across, up, key).setPosition(middle.addScaledVector(key, radius));
    light.matrixWorld.copy(light.matrix);
    light.matrixWorldInverse.copy(light.matrixWorld).invert();
    light.matrixWorldNeedsUpdate = true;
    this.shadowMatrix.set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1)
      .multiply(light.projectionMatrix).multiply(light.matrixWorldInverse);
    this.shadowSize.y = 2 * radius / kShadowSide;
    this.solid.overrideMaterial = this.parts.shadowMaterial;
    renderer.setRenderTarget(this.shadowTarget);
    renderer.clear();
    renderer.render(this.solid, light);
    renderer.setRenderTarget(null);
    this.solid.overrideMaterial = null;
    this.shadowBox = null;
  }
}
