import { describe, expect, it } from "vitest";
import type { Curve, Scene } from "../../src/api";
import { point } from "../../src/view/bezier";
import type { Drag } from "../../src/view/desk";
import { gizmoHandles } from "../../src/view/gizmo";
import { gnomonArms } from "../../src/view/gnomon";
import { Keys } from "../../src/view/keys";
import { project } from "../../src/view/orbit";
import { placingOf } from "../../src/view/placing";
import { curvesOf, meshesOf } from "../../src/view/scene_edits";
import { Tools } from "../../src/view/tools";
import { distance, type V } from "../../src/view/vec";
import { FakeDesk, pointer } from "./fake_desk";

const trunk: Curve = { points: [[0, 0, 0], [0, 0.7, 0], [0, 1.4, 0], [0, 2, 0]], alignment: 5 };
const bough: Curve = { points: [[2, 0, 0], [2, 0.7, 0], [2, 1.4, 0], [2, 2, 0.5]] };
const scene: Scene = {
  seed: 4, curves: { blend: true, curve: [trunk, bough] }, volume: { cells: 9,
  mesh: [{ file: "shapes/box.obj", position: [-2, 1, 0] }] },
};

function at(desk: FakeDesk, p: V): [number, number] {
  const s = project(desk.eye(), p);
  return [s.x, s.y];
}

function drag(what: Drag | null, path: readonly (readonly [number, number])[], more = {}): void {
  for (const [x, y] of path) what!.move(pointer(x, y, more));
  what!.end(pointer(...path[path.length - 1]! as [number, number], more), false);
}

describe("select", () => {
  it("takes a curve within 12 pixels, and drags its points once per frame under one gesture", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), [x, y] = at(desk, point(trunk.points, 0.4));
    tools.press(pointer(x + 11, y))!.end(pointer(x + 11, y), true);
    expect(desk.selection).toEqual({ kind: "curve", index: 0 });
    expect(desk.edits).toEqual([]);

    const [hx, hy] = at(desk, trunk.points[1]);
    const held = tools.press(pointer(hx + 3, hy))!;
    expect(desk.selection).toEqual({ kind: "curve", index: 0, point: 1 });
    for (let i = 1; i <= 5; ++i) held.move(pointer(hx + 3 + 10 * i, hy));
    expect(desk.edits).toHaveLength(0);
    desk.tick();
    for (let i = 6; i <= 9; ++i) held.move(pointer(hx + 3 + 10 * i, hy));
    held.end(pointer(hx + 93, hy), false);
    desk.tick();
    expect(desk.edits).toHaveLength(2);
    expect(new Set(desk.edits.map((e) => e.gesture)).size).toBe(1);
    expect(desk.edits.every((e) => e.search && e.label === "Move curve 1")).toBe(true);
    const moved = curvesOf(desk.edits[1]!.scene)[0]!;
    expect(at(desk, moved.points[1])[0]).toBeCloseTo(hx + 90, 1);
    expect(moved.points[0]).toEqual(trunk.points[0]);
    expect(moved.alignment).toBe(5);
    expect(desk.edits[1]!.scene.seed).toBe(4);
    expect(desk.edits[1]!.scene.curves!.blend).toBe(true);
  });

  it("leaves what is hidden alone: curves, points, handles and places to snap to", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), keys = new Keys(desk, () => 0);
    const on = at(desk, point(trunk.points, 0.4)), end = at(desk, trunk.points[3]), box: V = [-2, 1, 0];
    const handle = gizmoHandles(desk.eye(), placingOf(meshesOf(scene)[0]!)).find((h) => h.kind === "move")!;
    expect(tools.hoverAt(...on)).toEqual({ kind: "curve", index: 0 });
    desk.selection = { kind: "mesh", index: 0 };
    const grip = handle.path[handle.path.length - 1]!;
    expect(tools.hoverAt(grip[0], grip[1])).toMatchObject({ kind: "gizmo" });
    desk.hidden = { curves: [0], meshes: [0], silhouettes: [] };
    expect(tools.hoverAt(grip[0], grip[1])).toBeNull();
    expect(tools.hoverAt(...at(desk, box))).toBeNull();
    expect(tools.hoverAt(...on)).toBeNull();
    desk.selection = { kind: "curve", index: 0 };
    expect(tools.hoverAt(...end)).toBeNull();
    desk.selection = { kind: "curve", index: 1 };
    const held = tools.press(pointer(...at(desk, bough.points[0])))!, [x, y] = at(desk, trunk.points[0]);
    held.move(pointer(x + 5, y - 5));
    expect(desk.snapMark).toBeNull();
    held.end(pointer(x + 5, y - 5), false);
    expect(curvesOf(desk.draft.scene)[1]!.points[0]).not.toEqual(trunk.points[0]);
    desk.selection = null;
    expect(keys.press({ key: "Tab", shift: false, ctrl: false, alt: false })).toBe(true);
    expect(desk.selection).toEqual({ kind: "curve", index: 1 });
  });

  it("snaps an end to another curve's end, unless shift is held, and takes its handle along", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), goal = at(desk, bough.points[0]);
    desk.selection = { kind: "curve", index: 0 };
    drag(tools.press(pointer(...at(desk, trunk.points[3]))), [[goal[0] + 5, goal[1] - 5]]);
    const snapped = curvesOf(desk.draft.scene)[0]!.points;
    expect(snapped[3]).toEqual([2, 0, 0]);
    expect(distance(snapped[2], [2, -0.6, 0])).toBeLessThan(1e-5);
    drag(tools.press(pointer(...at(desk, [2, 0, 0]))), [[goal[0] + 6, goal[1] - 6]], { shift: true });
    expect(distance(curvesOf(desk.draft.scene)[0]!.points[3], [2, 0, 0])).toBeGreaterThan(0.01);
    expect(desk.snapMark).toBeNull();
  });

  it("gives back what was there when a drag is cancelled", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), [x, y] = at(desk, point(bough.points, 0.5));
    const held = tools.press(pointer(x, y))!;
    held.move(pointer(x + 50, y));
    desk.tick();
    held.cancel();
    expect(desk.draft.scene).toBe(scene);
    expect(desk.edits.map((e) => e.scene === scene)).toEqual([false, true]);
  });

  it("drags a whole curve with what is under the pointer", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), [x, y] = at(desk, point(bough.points, 0.5));
    drag(tools.press(pointer(x, y)), [[x - 40, y + 10]]);
    const [mx, my] = at(desk, point(curvesOf(desk.draft.scene)[1]!.points, 0.5));
    expect([mx - x + 40, my - y - 10].every((d) => Math.abs(d) < 1)).toBe(true);
  });

  it("picks genes and volumes by a click, and turns the camera by a drag", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.hit = { kind: "gene", gene: 12, point: [0, 0, 0] };
    tools.press(pointer(100, 100))!.end(pointer(101, 100), true);
    desk.hit = { kind: "mesh", index: 0, point: [0, 0, 0] };
    tools.press(pointer(100, 100))!.end(pointer(101, 100), true);
    desk.hit = null;
    tools.press(pointer(100, 100))!.end(pointer(101, 100), true);
    expect(desk.selections).toEqual([{ kind: "gene", gene: 12 }, { kind: "mesh", index: 0 }, null]);
    const before = desk.orbit;
    drag(tools.press(pointer(100, 100)), [[150, 120]]);
    expect(desk.orbit.azimuth).toBeCloseTo(before.azimuth - 0.5);
    drag(tools.press(pointer(100, 100, { shift: true })), [[150, 120]]);
    expect(desk.orbit.target).not.toEqual(before.target);
    drag(tools.press(pointer(100, 100, { button: 1, ctrl: true })), [[100, 200]]);
    expect(desk.orbit.distance).toBeGreaterThan(before.distance);
    expect(desk.edits).toEqual([]);
  });

  it("leaves targets alone that are not shown", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.targets = false;
    expect(tools.hoverAt(...at(desk, point(trunk.points, 0.4)))).toBeNull();
    desk.hit = { kind: "mesh", index: 0, point: [0, 0, 0] };
    tools.press(pointer(100, 100))!.end(pointer(100, 100), true);
    expect(desk.selections).toEqual([]);
  });

  it("moves a volume by its gizmo, and looks from a side by the gnomon", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.selection = { kind: "mesh", index: 0 };
    const [x, y] = gizmoHandles(desk.eye(), placingOf(meshesOf(scene)[0]!)).find((h) => h.kind === "move" &&
      h.axis === 1)!.path[1]!;
    drag(tools.press(pointer(x, y)), [[x, y - 60]]);
    const { position } = meshesOf(desk.draft.scene)[0]!;
    expect(position![1]).toBeGreaterThan(1.3);
    expect([position![0], position![2]]).toEqual([-2, 0]);
    const arm = gnomonArms(desk.eye()).find((a) => a.side === "+x")!;
    tools.press(pointer(arm.x, arm.y))!.end(pointer(arm.x, arm.y), true);
    expect(desk.sides).toEqual(["+x"]);
  });
});

describe("curve", () => {
  const arc = Array.from({ length: 40 }, (_, i): [number, number] =>
    [200 + 5 * i, 300 - 80 * Math.sin(i / 39 * Math.PI)]);

  it("draws on the plane through the target", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.tool = "curve";
    drag(tools.press(pointer(...arc[0]!)), arc);
    expect(desk.edits).toHaveLength(1);
    expect(desk.edits[0]).toMatchObject({ label: "Draw curve 3", search: true });
    const drawn = curvesOf(desk.draft.scene)[2]!;
    expect(drawn.offset).toBe(0.7);
    expect(drawn.thickness).toBeUndefined();
    for (const p of drawn.points) expect(project(desk.eye(), p).depth).toBeCloseTo(8, 4);
    const middle = project(desk.eye(), point(drawn.points, 0.5));
    expect(Math.hypot(middle.x - 297, middle.y - 220)).toBeLessThan(6);
    expect(desk.selection).toEqual({ kind: "curve", index: 2 });
    expect(desk.ink).toEqual([]);
  });

  it("begins on a curve that it starts at", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), start = at(desk, [0, 2, 0]);
    desk.tool = "curve";
    drag(tools.press(pointer(start[0] + 4, start[1])), arc.map(([x, y]) => [x + start[0] - 200, y + start[1] - 300]));
    expect(curvesOf(desk.draft.scene)[2]!.points[0]).toEqual([0, 2, 0]);
  });

  it("lies on the surface that it starts, ends and runs on", () => {
    const desk = new FakeDesk({}), tools = new Tools(desk);
    desk.tool = "curve";
    desk.hit = { kind: "gene", gene: 0, point: [0, 1, 3] };
    const before = desk.asked;
    drag(tools.press(pointer(...arc[0]!)), arc);
    expect(desk.asked).toBeGreaterThan(before + 10);
    expect(curvesOf(desk.draft.scene)[0]!.points[0]).toEqual([0, 1, 3]);
  });

  it("takes a pen's pressure as thickness", () => {
    const desk = new FakeDesk({}), tools = new Tools(desk);
    desk.tool = "curve";
    const held = tools.press(pointer(...arc[0]!, { pen: true, ink: [] }))!;
    arc.forEach(([x, y], i) => held.move(pointer(x, y, { pen: true, ink: [{ x, y, pressure: 0.9 - 0.7 * i / 39 }] })));
    held.end(pointer(...arc[39]!, { pen: true }), false);
    const [start, end] = curvesOf(desk.draft.scene)[0]!.thickness!;
    expect(start).toBeGreaterThan(2 * end);
    expect(end).toBeGreaterThan(0);
  });

  it("stops at 64 curves, and a click selects", () => {
    const desk = new FakeDesk({ curves: { curve: new Array<Curve>(64).fill(trunk) } }), tools = new Tools(desk);
    desk.tool = "curve";
    drag(tools.press(pointer(...arc[0]!)), arc);
    expect(desk.edits).toEqual([]);
    expect(desk.said.join()).toMatch(/64 curves/);
    const [x, y] = at(desk, point(trunk.points, 0.5));
    tools.press(pointer(x, y))!.end(pointer(x, y), true);
    expect(desk.selection).toEqual({ kind: "curve", index: 63 });
  });
});

describe("shapes", () => {
  it("makes a box: base, then height, as one edit", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), a = at(desk, [-1, 0, 1]), b = at(desk, [1, 0, 2]);
    desk.tool = "box";
    drag(tools.press(pointer(...a)), [b]);
    expect(desk.edits).toEqual([]);
    tools.hover(pointer(b[0], b[1] - 50));
    expect(tools.press(pointer(b[0], b[1] - 80))).toBeNull();
    desk.tick();
    expect(desk.edits).toHaveLength(1);
    expect(desk.edits[0]!.scene.volume!.cells).toBe(9);
    const box = meshesOf(desk.edits[0]!.scene)[1]!;
    expect(box).toMatchObject({ file: "shapes/box.obj", fill: 1 });
    expect([box.scale![0], box.scale![2]].map((s) => Math.round(1e4 * s) / 1e4)).toEqual([2, 1]);
    expect(box.scale![1]).toBeGreaterThan(0.5);
    expect(box.position![1]).toBeCloseTo(box.scale![1] / 2);
    expect(desk.toolsSet).toEqual(["select"]);
    expect(desk.selection).toEqual({ kind: "mesh", index: 1 });
  });

  it("keeps what a panel or undo changed while a box got its height", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.tool = "box";
    drag(tools.press(pointer(...at(desk, [-1, 0, 1]))), [at(desk, [1, 0, 2])]);
    const { volume: _, ...without } = scene;
    desk.draft.receive({ ...without, seed: 77 });
    expect(meshesOf(desk.draft.scene)).toHaveLength(1);
    tools.press(pointer(300, 200));
    expect(desk.edits).toHaveLength(1);
    expect(desk.edits[0]!.scene.seed).toBe(77);
    expect(meshesOf(desk.edits[0]!.scene)).toHaveLength(1);
    expect(desk.selection).toEqual({ kind: "mesh", index: 0 });
  });

  it("keeps a shape where another tool is chosen before its height is", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk);
    desk.tool = "box";
    drag(tools.press(pointer(...at(desk, [-1, 0, 1]))), [at(desk, [1, 0, 2])]);
    expect(tools.finish("curve")).toBe(true);
    expect(meshesOf(desk.edits[0]!.scene)).toHaveLength(2);
    expect(desk.toolsSet).toEqual([]);
    expect(desk.draft.busy).toBe(false);
  });

  it("makes a ball that stands on the ground, at once", () => {
    const desk = new FakeDesk({}), tools = new Tools(desk);
    desk.tool = "sphere";
    drag(tools.press(pointer(...at(desk, [0, 0, 0]))), [at(desk, [1, 0, 0])]);
    const ball = meshesOf(desk.draft.scene)[0]!;
    expect(ball.scale!.map((s) => Math.round(1e4 * s) / 1e4)).toEqual([2, 2, 2]);
    expect(ball.position![1]).toBeCloseTo(1);
  });

  it("draws the outline where the ground is seen from its edge", () => {
    const desk = new FakeDesk({}), tools = new Tools(desk);
    desk.orbit = { ...desk.orbit, elevation: 0 };
    desk.tool = "cylinder";
    drag(tools.press(pointer(...at(desk, [-1, 0.5, 0]))), [at(desk, [1, 2, 0])]);
    const { scale, position } = meshesOf(desk.draft.scene)[0]!;
    expect(scale!.map((s) => Math.round(1e4 * s) / 1e4)).toEqual([2, 1.5, 2]);
    expect(position!.map((s) => Math.round(1e4 * s) / 1e4)).toEqual([0, 1.25, 0]);
  });

  it("is not there after Escape, nor after a click", () => {
    const desk = new FakeDesk(scene), tools = new Tools(desk), a = at(desk, [-1, 0, 1]);
    desk.tool = "box";
    drag(tools.press(pointer(...a)), [at(desk, [1, 0, 2])]);
    expect(tools.cancel()).toBe(true);
    expect(desk.draft.scene).toBe(scene);
    expect(tools.cancel()).toBe(false);
    tools.press(pointer(...a))!.end(pointer(...a), true);
    desk.tick();
    expect(desk.edits).toEqual([]);
  });
});

describe("keys", () => {
  function keys(desk: FakeDesk): (key: string, more?: object) => boolean {
    let now = 0;
    const all = new Keys(desk, () => now += 100);
    return (key, more = {}) => all.press({ key, shift: false, ctrl: false, alt: false, ...more });
  }

  it("Tab goes through everything, and on to the page at the end", () => {
    const desk = new FakeDesk(scene), press = keys(desk);
    let stops = 0;
    while (press("Tab")) ++stops;
    expect(stops).toBe(2 * 5 + 1);
    expect(desk.selection).toEqual({ kind: "mesh", index: 0 });
    expect(press("Tab", { shift: true })).toBe(true);
    expect(desk.selection).toEqual({ kind: "curve", index: 1, point: 3 });
    expect(desk.said).toContain("Curve 1, first handle");
    const empty = new FakeDesk({});
    expect(keys(empty)("Tab")).toBe(false);
  });

  it("arrows nudge a point under one gesture, and turn the camera where nothing is selected", () => {
    const desk = new FakeDesk(scene), press = keys(desk), azimuth = desk.orbit.azimuth;
    press("ArrowLeft");
    expect(desk.orbit.azimuth).not.toBe(azimuth);
    desk.selection = { kind: "curve", index: 0, point: 3 };
    press("ArrowRight");
    press("ArrowRight", { shift: true });
    expect(desk.edits.map((e) => e.gesture)).toEqual([desk.edits[0]!.gesture, desk.edits[0]!.gesture]);
    const [first, second] = desk.edits.map((e) => project(desk.eye(), curvesOf(e.scene)[0]!.points[3]).x);
    expect(first! - project(desk.eye(), trunk.points[3]).x).toBeCloseTo(6, 1);
    expect(second! - first!).toBeCloseTo(60, 0);
    desk.selection = { kind: "mesh", index: 0 };
    press("PageUp");
    expect(meshesOf(desk.draft.scene)[0]!.position![2]).toBeLessThan(0);
    expect(desk.edits[2]!.gesture).not.toBe(desk.edits[0]!.gesture);
  });

  it("deletes, and takes curves away with the last of them", () => {
    const desk = new FakeDesk(scene), press = keys(desk);
    expect(press("Delete")).toBe(false);
    desk.selection = { kind: "curve", index: 0 };
    press("Delete");
    expect(curvesOf(desk.draft.scene)).toEqual([bough]);
    desk.selection = { kind: "curve", index: 0 };
    press("Backspace");
    expect("curves" in desk.draft.scene).toBe(false);
    desk.selection = { kind: "mesh", index: 0 };
    press("Delete");
    expect(desk.draft.scene).toEqual({ seed: 4 });
    desk.selection = { kind: "curve", index: 5 };
    expect(press("Delete")).toBe(false);
  });

  it("duplicates beside the original", () => {
    const desk = new FakeDesk(scene), press = keys(desk);
    desk.selection = { kind: "curve", index: 0, point: 2 };
    expect(press("d", { ctrl: true })).toBe(true);
    const copy = curvesOf(desk.draft.scene)[2]!;
    expect(copy.alignment).toBe(5);
    expect(copy.points[0][0]).toBeGreaterThan(0);
    expect(desk.selection).toEqual({ kind: "curve", index: 2 });
    desk.selection = { kind: "mesh", index: 0 };
    press("d", { ctrl: true });
    expect(desk.selection).toEqual({ kind: "mesh", index: 1 });
    expect(meshesOf(desk.draft.scene)).toHaveLength(2);
  });

  it("adds what the tool makes, and reshapes volumes", () => {
    const desk = new FakeDesk({}), press = keys(desk);
    expect(press("n")).toBe(false);
    desk.tool = "curve";
    press("Insert");
    expect(curvesOf(desk.draft.scene)[0]).toMatchObject({ offset: 0.7 });
    desk.tool = "cylinder";
    press("n");
    expect(meshesOf(desk.draft.scene)[0]).toMatchObject({ file: "shapes/cylinder.obj", fill: 1, scale: [2, 2, 2],
      position: [0, 1, 0] });
    press("y");
    expect(meshesOf(desk.draft.scene)[0]!.scale).toEqual([2, 2.2, 2]);
    press("r");
    expect(meshesOf(desk.draft.scene)[0]!.rotation_deg).toEqual([0, 15, 0]);
    press(".");
    expect(meshesOf(desk.draft.scene)[0]!.scale).toEqual([2.2, 2.42, 2.2]);
  });

  it("looks from sides, at all, and nearer; other keys are the page's", () => {
    const desk = new FakeDesk(scene), press = keys(desk), { distance: far } = desk.orbit;
    press("3");
    press("3", { shift: true });
    press("Home");
    press("+");
    expect(desk.sides).toEqual(["+x", "-x"]);
    expect(desk.frames).toBe(1);
    expect(desk.orbit.distance).toBeLessThan(far);
    expect([press("s", { ctrl: true }), press("q"), press("z", { ctrl: true }),
      press("ArrowLeft", { alt: true })]).toEqual([false, false, false, false]);
  });

  it("go through the parts of the model with comma and full stop, round and round", () => {
    const desk = new FakeDesk(), keys = new Keys(desk, () => 0);
    const press = (key: string) => keys.press({ key, shift: false, ctrl: false, alt: false });
    expect(press(".")).toBe(false);
    desk.shownGenes = [0, 3, 7];
    const chosen = [".", ".", ".", ".", ",", ","].map((key) => (press(key), desk.selection));
    expect(chosen.map((one) => (one?.kind === "gene" ? one.gene : null))).toEqual([0, 3, 7, 0, 7, 3]);
    expect(desk.said.at(-1)).toBe("Part 2 of 3");
  });

  it("turn the camera with arrows, and move it sideways with Shift", () => {
    const desk = new FakeDesk(), keys = new Keys(desk, () => 0), { orbit } = desk;
    const press = (key: string, shift: boolean) => keys.press({ key, shift, ctrl: false, alt: false });
    press("ArrowRight", false);
    expect(desk.orbit.target).toEqual(orbit.target);
    expect(desk.orbit.azimuth).not.toBe(orbit.azimuth);
    desk.orbit = orbit;
    press("ArrowRight", true);
    press("ArrowUp", true);
    expect(desk.orbit.azimuth).toBe(orbit.azimuth);
    expect(desk.orbit.target[0]).toBeGreaterThan(orbit.target[0]);
    expect(desk.orbit.target[1]).toBeGreaterThan(orbit.target[1]);
  });
});
