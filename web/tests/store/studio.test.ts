import { describe, expect, test } from "vitest";
import type { Camera, Curve } from "../../src/api";
import { Bench, checkedOf, documentOf, settle, shownOf } from "../fakes";

const curve: Curve = { points: [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]] };

describe("opening", () => {
  test("takes the newest project, the one of the address, or asks", async () => {
    const newest = new Bench();
    newest.socket.onopen!();
    newest.sayProjects(4, 9, 2);
    expect(newest.socket.sent).toMatchObject([{ kind: "open_project", project: 9 }]);

    const own = new Bench(4);
    own.socket.onopen!();
    own.sayProjects(4, 9);
    expect(own.socket.sent).toMatchObject([{ kind: "open_project", project: 4 }]);

    const none = new Bench();
    none.socket.onopen!();
    none.sayProjects();
    expect(none.socket.sent).toEqual([]);
    expect(none.studio.state.dialog.value).toBe("projects");
  });

  test("a list that comes later opens nothing", async () => {
    const bench = await new Bench().open();
    bench.sayProjects(1, 2);
    expect(bench.socket.kinds()).toEqual(["open_project"]);
  });

  test("the open project, deleted here or elsewhere, gives way to the newest, or to the dialog", async () => {
    const bench = await new Bench().open("one");
    bench.socket.say(shownOf(3));
    bench.sayProjects(1, 4, 2);
    bench.studio.setGrammar("Edit", "two");
    bench.sayProjects(4, 2);
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "open_project", project: 4 });
    expect(bench.studio.state.notices.value.at(-1)).toMatchObject({ bad: true });
    expect(bench.studio.document.value).toBeNull();
    expect(bench.studio.state.shown.value).toBeNull();
    expect(bench.studio.edits.size.value).toBe(0);
    // A model of the deleted one may still have been on its way.
    bench.socket.say(shownOf(4));
    bench.socket.say(documentOf(1, "other", {}, 4));
    expect(bench.studio.state.shown.value).toBeNull();
    await bench.answer("open_project");
    const said = bench.studio.state.notices.value.length;
    void bench.studio.projects.delete(4);
    bench.sayProjects();
    await bench.answer("delete_project");
    expect(bench.studio.document.value).toBeNull();
    expect(bench.studio.state.dialog.value).toBe("projects");
    expect(bench.studio.state.notices.value).toHaveLength(said);
  });

  test("what is typed while no project is open goes into none", async () => {
    const bench = new Bench();
    bench.socket.onopen!();
    bench.sayProjects();
    bench.studio.type("lost", "typing 1", null);
    bench.studio.setGrammar("Insert", "lost");
    bench.sayProjects(1);
    void bench.studio.projects.open(1);
    bench.socket.say(documentOf(1, "sample"));
    await bench.answer("open_project");
    bench.clock.advance(1000);
    expect(bench.edits()).toEqual([]);
    expect(bench.studio.grammar.value).toBe("sample");
  });

  test("a project that was made is opened, whether or not the server does so itself", async () => {
    const bench = await new Bench().open();
    bench.studio.watch();
    const made = bench.studio.projects.create("New", "bonsai");
    bench.sayProjects(1, 2);
    await bench.answer("create_project");
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "open_project", project: 2 });
    bench.socket.say(documentOf(1, "other", {}, 2));
    await bench.answer("open_project");
    await made;
    expect(bench.studio.grammar.value).toBe("other");
    expect(bench.places).toEqual([[1, null], [2, null]]);
  });

  test("another project forgets what belongs to the first", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.studio.state.selection.value = { kind: "curve", index: 0 };
    bench.socket.say(documentOf(1, "b", {}, 2));
    expect(bench.studio.state.shown.value).toBeNull();
    expect(bench.studio.state.selection.value).toBeNull();
  });
});

describe("a lost connection", () => {
  test("opens the project again and sends what was not confirmed", async () => {
    const bench = await new Bench().open("one");
    bench.studio.setGrammar("Edit", "two");
    expect(bench.edits()).toHaveLength(1);
    bench.socket.onclose!();
    await settle();
    expect(bench.studio.state.status.value.kind).toBe("waiting");
    expect(bench.studio.grammar.value).toBe("two");
    bench.studio.setGrammar("Edit", "three");
    bench.clock.advance(250);
    expect(bench.sockets).toHaveLength(2);
    bench.socket.onopen!();
    bench.sayProjects(1);
    expect(bench.socket.sent).toMatchObject([{ kind: "open_project", project: 1 }]);
    bench.socket.say(documentOf(1, "one"));
    expect(bench.studio.grammar.value).toBe("three");
    await bench.answer("open_project");
    await bench.answer("edit");
    expect(bench.edits().map((edit) => edit.grammar)).toEqual(["two", "three"]);
    bench.socket.say(documentOf(3, "three"));
    await bench.answer("edit");
    expect(bench.studio.edits.size.value).toBe(0);
    expect(bench.studio.grammar.value).toBe("three");
  });

  test("what waits is sent after a reload too, to its own project alone and once", async () => {
    const before = await new Bench().open("one");
    const stop = before.studio.watch();
    before.socket.onclose!();
    before.studio.type("two", "typing 1", "Stem");
    stop();
    const after = new Bench(1, null, before.parked);
    after.studio.watch();
    after.socket.onopen!();
    after.sayProjects(1, 2);
    after.socket.say(documentOf(1, "one"));
    await after.answer("open_project");
    expect(after.studio.grammar.value).toBe("two");
    expect(after.edits()).toMatchObject([{ label: "Edit Stem", grammar: "two" }]);
    after.socket.say(documentOf(2, "two"));
    await after.answer("edit");
    expect(after.parked.size).toBe(0);

    const other = new Bench(2, null, new Map([["espalier-studio-edits", '{"project":1,"edits":[{"label":"a","grammar":"two"}]}']]));
    other.studio.watch();
    other.socket.onopen!();
    other.sayProjects(1, 2);
    other.socket.say(documentOf(1, "other", {}, 2));
    await other.answer("open_project");
    expect(other.edits()).toEqual([]);
    expect(other.studio.grammar.value).toBe("other");
    void new Bench(1, null, new Map([["espalier-studio-edits", "nonsense"]])).open();
  });

  test("what was sent before the page went is not sent again", async () => {
    const before = await new Bench().open("one");
    const stop = before.studio.watch();
    before.studio.setGrammar("Edit", "two");
    stop();
    expect(before.parked.size).toBe(0);
  });

  test("a project that is gone is told of, and its edits with it", async () => {
    const bench = await new Bench().open("one");
    bench.socket.onclose!();
    bench.studio.setGrammar("Edit", "two");
    bench.clock.advance(250);
    bench.socket.onopen!();
    bench.sayProjects(5);
    expect(bench.studio.edits.size.value).toBe(0);
    expect(bench.studio.state.notices.value.some((notice) => notice.bad)).toBe(true);
    expect(bench.socket.sent).toMatchObject([{ kind: "open_project", project: 5 }]);
  });
});

describe("editing", () => {
  test("is seen at once, and confirmed by the server", async () => {
    const bench = await new Bench().open("one");
    bench.studio.setScene("Seed", { seed: 7 });
    expect(bench.studio.scene.value).toEqual({ seed: 7 });
    expect(bench.studio.state.confirmed.value!.scene).toEqual({});
    bench.socket.say(documentOf(2, "one", { seed: 7 }));
    await bench.answer("edit");
    expect(bench.studio.state.confirmed.value!.revision).toBe(2);
    expect(bench.studio.scene.value).toEqual({ seed: 7 });
  });

  test("elsewhere leaves the scene the same object, so that the view rests", async () => {
    const bench = await new Bench().open("one", { seed: 3 });
    const before = bench.studio.scene.value;
    bench.socket.say(documentOf(2, "two", { seed: 3 }));
    expect(bench.studio.scene.value).toBe(before);
    bench.socket.say(documentOf(3, "two", { seed: 4 }));
    expect(bench.studio.scene.value).toEqual({ seed: 4 });
  });

  test("that the server refuses goes back to what it was", async () => {
    const bench = await new Bench().open("one");
    bench.studio.setGrammar("Edit", "two");
    await bench.answer("edit", "too large");
    expect(bench.studio.grammar.value).toBe("one");
    expect(bench.studio.state.notices.value.at(-1)).toMatchObject({ bad: true, text: "Edit: too large" });
    expect(bench.studio.state.log.value.at(-1)).toMatchObject({ level: "error" });
  });

  test("undo comes after what was typed a moment ago", async () => {
    const bench = await new Bench().open("one");
    bench.studio.type("ones", "typing 1", "Stem");
    bench.studio.undo();
    expect(bench.socket.kinds().slice(-2)).toEqual(["edit", "undo"]);
    expect(bench.edits()[0]).toMatchObject({ label: "Edit Stem", gesture: "typing 1", grammar: "ones" });
    bench.socket.say(documentOf(2, "ones"));
    await bench.answer("edit");
    bench.socket.say(documentOf(3, "one"));
    await bench.answer("undo");
    expect(bench.studio.grammar.value).toBe("one");
  });

  test("what is typed while an undo is on its way wins", async () => {
    const bench = await new Bench().open("one");
    bench.studio.undo();
    bench.studio.type("one!", "typing 1", null);
    bench.socket.say(documentOf(2, "none"));
    expect(bench.studio.grammar.value).toBe("one!");
  });

  test("without live search nothing is searched", async () => {
    const bench = await new Bench().open();
    bench.studio.setPreferences({ live: false });
    bench.studio.edit({ label: "Move", scene: { seed: 1 }, search: true });
    expect(bench.edits().at(-1)!.search).toBe(false);
  });

  test("the first curve of a scene brings the guided engine, later ones do not", async () => {
    const bench = await new Bench().open();
    const taken = bench.studio.edit({ label: "Draw", scene: { curves: { curve: [curve] } }, search: true });
    expect(bench.studio.scene.value.search).toEqual({ engine: "guided" });
    expect(taken).toEqual(bench.studio.scene.value);
    await bench.answer("edit");
    bench.studio.edit({ label: "Draw", scene: { search: { engine: "ga" }, curves: { curve: [curve, curve] } }, search: true });
    expect(bench.studio.scene.value.search).toEqual({ engine: "ga" });
  });

  test("deleting the last target takes its table out of the scene, and hidden ones move along", async () => {
    const bench = await new Bench().open("g", { curves: { curve: [curve, curve, curve] } });
    bench.studio.visibility.toggle("curve", 2);
    bench.studio.removeTarget("curve", 0);
    expect(bench.studio.state.hidden.value.curves).toEqual([1]);
    bench.studio.removeTarget("curve", 0);
    bench.studio.removeTarget("curve", 0);
    expect(bench.studio.scene.value).toEqual({});
    expect(bench.studio.state.hidden.value.curves).toEqual([]);
  });

  test("what is hidden stays hidden when undo or another tab moves it, and when undo brings it back", async () => {
    const [a, b, c] = [0.1, 0.2, 0.3].map((offset) => ({ ...curve, offset })) as [Curve, Curve, Curve];
    const bench = await new Bench().open("g", { curves: { curve: [a, b] } });
    const stop = bench.studio.watch();
    const hidden = () => bench.studio.state.hidden.value.curves;
    bench.studio.visibility.toggle("curve", 1);
    bench.socket.say(documentOf(2, "g", { curves: { curve: [c, a, b] } }));
    expect(hidden()).toEqual([2]);
    bench.socket.say(documentOf(3, "g", { curves: { curve: [c, a, { ...b, offset: 0.9 }] } }));
    expect(hidden()).toEqual([2]);
    bench.socket.say(documentOf(4, "g", { curves: { curve: [c, a, b] } }));
    bench.studio.removeTarget("curve", 2);
    expect(hidden()).toEqual([]);
    await bench.answer("edit");
    bench.socket.say(documentOf(5, "g", { curves: { curve: [c, a] } }));
    bench.socket.say(documentOf(6, "g", { curves: { curve: [c, a, b] } }));
    expect(hidden()).toEqual([2]);
    bench.socket.say(documentOf(1, "g", { curves: { curve: [c, a, b] } }, 2));
    expect(hidden()).toEqual([]);
    stop();
  });

  test("a selection that undo took away is no selection", async () => {
    const bench = await new Bench().open("g", { curves: { curve: [curve, curve] } });
    bench.studio.select({ kind: "curve", index: 1 });
    bench.socket.say(documentOf(2, "g", { curves: { curve: [curve] } }));
    expect(bench.studio.state.selection.value).toBeNull();
  });

  test("new curves take the settings of the selected one, or of the last", async () => {
    const bench = await new Bench().open("g", { curves: { curve: [{ ...curve, offset: 0.1 }, { ...curve, offset: 0.2 }] } });
    expect(bench.studio.newCurve()).toEqual({ offset: 0.2 });
    bench.studio.select({ kind: "curve", index: 0 });
    expect(bench.studio.newCurve()).toEqual({ offset: 0.1 });
  });
});

describe("genes", () => {
  const gene = (model: number, number: number, path = "A/B") => ({
    kind: "gene", model, gene: number, rule: "B", path, at: { from: 5, to: 9 }, below: 0, locked: false, draws: [],
  });

  test("a click asks for the gene, and its answer goes to the rule", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.studio.select({ kind: "gene", gene: 4 });
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "ask_gene", gene: 4, model: 3 });
    bench.socket.say(gene(3, 4));
    expect(bench.studio.state.jump.value).toEqual({ at: { from: 5, to: 9 }, focus: false });
  });

  test("are asked for again in a new model, and stay selected if they are still the same", async () => {
    const bench = await new Bench().open();
    const stop = bench.studio.watch();
    bench.socket.say(shownOf(3));
    bench.studio.select({ kind: "gene", gene: 4 });
    bench.socket.say(gene(3, 4));
    bench.socket.say(shownOf(5));
    const again = bench.socket.sent.at(-1)!;
    expect(again).toMatchObject({ kind: "ask_gene", path: "A/B", model: 5 });
    expect(again).not.toHaveProperty("gene");
    // Its number is another there.
    bench.socket.say(gene(5, 7));
    expect(bench.studio.state.selection.value).toEqual({ kind: "gene", gene: 7 });
    expect(bench.studio.state.gene.value!.model).toBe(5);
    // An answer that comes too late changes nothing.
    bench.studio.select({ kind: "gene", gene: 8 });
    bench.socket.say(gene(5, 8, "A/D"));
    bench.socket.say(shownOf(6));
    bench.socket.say(gene(5, 7));
    expect(bench.studio.state.gene.value!.path).toBe("A/D");
    stop();
  });

  test("that a model does not have are selected again as soon as one has them, unless something else was", async () => {
    const bench = await new Bench().open();
    const stop = bench.studio.watch();
    bench.socket.say(shownOf(3));
    bench.studio.select({ kind: "gene", gene: 4 });
    bench.socket.say(gene(3, 4));
    bench.socket.say(shownOf(4));
    bench.socket.say(shownOf(5));
    await bench.answer("ask_gene", "model 5 has no gene A/B");
    expect(bench.studio.state.selection.value).toBeNull();
    expect(bench.studio.state.gene.value!.path).toBe("A/B");
    bench.socket.say(shownOf(6));
    bench.socket.say(gene(6, 2));
    expect(bench.studio.state.selection.value).toEqual({ kind: "gene", gene: 2 });
    bench.socket.say(shownOf(7));
    await bench.answer("ask_gene", "model 7 has no gene A/B");
    bench.studio.select(null);
    const count = bench.socket.sent.length;
    bench.socket.say(shownOf(8));
    expect(bench.socket.sent).toHaveLength(count);
    stop();
  });

  test("are asked for again when they were locked", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.studio.select({ kind: "gene", gene: 4 });
    bench.socket.say(gene(3, 4));
    void bench.studio.genes.setLock(true);
    await bench.answer("set_lock");
    expect(bench.socket.kinds().slice(-2)).toEqual(["set_lock", "ask_gene"]);
  });

  test("dragging a draw keeps one request on its way, each for the gene of the newest model", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.socket.say(gene(3, 4));
    for (let i = 1; i <= 9; ++i) bench.studio.genes.setDraw(0, i / 10, "g");
    const draws = () => bench.socket.sent.filter((one) => one.kind === "set_draw");
    expect(draws()).toHaveLength(1);
    bench.socket.say(shownOf(4));
    bench.socket.say(gene(4, 6));
    await bench.answer("set_draw");
    expect(draws()).toHaveLength(2);
    expect(draws()[1]).toMatchObject({ model: 4, gene: 6, quantile: 0.9, gesture: "g" });
    await bench.answer("set_draw");
    expect(draws()).toHaveLength(2);
  });

  test("the last of one slider is not lost to the next, which is set in the model that it made", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.socket.say(gene(3, 4));
    bench.studio.genes.setDraw(0, 0.1, "a");
    bench.studio.genes.setDraw(0, 0.2, "a");
    bench.studio.genes.setDraw(1, 0.7, "b");
    const draws = () => bench.socket.sent.filter((one) => one.kind === "set_draw").map(({ index, quantile, model }) => [index, quantile, model]);
    await bench.answer("set_draw");
    await bench.answer("set_draw");
    expect(draws()).toEqual([[0, 0.1, 3], [0, 0.2, 3]]);
    bench.socket.say(shownOf(4));
    bench.socket.say(gene(4, 4));
    await settle();
    expect(draws()).toEqual([[0, 0.1, 3], [0, 0.2, 3], [1, 0.7, 4]]);
  });

  test("undo and locks come after draws and edits that wait", async () => {
    const bench = await new Bench().open();
    bench.socket.say(shownOf(3));
    bench.studio.select({ kind: "gene", gene: 4 });
    bench.socket.say(gene(3, 4));
    bench.studio.genes.setDraw(0, 0.1, "a");
    bench.studio.genes.setDraw(0, 0.2, "a");
    bench.studio.undo();
    expect(bench.socket.kinds()).not.toContain("undo");
    await bench.answer("set_draw");
    await bench.answer("set_draw");
    expect(bench.socket.kinds().slice(-3)).toEqual(["set_draw", "set_draw", "undo"]);
    await bench.answer("undo");
    bench.studio.type("typed", "typing 1", null);
    void bench.studio.genes.setLock(true);
    expect(bench.socket.kinds().slice(-2)).toEqual(["edit", "set_lock"]);
    expect(bench.studio.rest).not.toBeNull();
    let rested = false;
    void bench.studio.rest!.then(() => (rested = true));
    await settle();
    expect(rested).toBe(false);
    await bench.answer("edit");
    expect(rested).toBe(true);
    expect(bench.studio.rest).toBeNull();
  });
});

describe("the reach of the rule under the cursor", () => {
  test("is asked for when the cursor rests and when the grammar changed, not with errors", async () => {
    const bench = await new Bench().open();
    const stop = bench.studio.watch();
    const symbol = { kind: "rule" as const, name: "Stem", signature: "rule Stem", at: { from: 0, to: 4 } };
    bench.socket.say(checkedOf(1, { symbols: [symbol] }));
    bench.studio.state.cursorRule.value = "Stem";
    expect(bench.socket.kinds()).not.toContain("ask_reach");
    bench.clock.advance(150);
    const asked = () => bench.socket.sent.filter((one) => one.kind === "ask_reach").length;
    expect(asked()).toBe(1);
    bench.socket.say(checkedOf(2, { symbols: [symbol], problems: [{ severity: "error", code: "E0110", text: "no" }] }));
    bench.clock.advance(150);
    expect(asked()).toBe(1);
    bench.socket.say(checkedOf(3, { symbols: [symbol] }));
    bench.clock.advance(150);
    expect(asked()).toBe(2);
    bench.studio.setPreferences({ reach: false });
    bench.socket.say(checkedOf(4, { symbols: [symbol] }));
    bench.clock.advance(150);
    expect(asked()).toBe(2);
    stop();
  });
});

describe("searching", () => {
  test("starts with the time of the scene, from the shown model where something is locked", async () => {
    const bench = await new Bench().open("g", { budget: { seconds: 0.5 } });
    bench.studio.searching.toggle();
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "start_search", seconds: 0.5, from: "nothing" });
    bench.socket.say(shownOf(1, { locked: [3] }));
    bench.studio.searching.start("new");
    expect(bench.socket.sent.at(-1)).toMatchObject({ from: "shown" });
    bench.studio.searching.start("onward");
    expect(bench.socket.sent.at(-1)).toMatchObject({ onward: true });
    bench.socket.say({ kind: "search_state", running: true, engine: "ga", steps: 0, evaluations: 0, seconds: 0, rises: [], onward: false });
    bench.studio.searching.toggle();
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "stop_search" });
  });
});

describe("painting", () => {
  test("that could not be sent is kept until the server is back", async () => {
    const bench = await new Bench().open();
    const stop = bench.studio.watch();
    let reachable = false;
    bench.studio.files.upload = () => (reachable ? Promise.resolve() : Promise.reject(new Error("no server")));
    bench.studio.painter()(new Blob(["x"]), { eye: [0, 1, 5], at: [0, 1, 0] });
    await settle();
    expect(bench.studio.hasUnsaved).toBe(true);
    expect(bench.studio.scene.value.silhouette).toBeUndefined();
    reachable = true;
    bench.studio.state.status.value = { kind: "closed" };
    bench.studio.state.status.value = { kind: "open" };
    await settle();
    expect(bench.studio.hasUnsaved).toBe(false);
    expect(bench.studio.scene.value.silhouette).toHaveLength(1);
    stop();
  });

  test("belongs to the project in which it began", async () => {
    const bench = await new Bench().open();
    const stop = bench.studio.watch();
    const uploaded: [number, string][] = [];
    bench.studio.files.upload = (project, name) => Promise.resolve(void uploaded.push([project, name]));
    const first = bench.studio.document.value!.project.id, out = bench.studio.painter();
    const document = documentOf(1, "other");
    bench.socket.say({ ...document, project: { ...document.project, id: first + 1 } });
    out(new Blob(["x"]), { eye: [0, 1, 5], at: [0, 1, 0] });
    await settle();
    expect([uploaded.length, bench.studio.hasUnsaved]).toEqual([0, true]);
    bench.socket.say({ ...document, project: { ...document.project, id: first } });
    await settle();
    expect(uploaded).toEqual([[first, "painted.png"]]);
    stop();
  });

  test("uploads the picture and makes or changes the silhouette of its camera", async () => {
    const bench = await new Bench().open();
    const uploaded: string[] = [];
    bench.studio.files.upload = (_project, name) => {
      uploaded.push(name);
      return Promise.resolve();
    };
    const camera: Camera = { eye: [0, 1, 5], at: [0, 1, 0], tall: 4 };
    bench.studio.painter()(new Blob(["x"]), camera);
    await settle();
    expect(uploaded).toEqual(["painted.png"]);
    expect(bench.studio.scene.value.silhouette).toEqual([{ image: "painted.png", view: "parts", camera }]);
    bench.socket.say({ ...documentOf(2, "g", bench.studio.scene.value), files: [{ path: "painted.png", bytes: 1 }] });
    bench.studio.painter()(new Blob(["y"]), { tall: 4, at: [0, 1, 0], eye: [0, 1.000001, 5] });
    await settle();
    expect(uploaded).toEqual(["painted.png", "painted-2.png"]);
    expect(bench.studio.paintedBefore({ ...camera })?.url).toContain("painted-2.png");
    bench.studio.select(null);
    expect(bench.studio.paintedBefore({ ...camera, tall: 9 })).toBeNull();
    bench.studio.select({ kind: "silhouette", index: 0 });
    expect(bench.studio.scene.value.silhouette).toEqual([{ image: "painted-2.png", view: "parts", camera }]);
    expect(bench.studio.state.selection.value).toEqual({ kind: "silhouette", index: 0 });
  });
});

describe("favourites", () => {
  test("that were dropped can be taken back for a while", async () => {
    const bench = await new Bench().open();
    const dropped = bench.studio.dropFavourite(7);
    await bench.answer("drop_favourite");
    await dropped;
    bench.clock.advance(10000);
    bench.studio.state.notices.value.at(-1)!.action!.run();
    expect(bench.socket.sent.at(-1)).toMatchObject({ kind: "restore_favourite", favourite: 7 });
    bench.clock.advance(10000);
    expect(bench.studio.state.notices.value).toEqual([]);
  });
});

describe("the log", () => {
  test("has what notices said, after they went", async () => {
    const bench = await new Bench().open();
    bench.studio.tell("good");
    bench.studio.tell("bad", true);
    bench.clock.advance(10000);
    expect(bench.studio.state.notices.value).toEqual([]);
    expect(bench.studio.state.log.value).toMatchObject([{ level: "info", text: "good" }, { level: "error", text: "bad" }]);
  });

  test("keeps the newest lines", async () => {
    const bench = await new Bench().open();
    for (let i = 0; i < 700; ++i) bench.socket.say({ kind: "log", level: "info", text: `line ${i}` });
    expect(bench.studio.state.log.value).toHaveLength(500);
    expect(bench.studio.state.log.value.at(-1)!.text).toBe("line 699");
  });

  test("tells of messages that the page does not know", async () => {
    const bench = await new Bench().open();
    bench.socket.say({ kind: "weather" });
    expect(bench.studio.state.log.value.at(-1)!.text).toContain("weather");
  });
});
