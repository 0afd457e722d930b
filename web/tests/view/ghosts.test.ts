import { afterEach, describe, expect, it, vi } from "vitest";
import type { Scene } from "../../src/api";
import { Ghosts } from "../../src/view/ghosts";
import { emptyBox } from "../../src/view/vec";

const scene = (...files: string[]): Scene => ({ volume: { mesh: files.map((file) =>
  ({ file, position: [1, 0, 0], scale: [2, 2, 2] })) } });
const url = (path: string): string => `/files/${path}?v=1`;

async function settled(): Promise<void> {
  for (let i = 0; i < 20; ++i) await new Promise((done) => setTimeout(done));
}

afterEach(() => { vi.unstubAllGlobals(); });

function answers(texts: Record<string, string>): string[] {
  const asked: string[] = [];
  vi.stubGlobal("fetch", (address: string) => {
    asked.push(address);
    const text = texts[address];
    return Promise.resolve({ ok: text !== undefined, status: text === undefined ? 404 : 200,
      text: () => Promise.resolve(text) });
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

  it("fetches a file once, and shows it when it is there", async () => {
    const asked = answers({ "/files/a.obj?v=1": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" });
    let changed = 0;
    const ghosts = new Ghosts(() => ++changed, () => {});
    ghosts.setScene(scene("a.obj", "a.obj"), url);
    ghosts.setScene(scene("a.obj", "a.obj"), url);
    expect(ghosts.pick([1.2, 0.2, 5], [0, 0, -1])).toBeNull();
    await settled();
    expect(changed).toBe(1);
    ghosts.setScene(scene("a.obj", "a.obj"), url);
    expect(asked).toEqual(["/files/a.obj?v=1"]);
    expect(ghosts.pick([1.2, 0.2, 5], [0, 0, -1])).toMatchObject({ index: 0, t: 5 });
  });

  it("says what cannot be shown, and asks again when it is named again", async () => {
    const asked = answers({ "/files/bad.obj?v=1": "v 0 0\n" }), said: string[] = [];
    const ghosts = new Ghosts(() => {}, (message) => said.push(message));
    ghosts.setScene(scene("gone.obj", "bad.obj"), url);
    await settled();
    expect(said.sort()).toEqual(["bad.obj cannot be shown: line 1: not three numbers",
      "gone.obj cannot be shown: the server answers 404"]);
    ghosts.setScene(scene("gone.obj"), url);
    expect(asked).toHaveLength(2);
    ghosts.setScene({}, url);
    ghosts.setScene(scene("gone.obj"), url);
    expect(asked).toHaveLength(3);
  });
});
