import { expect, test } from "vitest";
import { cropOf } from "../../src/view/portrait";

/** An image that is clear but for these pixels. */
function image(width: number, height: number, solid: readonly [number, number][]): Uint8ClampedArray {
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (const [x, y] of solid) rgba[4 * (y * width + x) + 3] = 255;
  return rgba;
}

test("a portrait is cut to what is in it, in the shape of the whole", () => {
  const crop = cropOf(image(40, 30, [[10, 5], [13, 14]]), 40, 30)!;
  expect(crop.width / crop.height).toBeCloseTo(4 / 3);
  expect(crop.height).toBeCloseTo(1.04 * 10);
  expect(crop.x + crop.width / 2).toBeCloseTo(12);
  expect(crop.y + crop.height / 2).toBeCloseTo(10);
});

test("what is wide counts as well as what is high, and nothing gives nothing", () => {
  expect(cropOf(image(40, 30, [[0, 3], [19, 3]]), 40, 30)!.width).toBeCloseTo(1.04 * 20);
  expect(cropOf(image(4, 3, []), 4, 3)).toBeNull();
});
