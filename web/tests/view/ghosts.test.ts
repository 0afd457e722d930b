import { afterEach, describe, expect, it, vi } from "vitest";
import type { Scene } from "../../src/api";
import { Ghosts } from "../../src/view/ghosts";
import { shapeTriangles } from "../../src/view/shapes";
import { emptyBox } from "../../src/view/vec";
import { meshMessage } from "./synthetic";

const scene = (...files: string[]): Scene => ({ volume: { mesh: files.map((file) =>
  ({ file, position: [1, 0, 0], scale: [2, 2, 2] })) } });
const url = (path: string): string => `/meshes/${path}?v=1`;
const triangle = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), indices: new Uint32Array([0, 1, 2]) };

async function settled(): Promise<void> {
  for (let i = 0; i < 20; ++i) await new Promise((done) => setTimeout(done));
}

afterEach(() => { vi.unstubAllGlobals(); });

/** A server that has these; of a text it says that it is wrong. */
function answers(things: Record<string, ArrayBuffer | string>): string[] {
  const asked: string[] = [];
  vi.stubGlobal("fetch", (address: string) => {
    asked.push(address);
    const thing = things[address];
    if (thing === undefined) return Promise.resolve(new Response("", { status: 404 }));
    return Promise.resolve(new Response(thing, { status: typeof thing === "string" ? 400 : 200 }));
  });
  return asked;
}

describe("Ghosts", () => {
  it("shows built-in shapes at once, where they are placed", () => {
    const asked = answers({}), ghosts = new Ghosts(() => {}, () => {});
    ghosts.setScene(scene("shapes/box.obj"), url);
    expect(asked).toEqual([]);
    expect(ghosts.pick([1, 0, 10], [0, 0, -1])).toMatchObject({ index: 0, t: 9 });
    expect(ghosts.pick([2.5, 0, 10], [0, 0, -1])).toBeNull();
    const box = emptyBox();
    ghosts.addTo(box);
    expect(box).toEqual({ min: [0, -1, -1], max: [2, 1, 1] });
  });

  it("neither draws nor picks what is hidden, until it is shown again", () => {
    answers({});
    const ghosts = new Ghosts(() => {}, () => {}), two = scene("shapes/box.obj", "shapes/sphere.obj");
    const drawn = (): number => ghosts.group.children.filter((child) => child.visible).length;
    ghosts.setScene(two, url, [0]);
    expect(drawn()).toBe(2); // a surface and its edges
    expect(ghosts.pick([1, 0, 10], [0, 0, -1])).toMatchObject({ index: 1 });
    ghosts.setScene(two, url, [0, 1]);
    expect(drawn()).toBe(0);
    expect(ghosts.pick([1, 0, 10], [0, 0, -1])).toBeNull();
    const box = emptyBox();
    ghosts.addTo(box);
    expect(box).toEqual(emptyBox());
    ghosts.setScene(two, url);
    expect(drawn()).toBe(4);
    expect(ghosts.pick([1.9, 0.9, 10], [0, 0, -1])).toMatchObject({ index: 0 });
  });

  it.each(["a.obj", "a.glb", "a.PLY", "a.stl"])("fetches %s once, and shows it when it is there", async (file) => {
    const asked = answers({ [url(file)]: meshMessage(1, [triangle]) }), said: string[] = [];
    let changed = 0;
    const ghosts = new Ghosts(() => ++changed, (message) => said.push(message));
    ghosts.setScene(scene(file, file), url);
    ghosts.setScene(scene(file, file), url);
    expect(ghosts.pick([1.2, 0.2, 5], [0, 0, -1])).toBeNull();
    await settled();
    expect(changed).toBe(1);
    ghosts.setScene(scene(file, file), url);
    expect(asked).toEqual([url(file)]);
    expect(ghosts.pick([1.2, 0.2, 5], [0, 0, -1])).toMatchObject({ index: 0, t: 5 });
    expect(said).toEqual([]);
  });

  it("says so where a box stands for a mesh", async () => {
    answers({ [url("huge.glb")]: meshMessage(300_001, [shapeTriangles("box")]) });
    const said: string[] = [], ghosts = new Ghosts(() => {}, (message) => said.push(message));
    ghosts.setScene(scene("huge.glb"), url);
    await settled();
    expect(said).toEqual(["huge.glb has 300001 triangles: the box around it is shown"]);
    ghosts.setScene(scene("huge.glb"), url);
    expect(ghosts.pick([1, 0, 10], [0, 0, -1])).toMatchObject({ index: 0, t: 9 });
  });

  it("says what cannot be shown, and asks again when it is named again", async () => {
    const bad = { [url("bad.obj")]: "bad.obj: line 1", [url("odd.glb")]: new ArrayBuffer(16), [url("none.ply")]: meshMessage(0, []) };
    const asked = answers(bad), said: string[] = [], ghosts = new Ghosts(() => {}, (message) => said.push(message));
    ghosts.setScene(scene("gone.obj", "bad.obj", "odd.glb", "none.ply"), url);
    await settled();
    expect(said.sort()).toEqual([
      "bad.obj cannot be shown: bad.obj: line 1", "gone.obj cannot be shown: the server answers 404",
      "none.ply cannot be shown: it has no triangles",
      'odd.glb cannot be shown: message begins with "\\u0000\\u0000\\u0000\\u0000", not ESPG',
    ]);
    ghosts.setScene(scene("gone.obj"), url);
    expect(asked).toHaveLength(4);
    ghosts.setScene({}, url);
    ghosts.setScene(scene("gone.obj"), url);
    expect(asked).toHaveLength(5);
  });
});
