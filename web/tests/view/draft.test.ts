import { describe, expect, it } from "vitest";
import type { Scene } from "../../src/api";
import { Draft, same } from "../../src/view/draft";
import type { Edit } from "./fake_desk";

function setup(): { draft: Draft; edits: Edit[]; frame(): void; wait(): void } {
  const edits: Edit[] = [];
  let frames: (() => void)[] = [], later: (() => void) | null = null;
  const draft = new Draft({ edit: (e) => (edits.push(e), e.scene) }, {
    frame: (call) => { frames.push(call); },
    later: (call) => { later = call; return () => { later = null; }; },
  }, () => {});
  return {
    draft, edits, frame: () => { const calls = frames; frames = []; calls.forEach((call) => call()); },
    wait: () => { const call = later; later = null; call?.(); },
  };
}

const seed = (n: number): Scene => ({ seed: n });

describe("Draft", () => {
  it("shows what the document has", () => {
    const { draft, edits } = setup();
    draft.receive(seed(1));
    expect(draft.scene).toEqual(seed(1));
    expect(edits).toEqual([]);
  });

  it("sends the newest once per frame, and the rest at the end", () => {
    const { draft, edits, frame } = setup();
    draft.receive(seed(0));
    draft.begin("Move");
    for (const n of [1, 2, 3]) draft.change(seed(n));
    frame();
    draft.change(seed(4));
    draft.end();
    frame();
    expect(edits.map((e) => e.scene.seed)).toEqual([3, 4]);
    expect(edits[0]!.gesture).toBe(edits[1]!.gesture);
  });

  it("is not moved by its own echoes during a drag, nor by late ones after it", () => {
    const { draft, frame, wait } = setup();
    draft.receive(seed(0));
    draft.begin("Move");
    draft.change(seed(1));
    frame();
    draft.change(seed(2));
    draft.receive(seed(1));
    expect(draft.scene).toEqual(seed(2));
    draft.end();
    draft.receive(seed(1));
    expect(draft.scene).toEqual(seed(2));
    draft.receive(seed(2));
    expect(draft.scene).toEqual(seed(2));
    draft.receive(seed(9));
    expect(draft.scene).toEqual(seed(9));
    wait();
    expect(draft.scene).toEqual(seed(9));
  });

  it("knows its own answer whatever the order of its keys", () => {
    const { draft } = setup();
    draft.once("Add", { seed: 1, curves: { weight: 2, curve: [] } });
    draft.receive({ curves: { curve: [], weight: 2 }, seed: 1 });
    draft.receive(seed(3));
    expect(draft.scene).toEqual(seed(3));
    expect([same([1, { a: 2 }], [1, { a: 2 }]), same([1], { 0: 1 }), same({ a: undefined }, { b: 1 }),
      same(null, {})]).toEqual([true, false, false, false]);
  });

  it("takes the document's word when its own does not come back", () => {
    const { draft, wait } = setup();
    draft.receive(seed(0));
    draft.once("Add", seed(5));
    draft.receive(seed(7));
    expect(draft.scene).toEqual(seed(5));
    wait();
    expect(draft.scene).toEqual(seed(7));
  });

  it("cancels to what was before, and says so if something went out", () => {
    const { draft, edits, frame } = setup();
    draft.receive(seed(0));
    draft.begin("Move");
    draft.change(seed(1));
    draft.cancel();
    frame();
    expect([draft.scene.seed, edits.length]).toEqual([0, 0]);
    draft.begin("Move");
    draft.change(seed(1));
    frame();
    draft.cancel();
    expect(edits.map((e) => e.scene.seed)).toEqual([1, 0]);
    expect(edits[0]!.gesture).toBe(edits[1]!.gesture);
  });

  it("previews without sending, and has a gesture of its own for each drag", () => {
    const { draft, edits, frame } = setup();
    draft.begin("A");
    draft.preview(() => seed(3));
    frame();
    expect([draft.scene.seed, edits.length, draft.busy]).toEqual([3, 0, true]);
    draft.change(draft.scene);
    draft.begin("B");
    draft.change(seed(4));
    draft.end();
    expect(edits.map((e) => e.label)).toEqual(["A", "B"]);
    expect(edits[0]!.gesture).not.toBe(edits[1]!.gesture);
    draft.change(seed(5));
    expect(draft.scene.seed).toBe(4);
  });

  it("keeps what the page adds to an edit through the edits that follow at once", () => {
    const scenes: Scene[] = [];
    let draft: Draft | null = null;
    const edit = ({ scene }: Edit): Scene => {
      const taken = scenes.length === 0 ? { ...scene, search: { engine: "guided" } } : scene;
      scenes.push(taken);
      draft!.receive(structuredClone(taken)); // the page shows an edit before the call returns
      return taken;
    };
    draft = new Draft({ edit }, { frame: (call) => call(), later: () => () => {} }, () => {});
    draft.once("Draw curve 1", seed(1));
    expect(draft.scene.search).toEqual({ engine: "guided" });
    draft.once("Move curve 1", { ...draft.scene, seed: 2 });
    expect(scenes[1]).toEqual({ seed: 2, search: { engine: "guided" } });
    draft.receive(seed(9));
    expect(draft.scene).toEqual(seed(9));
  });

  it("lays a preview over what others edit meanwhile, and sends it with theirs", () => {
    const { draft, edits } = setup();
    draft.receive(seed(0));
    draft.begin("Add");
    draft.preview((scene) => ({ ...scene, budget: { seconds: 1 } }));
    draft.receive(seed(5));
    expect(draft.scene).toEqual({ seed: 5, budget: { seconds: 1 } });
    draft.change(draft.scene);
    draft.end();
    expect(edits.map((e) => e.scene)).toEqual([{ seed: 5, budget: { seconds: 1 } }]);

    draft.receive(edits[0]!.scene);
    draft.begin("Add");
    draft.preview((scene) => ({ ...scene, budget: { seconds: 2 } }));
    draft.receive(seed(6));
    draft.cancel();
    expect(draft.scene).toEqual(seed(6));
    expect(edits).toHaveLength(1);
  });
});
