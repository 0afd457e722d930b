import { describe, expect, it } from "vitest";
import { dragGizmo, gizmoHandles, hitGizmo, pathDistance, turnAngle } from "../../src/view/gizmo";
import { eyeOf, project, type Orbit } from "../../src/view/orbit";
import { anglesOf, axesOf, place, placingOf, rayInto, rotated, type Placing } from "../../src/view/placing";
import { distance, turn, type V } from "../../src/view/vec";

const close = (a: V, b: V, digits = 6): void => a.forEach((x, i) => expect(x).toBeCloseTo(b[i]!, digits));
const start: Placing = { position: [1, 2, 3], scale: [1, 2, 0.5], rotation_deg: [0, 0, 0] };

describe("placing", () => {
  it("turns about x, then y, then z", () => {
    const p = placingOf({ file: "a.obj", rotation_deg: [90, 90, 0], scale: [2, 1, 1], position: [0, 0, 5] });
    // x stays at the first turn, and goes to -z at the second; y goes to z, then to x.
    close(place(p, [1, 0, 0]), [0, 0, 3]);
    close(place(p, [0, 1, 0]), [1, 0, 5]);
    expect(placingOf({ file: "b.obj" })).toEqual({ position: [0, 0, 0], scale: [1, 1, 1], rotation_deg: [0, 0, 0] });
  });

  it.each([[0, 0, 0], [30, -40, 50], [170, 80, -20], [10, 90, 0], [-35, -90, 0], [0, 0, 180], [-120, 10, 75]] as const)(
    "finds angles of the same axes: %f %f %f", (x, y, z) => {
      const axes = axesOf([x, y, z]), again = axesOf(anglesOf(axes));
      axes.forEach((axis, i) => close(again[i]!, axis));
    });

  it("turns in place about any direction", () => {
    const p = rotated({ ...start, rotation_deg: [20, 30, 40] }, [0, 1, 0], 0.7);
    axesOf([20, 30, 40]).forEach((axis, i) => close(axesOf(p.rotation_deg)[i]!, turn(axis, [0, 1, 0], 0.7)));
    expect(p.position).toBe(start.position);
  });

  it("takes rays into the mesh's space and keeps t", () => {
    const p: Placing = { position: [1, 2, 3], scale: [2, 0.5, 3], rotation_deg: [20, -70, 110] };
    const ray = rayInto(p, place(p, [0, 0, 5]), [0.1, 0.2, 0.3])!;
    close(ray.origin, [0, 0, 5]);
    close(place(p, [0, 1, 2].map((i) => ray.origin[i]! + 2 * ray.direction[i]!) as unknown as V),
      [0, 1, 2].map((i) => place(p, [0, 0, 5])[i]! + 2 * [0.1, 0.2, 0.3][i]!) as unknown as V);
    expect(rayInto({ ...p, scale: [0, 1, 1] }, [0, 0, 0], [0, 0, 1])).toBeNull();
  });
});

describe("gizmo", () => {
  const orbit: Orbit = { target: [1, 2, 3], distance: 10, azimuth: 0.6, elevation: 0.5 };
  const eye = eyeOf(orbit, 800, 600);

  it("has a handle under each of its drawn points", () => {
    const handles = gizmoHandles(eye, start);
    expect(handles.filter((h) => h.kind === "move")).toHaveLength(3);
    for (const h of handles.filter((h) => !h.faint)) {
      const [x, y] = h.path[Math.floor(h.path.length / 2)]!;
      expect(hitGizmo(handles, x, y)).toMatchObject({ kind: h.kind, axis: h.axis });
    }
    expect(hitGizmo(handles, 5, 5)).toBeNull();
    expect(gizmoHandles(eye, { ...start, position: [1 + 30 * eye.back[0], 30, 3 + 30 * eye.back[2]] })).toEqual([]);
  });

  it("does not offer what points at the viewer", () => {
    const front = eyeOf({ ...orbit, azimuth: 0, elevation: 0 }, 800, 600);
    const faint = gizmoHandles(front, start).filter((h) => h.faint).map((h) => `${h.kind}${h.axis}`);
    expect(faint).toEqual(expect.arrayContaining(["move2", "scale2", "turn0", "turn1", "plane0", "plane1"]));
    expect(faint).not.toContain("turn2");
  });

  it("moves along its axis with the pointer", () => {
    const goal = project(eye, [1.5, 2, 3]), from = project(eye, start.position);
    const moved = dragGizmo(eye, start, { kind: "move", axis: 0 }, [from.x, from.y], [goal.x, goal.y], false);
    expect(moved.position[0]).toBeCloseTo(1.5, 1);
    expect(moved.position.slice(1)).toEqual([2, 3]);
    expect(moved.scale).toBe(start.scale);
  });

  it("moves in a plane and in that of the screen to where the pointer is", () => {
    const from = project(eye, start.position), goal = project(eye, [1.4, 2, 2.2]);
    close(dragGizmo(eye, start, { kind: "plane", axis: 1 }, [from.x, from.y], [goal.x, goal.y], false).position,
      [1.4, 2, 2.2]);
    const free = dragGizmo(eye, start, { kind: "free", axis: 0 }, [from.x, from.y], [from.x + 50, from.y - 20], false);
    const s = project(eye, free.position);
    expect([s.x - from.x, s.y - from.y].map(Math.round)).toEqual([50, -20]);
    expect(s.depth).toBeCloseTo(from.depth);
  });

  it("scales one axis, or with snap all, never to nothing", () => {
    const handle = gizmoHandles(eye, start).find((h) => h.kind === "scale" && h.axis === 1)!;
    const from = handle.path[0]!, centre = project(eye, start.position);
    const twice = [2 * from[0] - centre.x, 2 * from[1] - centre.y] as const;
    const scaled = dragGizmo(eye, start, handle, from, twice, false);
    expect(scaled.scale[1]).toBeGreaterThan(3.3);
    expect([scaled.scale[0], scaled.scale[2]]).toEqual([1, 0.5]);
    const all = dragGizmo(eye, start, handle, from, twice, true);
    expect(all.scale[0] / start.scale[0]).toBeCloseTo(all.scale[1] / start.scale[1]);
    const back = dragGizmo(eye, start, handle, from, [centre.x - 500 * (from[0] - centre.x),
      centre.y - 500 * (from[1] - centre.y)], false);
    expect(back.scale[1]).toBeGreaterThan(0);
  });

  it("turns as far as the pointer goes round, in steps with snap", () => {
    const at = (angle: number): readonly [number, number] => {
      const s = project(eye, [1 + Math.sin(angle), 2, 3 + Math.cos(angle)]);
      return [s.x, s.y];
    };
    expect(turnAngle(eye, start.position, [0, 1, 0], at(0), at(0.8))).toBeCloseTo(0.8);
    expect(dragGizmo(eye, start, { kind: "turn", axis: 1 }, at(0), at(0.8),
      false).rotation_deg[1]).toBeCloseTo(0.8 * 180 / Math.PI);
    expect(dragGizmo(eye, start, { kind: "turn", axis: 1 }, at(0), at(0.8), true).rotation_deg[1]).toBeCloseTo(45);
    const edge = eyeOf({ ...orbit, elevation: 0 }, 800, 600);
    expect(Math.abs(turnAngle(edge, start.position, [0, 1, 0], [400, 300], [460, 300]))).toBeCloseTo(1);
  });

  it("measures distances from paths", () => {
    expect(pathDistance([[0, 0], [10, 0]], 5, 3)).toBe(3);
    expect(pathDistance([[0, 0], [10, 0]], 13, 4)).toBe(5);
    expect(pathDistance([[1, 1]], 4, 5)).toBe(5);
    expect(distance([0, 0, 0], [0, 3, 4])).toBe(5);
  });
});
