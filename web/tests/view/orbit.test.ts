import { describe, expect, it } from "vitest";
import {
  atDepth, between, cameraOf, eyeOf, framed, kFovDeg, kHalfTan, kStart, orbitOf, panned, project, rayThrough, snapped, turned,
  wheelFactor, zoomed,
  type Orbit,
} from "../../src/view/orbit";
import { Motion } from "../../src/view/motion";
import { cross, distance, dot, emptyBox, grow, length, subtract, type Box } from "../../src/view/vec";

const orbit: Orbit = { target: [1, 2, 3], distance: 5, azimuth: 0.7, elevation: 0.4 };
const eye = eyeOf(orbit, 800, 600);

describe("a camera", () => {
  it("is found again from what it looks like, from the poles too", () => {
    for (const elevation of [0.4, -1.2, 0, Math.PI / 2, -Math.PI / 2]) {
      for (const azimuth of [0.7, -2, 0]) {
        const found = orbitOf(cameraOf(eyeOf({ ...orbit, azimuth, elevation }, 800, 600)))!;
        expect(found.distance).toBeCloseTo(5, 3);
        expect(found.elevation).toBeCloseTo(elevation, 2);
        expect(Math.cos(found.azimuth - azimuth)).toBeCloseTo(1, 4);
      }
    }
  });

  it("of another lens, or around the model, is none of the view's", () => {
    expect(orbitOf({ fit: true, azimuth_deg: 20 })).toBeNull();
    expect(orbitOf({ ...cameraOf(eye), fov_deg: 20 })).toBeNull();
    expect(orbitOf({ eye: [0, 1, 5], at: [0, 1, 0], tall: 3 })).toBeNull();
  });
});

describe("orbit", () => {
  it("looks at its target from the documented sides", () => {
    const middle = project(eye, orbit.target);
    expect(middle.x).toBeCloseTo(400);
    expect(middle.y).toBeCloseTo(300);
    expect(middle.depth).toBeCloseTo(5);
    const front = eyeOf({ target: [0, 0, 0], distance: 2, azimuth: 0, elevation: 0 }, 1, 1);
    expect(front.position).toEqual([0, 0, 2]);
    expect(eyeOf({ target: [0, 0, 0], distance: 2, azimuth: Math.PI / 2, elevation: 0 }, 1,
      1).position[0]).toBeCloseTo(2);
  });

  it.each([-Math.PI / 2, -1, 0, 1, Math.PI / 2])("has a right-handed basis at elevation %f", (elevation) => {
    const { right, up, back } = eyeOf({ ...orbit, elevation }, 2, 1);
    for (const v of [right, up, back]) expect(length(v)).toBeCloseTo(1);
    expect(dot(right, up)).toBeCloseTo(0);
    expect(distance(cross(right, up), back)).toBeCloseTo(0);
  });

  it("stops at the poles and does not flip", () => {
    const above = turned(orbit, 0, 1e6);
    expect(above.elevation).toBeCloseTo(Math.PI / 2);
    expect(eyeOf(above, 1, 1).back[1]).toBeCloseTo(1);
    expect(dot(eyeOf(turned(orbit, 0, 1e6), 1, 1).right, eye.right)).toBeCloseTo(1);
    expect(turned(orbit, 0, -1e6).elevation).toBeCloseTo(-Math.PI / 2);
  });

  it("takes pixels to space and back", () => {
    const p = atDepth(eye, 123, 456, 7);
    const s = project(eye, p);
    expect([s.x, s.y, s.depth].map((v) => Math.round(v * 1e6) / 1e6)).toEqual([123, 456, 7]);
    const { origin, direction } = rayThrough(eye, 123, 456);
    expect(length(direction)).toBeCloseTo(1);
    expect(length(cross(subtract(p, origin), direction))).toBeCloseTo(0);
  });

  it("gives the camera that the scorer would use", () => {
    const camera = cameraOf(eye);
    expect(camera.fov_deg).toBe(kFovDeg);
    expect(distance(camera.eye!, eye.position)).toBeLessThan(1e-5);
    expect(camera.at).toEqual([1, 2, 3]);
    expect(dot(camera.up!, eye.up)).toBeCloseTo(1);
  });

  it("pans with what is under the pointer", () => {
    const under = atDepth(eye, 200, 200, 5), moved = eyeOf(panned(orbit, eye, 30, -20), 800, 600);
    const s = project(moved, under);
    expect(s.x).toBeCloseTo(230);
    expect(s.y).toBeCloseTo(180);
  });

  it("zooms to the pointer", () => {
    const under = atDepth(eye, 650, 100, 5), near = zoomed(orbit, eye, 0.5, 650, 100);
    expect(near.distance).toBeCloseTo(2.5);
    const s = project(eyeOf(near, 800, 600), under);
    expect(s.x).toBeCloseTo(650);
    expect(s.y).toBeCloseTo(100);
    expect(zoomed(orbit, eye, 0, 0, 0).distance).toBeGreaterThan(0);
    expect(zoomed(orbit, eye, 1e30, 0, 0).distance).toBeLessThan(1e7);
  });

  it("reads wheels of all units, and bounds them", () => {
    expect(wheelFactor(100, 0, false)).toBeCloseTo(Math.exp(0.12));
    expect(wheelFactor(3, 1, false)).toBeCloseTo(Math.exp(48 * 0.0012));
    expect(wheelFactor(-1e9, 2, false)).toBeGreaterThan(0.5);
    expect(wheelFactor(-10, 0, true)).toBeLessThan(wheelFactor(-10, 0, false));
  });

  it("snaps to a side the shorter way round", () => {
    const away: Orbit = { ...orbit, azimuth: 3 * Math.PI - 0.1 };
    const back = snapped(away, "-z");
    expect(Math.abs(back.azimuth - away.azimuth)).toBeLessThan(0.2);
    for (const [side, axis, sign] of [["+x", 0, 1], ["-x", 0, -1], ["+y", 1, 1], ["-y", 1, -1], ["+z", 2, 1],
      ["-z", 2, -1]] as const) {
      expect(eyeOf(snapped(orbit, side), 1, 1).back[axis]).toBeCloseTo(sign);
      expect(snapped(orbit, side).target).toEqual(orbit.target);
    }
  });

  it.each([0.4, 1, 2.5])("frames all corners at aspect %f, and not from afar", (aspect) => {
    const box: Box = { min: [-1, 0, -4], max: [3, 6, 2] };
    const view = eyeOf(framed(orbit, box, aspect), 600 * aspect, 600);
    let widest = 0;
    for (let i = 0; i < 8; ++i) {
      const s = project(view, [i & 1 ? 3 : -1, i & 2 ? 6 : 0, i & 4 ? 2 : -4]);
      expect(s.x).toBeGreaterThanOrEqual(0);
      expect(s.x).toBeLessThanOrEqual(view.width);
      expect(s.y).toBeGreaterThanOrEqual(0);
      expect(s.y).toBeLessThanOrEqual(600);
      widest = Math.max(widest, Math.abs(s.x / view.width - 0.5), Math.abs(s.y / 600 - 0.5));
    }
    expect(widest).toBeGreaterThan(0.4);
  });

  it("frames nothing and a point", () => {
    expect(framed(orbit, emptyBox(), 1)).toEqual(kStart);
    const point = emptyBox();
    grow(point, [1, 1, 1]);
    expect(framed(orbit, point, 1).distance).toBeGreaterThan(0);
  });

  it("eases between two places", () => {
    const b = { ...orbit, distance: 20, azimuth: 2 };
    expect(between(orbit, b, 0)).toEqual(orbit);
    expect(between(orbit, b, 2).distance).toBeCloseTo(20);
    expect(between(orbit, b, 0.5).distance).toBeCloseTo(10);
    expect(kHalfTan).toBeCloseTo(Math.tan(Math.PI / 8));
  });
});

describe("motion", () => {
  it("arrives, and knows its goal on the way", () => {
    const motion = new Motion(), goal = snapped(motion.orbit, "+x");
    motion.go(goal, false);
    motion.step(1000);
    expect(motion.moving).toBe(true);
    expect(motion.goal).toBe(goal);
    motion.step(1120);
    expect(motion.orbit.azimuth).not.toBeCloseTo(goal.azimuth);
    motion.step(1300);
    expect(motion.orbit).toBe(goal);
    expect(motion.moving).toBe(false);
  });

  it("is there at once for those who want no movement", () => {
    const motion = new Motion(), goal = snapped(motion.orbit, "-z");
    motion.go(goal, true);
    expect(motion.orbit).toBe(goal);
  });
});
