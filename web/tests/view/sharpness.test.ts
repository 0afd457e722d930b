import { beforeEach, describe, expect, test } from "vitest";
import { Sharpness } from "../../src/view/sharpness";
import { FakeClock } from "../fakes";

let clock: FakeClock;
let rested: number;
let sharpness: Sharpness;
beforeEach(() => {
  clock = new FakeClock();
  rested = 0;
  sharpness = new Sharpness(clock, () => ++rested);
});
function frames(count: number, apart: number): number[] {
  return Array.from({ length: count }, () => {
    clock.advance(apart);
    return sharpness.next();
  });
}

describe("sharpness", () => {
  test("is whole where frames are quick, however many", () => {
    sharpness.took(20);
    expect(new Set(frames(20, 16))).toEqual(new Set([1]));
    clock.advance(1000);
    expect(rested).toBe(0);
  });

  test("is whole where frames are slow but rare", () => {
    sharpness.took(100);
    expect(frames(5, 300)).toEqual([1, 1, 1, 1, 1]);
  });

  test("gives way to movement where frames are slow, and comes back at rest", () => {
    sharpness.took(100);
    expect(frames(4, 40)).toEqual([1, 0.625, 0.625, 0.625]);
    expect(rested).toBe(0);
    clock.advance(200);
    expect(rested).toBe(1);
    expect(sharpness.next()).toBe(1);
    clock.advance(1000);
    expect(rested).toBe(1);
  });

  test("is never less than half, and learns from the newest frames", () => {
    sharpness.took(5000);
    expect(frames(2, 40)[1]).toBe(0.5);
    for (let i = 0; i < 12; ++i) sharpness.took(10);
    expect(frames(2, 40)[1]).toBe(1);
  });

  test("that is disposed of asks for no frame", () => {
    sharpness.took(100);
    frames(3, 40);
    sharpness.dispose();
    clock.advance(1000);
    expect(rested).toBe(0);
  });
});
