import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../src/api";
import { arcLength, nearest, point, samples, velocity, type Cubic } from "../../src/view/bezier";
import { fitCubic, resample, worst } from "../../src/view/fit_curve";
import { distance } from "../../src/view/vec";

const arch: Cubic = [[0, 0, 0], [0, 2, 0], [3, 2, 1], [3, 0, 1]];
const s: Cubic = [[0, 0, 0], [2, 0, 0], [0, 1, 0], [2, 1, 0]];
const loop: Cubic = [[0, 0, 0], [3, 2, 0], [-2, 2, 0], [1, 0, 0]];

/** Points of a curve at uneven parameters, as a hand makes them. */
const uneven = (c: Cubic, count: number): Vec3[] =>
  Array.from({ length: count }, (_, i) => { const u = i / (count - 1); return point(c,
    u + 0.12 * Math.sin(2 * Math.PI * u)); });

describe("Bézier curves", () => {
  it("has its ends and the direction of its handles", () => {
    expect(point(arch, 0)).toEqual([0, 0, 0]);
    expect(point(arch, 1)).toEqual([3, 0, 1]);
    expect(velocity(arch, 0)).toEqual([0, 6, 0]);
    expect(arcLength([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]])).toBeCloseTo(3, 9);
  });

  it("finds the nearest point", () => {
    for (const t of [0, 0.13, 0.5, 0.77, 1]) expect(nearest(arch, point(arch, t))).toBeCloseTo(t, 6);
    expect(nearest(arch, [-5, -5, 0])).toBe(0);
  });
});

describe("fitCubic", () => {
  it.each([["arch", arch], ["s", s], ["loop", loop]] as const)("recovers an exact curve: %s", (_, curve) => {
    const fit = fitCubic(uneven(curve, 60))!;
    expect(fit[0]).toEqual(curve[0]);
    expect(fit[3]).toEqual(curve[3]);
    expect(worst(fit, samples(curve, 50), 2000)).toBeLessThan(0.01 * arcLength(curve));
  });

  it("recovers the handles of an arch themselves", () => {
    const fit = fitCubic(uneven(arch, 80))!;
    expect(distance(fit[1], arch[1])).toBeLessThan(0.05);
    expect(distance(fit[2], arch[2])).toBeLessThan(0.05);
  });

  it("stays within the noise of a hand", () => {
    let seed = 1;
    const noise = (): number => { seed = (seed * 16807) % 2147483647; return (seed / 2147483647 - 0.5) * 0.1; };
    const points = samples(arch, 150).map(([x, y, z]): Vec3 => [x + noise(), y + noise(), z]);
    const fit = fitCubic(points)!;
    expect(worst(fit, samples(arch, 50), 1000)).toBeLessThan(0.06);
  });

  it("does not throw the handles away for a scribble", () => {
    const scribble = Array.from({ length: 300 }, (_, i): Vec3 => [Math.sin(i / 5) + i / 900, Math.cos(i / 7), 0]);
    const length = scribble.slice(1).reduce((sum, p, i) => sum + distance(p, scribble[i]!), 0);
    const fit = fitCubic(scribble)!;
    for (const p of fit) expect(distance(p, fit[0])).toBeLessThan(3 * length);
  });

  it("makes a straight line of two points, and nothing of one", () => {
    expect(fitCubic([[0, 0, 0], [3, 0, 0]])).toEqual([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]);
    const back = fitCubic([[0, 0, 0], [3, 0, 0], [0, 0, 0]])!;
    expect(back.flat().every(Number.isFinite)).toBe(true);
    expect(fitCubic([[1, 1, 1], [1, 1, 1]])).toBeNull();
    expect(fitCubic([[NaN, 0, 0]])).toBeNull();
    expect(fitCubic([])).toBeNull();
  });

  it("leaves out points that are no numbers", () => {
    const fit = fitCubic([[0, 0, 0], [NaN, 1, 1], [1, 0, 0], [2, 0, 0], [3, 0, 0]])!;
    expect(worst(fit, [[1.5, 0, 0]])).toBeLessThan(1e-6);
  });
});

describe("resample", () => {
  it("puts points at even distances and keeps the ends", () => {
    const dense = Array.from({ length: 500 }, (_, i): Vec3 => [(i / 499) ** 2, 0, 0]);
    const even = resample(dense, 11);
    expect(even).toHaveLength(11);
    even.forEach((p, i) => expect(p[0]).toBeCloseTo(i / 10, 5));
  });
});
