// The canvas over the view on which a silhouette is painted, for a camera that stands still meanwhile.
import type { Camera } from "../api";
import type { Pointer } from "./desk";
import type { Brush, Painter, ViewHost } from "./host";
import { PaintGround } from "./paint_ground";
import { drawAll, drawDab, hasPaint, imageSize, kImageInks, type Dab, type Inks } from "./painting";
import type { Palette, Rgb } from "./palette";

const css = (c: Rgb): string => `rgb(${c.map((x) => Math.round(255 * x)).join(" ")})`;

export class PaintLayer {
  private readonly canvas = document.createElement("canvas");
  private readonly cursor = document.createElement("div");
  private readonly paper: CanvasRenderingContext2D;
  private ground: PaintGround | null = null;
  private before: { camera: Camera; url: string } | null = null;
  /** Until the ground is there, or can not be had. */
  private loading: Promise<PaintGround | null> = Promise.resolve(null);
  /** Of the project in which painting began. */
  private painter: Painter = () => {};
  private dabs: Dab[] = [];
  private undone: Dab[] = [];
  private current: Dab | null = null;
  private brush: Brush = "want";
  private radius = 24;
  private inks: Inks = { want: "blue", avoid: "red" };
  private width = 1;
  private height = 1;
  private ratio = 1;
  private at: [number, number] = [0, 0];

  constructor(private readonly parent: HTMLElement, private readonly host: ViewHost) {
    this.paper = this.canvas.getContext("2d")!;
    this.canvas.className = "view-paint";
    this.canvas.style.cssText = "position:absolute;inset:0;width:100%;height:100%;pointer-events:none;opacity:.72";
    this.cursor.style.cssText =
      "position:absolute;left:0;top:0;border-radius:50%;pointer-events:none;box-sizing:border-box;" +
      "border:1.5px solid #fff;box-shadow:0 0 0 1.5px rgb(0 0 0 / .65),inset 0 0 0 1px rgb(0 0 0 / .35);display:none";
  }

  /** Something was painted that did not go out yet. */
  get unsaved(): boolean {
    return this.open && this.dabs.length > 0;
  }

  get open(): boolean {
    return this.canvas.isConnected;
  }

  /** With `before`, painting goes on with that image, as soon as it is there. */
  start(width: number, height: number, before: { camera: Camera; url: string } | null): void {
    this.ground = null;
    this.before = before;
    this.painter = this.host.painter();
    this.loading = before ? PaintGround.load(before.url).catch(() => null) : Promise.resolve(null);
    void this.loading.then((ground) => {
      if (!this.open || this.before !== before) return;
      this.ground = ground;
      this.redraw();
    });
    this.dabs = [];
    this.undone = [];
    this.current = null;
    this.parent.append(this.canvas, this.cursor);
    this.resize(width, height);
    this.at = [width / 2, height / 2];
    this.moveCursor();
  }

  /** Paint stays where it is on the picture as the view becomes larger: it is what the camera sees that counts. */
  resize(width: number, height: number): void {
    if (this.dabs.length > 0 && this.height > 0) this.rescale(width, height);
    [this.width, this.height] = [width, height];
    this.ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    this.redraw();
  }

  setPalette(palette: Palette): void {
    this.inks = { want: css(palette.want), avoid: this.hatch(css(palette.avoid)) };
    if (this.open) this.redraw();
  }

  setBrush(brush: Brush, radius: number): void {
    this.brush = brush;
    this.radius = Math.min(Math.max(radius, 1), 500);
    this.moveCursor();
  }

  hover(x: number, y: number): void {
    this.at = [x, y];
    this.moveCursor();
  }

  press(p: Pointer): void {
    this.undone = [];
    this.current = { brush: this.brush, radius: this.radius, points: [] };
    this.dabs.push(this.current);
    this.move(p);
  }

  move(p: Pointer): void {
    this.hover(p.x, p.y);
    if (!this.current) return;
    const from = this.current.points.length;
    for (const { x, y } of p.ink) this.current.points.push([x, y]);
    drawDab(this.paper, this.current, this.inks, from);
  }

  release(): void {
    this.current = null;
  }

  /** The stroke that is being painted is taken back. False where there is none. */
  cancelStroke(): boolean {
    if (!this.current) return false;
    this.current = null;
    this.dabs.pop();
    this.redraw();
    return true;
  }

  undo(): boolean {
    const dab = this.dabs.pop();
    if (!dab) return false;
    this.undone.push(dab);
    this.redraw();
    return true;
  }

  redo(): boolean {
    const dab = this.undone.pop();
    if (!dab) return false;
    this.dabs.push(dab);
    this.redraw();
    return true;
  }

  /** By the keyboard: moves the brush, painting if `down`. */
  step(dx: number, dy: number, down: boolean): void {
    const [x, y] = this.at, far = Math.max(this.radius / 2, 2);
    this.at = [Math.min(Math.max(x + dx * far, 0), this.width), Math.min(Math.max(y + dy * far, 0), this.height)];
    if (down) {
      this.undone = [];
      const dab: Dab = { brush: this.brush, radius: this.radius, points: [[x, y], [...this.at]] };
      this.dabs.push(dab);
      drawDab(this.paper, dab, this.inks);
    }
    this.moveCursor();
  }

  /** Closes the layer; what was painted goes out as an image. To lose it is what undo is for. */
  finish(camera: Camera): void {
    if (!this.open) return;
    this.canvas.remove();
    this.cursor.remove();
    const { dabs, width, height, before, loading, painter } = this;
    this.ground = this.before = null;
    this.dabs = [];
    this.current = null;
    if (dabs.length === 0) return;
    // Who paints and leaves at once keeps what was there before, too.
    void loading.then((ground) => {
      if (ground || hasPaint(dabs)) this.send(dabs, width, height, ground, (image) => painter(image, before?.camera ?? camera));
    });
  }

  private send(dabs: readonly Dab[], width: number, height: number, ground: PaintGround | null, out: (image: Blob) => void): void {
    const size = imageSize(width, height), image = document.createElement("canvas");
    image.width = size.width;
    image.height = size.height;
    const paper = image.getContext("2d")!;
    drawAll(paper, dabs, kImageInks, width, height, size.scale, () => ground?.draw(paper, kImageInks, width, height, size.scale));
    image.toBlob((blob) => { if (blob) out(blob); }, "image/png");
  }

  private rescale(width: number, height: number): void {
    // The vertical angle of view stays, and so does the middle of the picture.
    const k = height / this.height;
    for (const dab of this.dabs) {
      dab.radius *= k;
      dab.points = dab.points.map(([x, y]) => [width / 2 + (x - this.width / 2) * k, y * k]);
    }
  }

  private redraw(): void {
    const { paper, inks, width, height, ratio } = this;
    drawAll(paper, this.dabs, inks, width, height, ratio, () => this.ground?.draw(paper, inks, width, height, ratio));
  }

  private moveCursor(): void {
    const { style } = this.cursor, r = this.radius;
    style.display = "block";
    style.width = style.height = `${2 * r}px`;
    style.transform = `translate(${this.at[0] - r}px, ${this.at[1] - r}px)`;
    style.borderStyle = this.brush === "erase" ? "dashed" : "solid";
  }

  /** What is to be left free is hatched, so that it does not differ by colour alone. */
  private hatch(colour: string): string | CanvasPattern {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 12;
    const paper = tile.getContext("2d")!;
    paper.fillStyle = colour;
    paper.fillRect(0, 0, 12, 12);
    paper.strokeStyle = "rgb(255 255 255 / .55)";
    paper.lineWidth = 2.5;
    for (const x of [-12, 0, 12]) {
      paper.beginPath();
      paper.moveTo(x, 12);
      paper.lineTo(x + 12, 0);
      paper.stroke();
    }
    return this.paper.createPattern(tile, "repeat") ?? colour;
  }
}
