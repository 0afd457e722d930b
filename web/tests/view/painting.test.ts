import { describe, expect, it } from "vitest";
import { drawAll, drawDab, hasPaint, imageSize, kImageInks, maskOf, placeOf, type Dab, type Paper } from "../../src/view/painting";
import { paintKey } from "../../src/view/paint_input";

/** Writes down what is asked of it. */
function paper(): Paper & { log: string[] } {
  const log: string[] = [];
  const note = (name: string) => (...values: number[]): void => { log.push(`${name} ${values.join(" ")}`); };
  return {
    log, lineWidth: 0, lineCap: "butt", lineJoin: "miter", strokeStyle: "", fillStyle: "",
    globalCompositeOperation: "source-over",
    clearRect: note("clear"), beginPath: note("begin"), moveTo: note("move"), lineTo: note("line"), arc: note("arc"),
    setTransform: note("transform"),
    stroke(this: Paper) {
      log.push(`stroke ${String(this.strokeStyle)} ${this.lineWidth} ${this.globalCompositeOperation}`);
    },
    fill(this: Paper) { log.push(`fill ${String(this.fillStyle)} ${this.globalCompositeOperation}`); },
  } as unknown as Paper & { log: string[] };
}

const line = (brush: Dab["brush"]): Dab => ({ brush, radius: 5, points: [[0, 0], [10, 0], [20, 0]] });

describe("what was painted before", () => {
  it("is taken apart by brush", () => {
    const rgba = new Uint8ClampedArray([0, 0, 0, 255, 255, 255, 255, 200, 0, 0, 0, 0]);
    const alphas = (brush: "want" | "avoid") => [...maskOf(rgba, brush)].filter((_, i) => i % 4 === 3);
    expect(alphas("want")).toEqual([255, 0, 0]);
    expect(alphas("avoid")).toEqual([0, 200, 0]);
  });

  it("fills the height of a view of any shape, in its middle", () => {
    expect(placeOf({ width: 400, height: 300 }, 800, 600)).toEqual({ x: 0, y: 0, width: 800, height: 600 });
    expect(placeOf({ width: 400, height: 300 }, 1000, 600)).toEqual({ x: 100, y: 0, width: 800, height: 600 });
    expect(placeOf({ width: 400, height: 300 }, 400, 600)).toEqual({ x: -200, y: 0, width: 800, height: 600 });
  });
});

describe("painting", () => {
  it("is black where wanted, white where not, transparent where erased", () => {
    const p = paper();
    drawDab(p, line("want"), kImageInks);
    drawDab(p, line("avoid"), kImageInks);
    drawDab(p, line("erase"), kImageInks);
    expect(p.log.filter((l) => l.startsWith("stroke"))).toEqual(
      ["stroke #000000 10 source-over", "stroke #ffffff 10 source-over", "stroke #000000 10 destination-out"]);
  });

  it("draws a dot for a tap, and goes on from where it was", () => {
    const p = paper();
    drawDab(p, { brush: "want", radius: 3, points: [[4, 5]] }, kImageInks);
    expect(p.log).toContain("fill #000000 source-over");
    p.log.length = 0;
    drawDab(p, line("want"), kImageInks, 2);
    expect(p.log.slice(1, 3)).toEqual(["move 10 0", "line 20 0"]);
    p.log.length = 0;
    drawDab(p, { ...line("want"), points: [] }, kImageInks);
    expect(p.log).toEqual([]);
  });

  it("makes an image of bounded size with the view's aspect", () => {
    expect(imageSize(800, 600)).toEqual({ width: 800, height: 600, scale: 1 });
    const large = imageSize(3000, 1500);
    expect([large.width, large.height]).toEqual([1024, 512]);
    const p = paper();
    drawAll(p, [line("want")], kImageInks, 3000, 1500, large.scale);
    expect(p.log[0]).toBe("transform 1 0 0 1 0 0");
    expect(p.log[1]).toBe("clear 0 0 1024 512");
  });

  it("counts as paint only what is wanted or not", () => {
    expect(hasPaint([])).toBe(false);
    expect(hasPaint([line("erase")])).toBe(false);
    expect(hasPaint([line("erase"), line("avoid")])).toBe(true);
  });

  it("is left by Enter and by Escape, with what was painted", () => {
    const steps: unknown[] = [];
    let left = 0;
    const layer = { step: (...s: unknown[]) => steps.push(s), undo: () => true, redo: () => false } as never;
    const key = (name: string, more = {}): boolean =>
      paintKey(layer, { key: name, shift: false, ctrl: false, alt: false, ...more }, () => { ++left; });
    expect([key("Enter"), key("Escape"), key("q"), key("z", { ctrl: true }),
      key("ArrowUp", { shift: true })]).toEqual([true, true, false, true, true]);
    expect(left).toBe(2);
    expect(steps).toEqual([[0, -1, true]]);
  });
});
