// What was painted of a silhouette before: its image, taken apart by brush, in whatever inks it is wanted.
import { maskOf, placeOf, type Inks } from "./painting";

export class PaintGround {
  private constructor(private readonly masks: Record<"want" | "avoid", HTMLCanvasElement>, readonly width: number, readonly height: number) {}

  static async load(url: string): Promise<PaintGround> {
    const image = new Image();
    image.src = url;
    await image.decode();
    const { naturalWidth: width, naturalHeight: height } = image;
    const whole = canvasOf(width, height);
    const paper = whole.getContext("2d")!;
    paper.drawImage(image, 0, 0);
    const rgba = paper.getImageData(0, 0, width, height).data;
    const mask = (brush: "want" | "avoid") => {
      const canvas = canvasOf(width, height);
      canvas.getContext("2d")!.putImageData(new ImageData(maskOf(rgba, brush), width, height), 0, 0);
      return canvas;
    };
    return new PaintGround({ want: mask("want"), avoid: mask("avoid") }, width, height);
  }

  /** Onto a paper that shows a view of so many pixels, `scale` of its own to each. */
  draw(paper: CanvasRenderingContext2D, inks: Inks, width: number, height: number, scale: number): void {
    const at = placeOf(this, width, height);
    for (const brush of ["avoid", "want"] as const) {
      const tinted = canvasOf(Math.round(width * scale), Math.round(height * scale));
      const tint = tinted.getContext("2d")!;
      tint.setTransform(scale, 0, 0, scale, 0, 0);
      tint.drawImage(this.masks[brush], at.x, at.y, at.width, at.height);
      tint.globalCompositeOperation = "source-in";
      tint.fillStyle = inks[brush];
      tint.fillRect(0, 0, width, height);
      paper.drawImage(tinted, 0, 0, width, height);
    }
  }
}

function canvasOf(width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(1, width);
  canvas.height = Math.max(1, height);
  return canvas;
}
