// The room's state: what messages change, and what a person's doing sends.
import { beforeEach, describe, expect, test } from "vitest";
import type { Breeding, BredIndividual } from "../../src/api";
import { decodeIndividual, isRoomTable } from "../../src/breeding/individual_message";
import { decodeParts } from "../../src/breeding/individual_parts";
import { genesOf, grow, individualMessage, kDraws, treeTable } from "../mock/tree";
import { decodeMeshes, kInstanceWords, MessageError } from "../../src/view/messages";
import { Bench, settle } from "../fakes";

const grown = grow(Array.from({ length: kDraws }, () => 0.5));
const espi = (session: number, individual: number, version = 1) => individualMessage(session, individual, version, grown, 0.5);
const bredOf = (session: number, individual: number, version = 1) => ({
  kind: "bred" as const, session, individual, version, genes: 2, parts: 1, triangles: 10, height: 1, spread: 1, terms: [], words: "", viable: true, why: [], truncated: false,
});
const individualsOf = (...ids: number[]): BredIndividual[] => ids.map((id) => ({ id, generation: 1, origin: "sampled", parents: [], edited: false, version: 1 }));

function breedingOf(session: number, ids: number[], changes: Partial<Breeding> = {}): Breeding {
  const generation = changes.generation ?? 1;
  return {
    kind: "breeding", session: { id: session, name: `S${session}`, method: "free", generations: 1, individuals: ids.length, changed: 0 }, revision: 1,
    settings: { method: "free", mode: "rate_and_edit", population: 12 }, seed: 1, locked: [], generation,
    generations: [{ number: generation, depth: 0, label: "", individuals: ids.length, rated: 0, edited: 0, seconds: 0 }], individuals: individualsOf(...ids), ...changes,
  };
}

let bench: Bench;
const room = () => bench.studio.room;
beforeEach(async () => {
  bench = await new Bench().open();
  room().here.value = true;
});

describe("ESPI", () => {
  test("is a model with a head", () => {
    const message = decodeIndividual(espi(3, 12, 5));
    expect(message).toMatchObject({ session: 3, individual: 12, version: 5 });
    const table = decodeMeshes(treeTable());
    const model = decodeParts(message.model, table.meshes.length);
    expect(model).toMatchObject({ number: 5, table: table.number, instances: grown.parts.length, materials: 3, bones: 0, genes: 1 });
    expect(isRoomTable(treeTable())).toBe(true);
  });

  test("has parts as exact as their digits", () => {
    const model = decodeParts(espi(1, 1), 2), longest = Math.max(...grown.parts.flatMap((part) => part.frame.slice(0, 9).map(Math.abs)));
    const far = Math.max(...grown.parts.flatMap((part) => part.frame.slice(9).map(Math.abs)));
    grown.parts.forEach((part, i) => {
      const at = i * kInstanceWords;
      part.frame.forEach((value, k) => expect(Math.abs(model.floats[at + k]! - value)).toBeLessThan(k < 9 ? longest / 2000 : 2 * far / 65000));
      expect(model.floats[at + 12]).toBeCloseTo(part.top, 3);
      expect([model.words[at + 13], model.words[at + 14]! & 0xffff, model.words[at + 14]! >>> 16, model.words[at + 15]]).toEqual([0, part.mesh, part.material, 0]);
    });
  });

  test.each([
    ["too short", (data: ArrayBuffer) => data.slice(0, 40), /40 bytes, its head has 64/],
    ["cut", (data: ArrayBuffer) => data.slice(0, -4), /bytes; what it announces has/],
    ["other letters", (data: ArrayBuffer) => { new Uint8Array(data)[0] = 65; return data; }, /"ASPI", not ESPI/],
    ["another version", (data: ArrayBuffer) => { new DataView(data).setUint32(4, 1, true); return data; }, /version 1; this page reads version 2/],
  ])("with %s is refused", (_name, spoil, why) => {
    expect(() => decodeIndividual(spoil(espi(1, 1)))).toThrow(MessageError);
    expect(() => decodeIndividual(spoil(espi(1, 1)))).toThrow(why);
  });

  test.each([
    ["mesh", 26, /part 0 names mesh 2 of 2, material 0 of 3/],
    ["material", 28, /part 0 names mesh 0 of 2, material 3 of 3/],
  ])("with a part of a %s that there is not is refused", (_name, at, why) => {
    const data = espi(1, 1);
    new DataView(data).setUint16(64 + at, at === 26 ? 2 : 3, true);
    expect(() => decodeParts(data, 2)).toThrow(why);
  });

  test("that is nonsense is told in the log, and nothing breaks", () => {
    const data = espi(1, 1);
    new DataView(data).setUint32(24, 65, true);
    bench.socket.sayBinary(data);
    expect(bench.studio.state.log.value.at(-1)!.text).toContain("ESPI");
    expect(room().state.models.value.size).toBe(0);
  });
});

describe("messages", () => {
  test("a session, its models and their words", () => {
    bench.socket.say(breedingOf(1, [1, 2, 3]));
    bench.socket.sayBinary(treeTable());
    bench.socket.sayBinary(espi(1, 2));
    bench.socket.say(bredOf(1, 2));
    expect(room().state.selected.value).toBe(1);
    expect(room().state.models.value.get(2)!.bred!.triangles).toBe(10);
    expect(room().state.meshes.value).not.toBeNull();
    expect(bench.studio.state.meshes.value).toBeNull();
  });

  test("words of another version or session are no words of this model", () => {
    bench.socket.say(breedingOf(1, [1]));
    bench.socket.sayBinary(espi(1, 1, 2));
    bench.socket.say(bredOf(1, 1, 1));
    bench.socket.say(bredOf(2, 1, 2));
    expect(room().state.models.value.get(1)!.bred).toBeNull();
    bench.socket.say(bredOf(1, 1, 2));
    expect(room().state.models.value.get(1)!.bred).not.toBeNull();
  });

  test("another generation has other models; what was selected is not, where it is gone", () => {
    bench.socket.say(breedingOf(1, [1, 2]));
    bench.socket.sayBinary(espi(1, 1));
    room().select(2);
    bench.socket.say(breedingOf(1, [2, 3], { generation: 2 }));
    expect([...room().state.models.value.keys()]).toEqual([]);
    expect(room().state.selected.value).toBe(2);
    bench.socket.say(breedingOf(1, [4, 5], { generation: 3 }));
    expect(room().state.selected.value).toBe(4);
  });

  test("genes of another than the selected one are not shown", () => {
    bench.socket.say(breedingOf(1, [1, 2]));
    const genes = genesOf(Array.from({ length: kDraws }, () => 0.5), []);
    bench.socket.say({ kind: "individual_genes", session: 1, individual: 2, version: 1, genes, truncated: false });
    expect(room().state.genes.value).toBeNull();
    bench.socket.say({ kind: "individual_genes", session: 1, individual: 1, version: 1, genes, truncated: false });
    expect(room().state.genes.value!.genes).toHaveLength(2);
  });

  test("the session of the address is opened, and the address keeps up", async () => {
    const own = await new Bench(1, 7).open();
    own.studio.watch();
    expect(own.studio.room.here.value).toBe(true);
    own.socket.say({ kind: "breedings", sessions: [{ id: 7, name: "S", changed: 1, generations: 1, classic: false }] });
    expect(own.socket.sent.at(-1)).toMatchObject({ kind: "open_breeding", session: 7 });
    own.socket.say({ ...breedingOf(1, [1]), session: { ...breedingOf(1, [1]).session, id: 7 } });
    own.studio.room.go(false);
    own.studio.room.go(true);
    own.socket.say({ ...breedingOf(1, [1]), session: { ...breedingOf(1, [1]).session, id: 8 } });
    expect(own.places).toEqual([[1, 7], [1, null], [1, 7], [1, 8]]);
  });

  test("a session of the address that is gone is forgotten", async () => {
    const own = await new Bench(1, 7).open();
    own.socket.say({ kind: "breedings", sessions: [] });
    expect(own.socket.sent.filter((one) => one.kind === "open_breeding")).toEqual([]);
    expect(own.studio.room.place.value).toBeNull();
  });

  test("another project forgets the room", () => {
    bench.socket.say(breedingOf(1, [1]));
    bench.socket.say({ kind: "document", project: { id: 2, name: "P2", changed: 0 }, revision: 1, grammar: "", scene: {}, files: [], favourites: [] });
    expect(room().state.breeding.value).toBeNull();
  });
});

describe("doing", () => {
  beforeEach(() => bench.socket.say(breedingOf(1, [1, 2, 3])));
  const sent = (kind: string) => bench.socket.sent.filter((one) => one.kind === kind);

  test("points and stars are ratings; the same stars again take them away", () => {
    room().point(2, -1);
    room().stars(1, 5);
    expect(sent("rate")).toMatchObject([{ ratings: [{ individual: 2, rating: -1 }] }, { ratings: [{ individual: 1, rating: 2 }] }]);
    bench.socket.say(breedingOf(1, [1, 2, 3], { individuals: [{ ...individualsOf(1)[0]!, rating: 2 }] }));
    room().stars(1, 5);
    expect(sent("rate").at(-1)).toMatchObject({ ratings: [{ individual: 1 }] });
    expect((sent("rate").at(-1) as { ratings: object[] }).ratings[0]).not.toHaveProperty("rating");
  });

  test("quick clicks add up, though none was answered", async () => {
    for (let i = 0; i < 3; ++i) room().point(2, 1);
    expect(sent("rate").at(-1)).toMatchObject({ ratings: [{ individual: 2, rating: 3 }] });
    for (const one of sent("rate")) bench.socket.say({ kind: "done", request: one.request! });
    await settle();
    room().point(2, 1);  // of what the server says, which said nothing here
    expect(sent("rate").at(-1)).toMatchObject({ ratings: [{ individual: 2, rating: 1 }] });
  });

  test("undo and redo are sent whatever was answered, after the last step of a slider", () => {
    room().setGenes(1, [{ gene: 0, index: 4, quantile: 0.1 }], "g", "Set");
    room().setGenes(1, [{ gene: 0, index: 4, quantile: 0.2 }], "g", "Set");
    room().undo();
    room().redo();
    expect(bench.socket.sent.slice(-4).map((one) => one.kind)).toEqual(["set_genes", "set_genes", "undo_breeding", "redo_breeding"]);
  });

  test("sliders of two gestures are two edits, however quick", () => {
    for (const [gesture, quantile] of [["a", 0.1], ["a", 0.2], ["b", 0.3], ["b", 0.4]] as const) room().setGenes(1, [{ gene: 0, index: 4, quantile }], gesture, "Set");
    expect(sent("set_genes").map((one) => (one as { gesture: string }).gesture)).toEqual(["a", "a"]);
    room().undo();
    expect(sent("set_genes")).toMatchObject([{ gesture: "a" }, { gesture: "a", draws: [{ quantile: 0.2 }] }, { gesture: "b", draws: [{ quantile: 0.4 }] }]);
  });

  test("out of sight is out of the room, and back again", () => {
    room().go(true);
    room().go(false);
    expect(sent("leave_breeding")).toHaveLength(1);
    bench.socket.say({ kind: "breedings", sessions: [breedingOf(1, []).session] });
    expect(sent("open_breeding")).toHaveLength(0);
    room().go(true);
    expect(sent("open_breeding")).toMatchObject([{ session: 1 }]);
  });

  test("a session that another page deleted is none any more", () => {
    bench.socket.say({ kind: "breedings", sessions: [] });
    expect(room().state.breeding.value).toBeNull();
  });

  test("two are compared once, and the next generation has pairs of its own", async () => {
    room().look("pairs");
    void room().pick(0);
    void room().pick(0);
    expect(sent("compare")).toHaveLength(1);
    await bench.answer("compare");
    bench.socket.say(breedingOf(1, [4, 5, 6], { generation: 2 }));
    expect(room().state.close.value).toEqual({ kind: "pairs", pair: [4, 5] });
  });

  test("what was compared before a reload is not asked again", () => {
    bench.socket.say(breedingOf(1, [1, 2, 3], { compared: [{ better: 2, worse: 1 }, { better: 3, worse: 1 }] }));
    room().look("pairs");
    expect(room().state.close.value).toEqual({ kind: "pairs", pair: [2, 3] });
    bench.socket.say(breedingOf(1, [1, 2, 3], { compared: [{ better: 2, worse: 1 }, { better: 3, worse: 1 }, { better: 3, worse: 2 }] }));
    room().look("pairs");
    expect(room().state.close.value).toEqual({ kind: "pairs", pair: null });
  });

  test("without a connection nothing is lost in silence", () => {
    bench.socket.onclose!();
    room().point(1, 1);
    expect(sent("rate")).toEqual([]);
    expect(bench.studio.state.notices.value.at(-1)!.text).toContain("nothing was changed");
  });

  test("a mode without ratings sends none, and says why", () => {
    bench.socket.say(breedingOf(1, [1], { settings: { mode: "edit" } }));
    room().point(1, 1);
    expect(sent("rate")).toEqual([]);
    expect(bench.studio.state.notices.value.at(-1)!.text).toContain("without ratings");
  });

  test("live sliders: one is on its way, the newest of each draw follows", async () => {
    for (const quantile of [0.1, 0.2, 0.3]) room().setGenes(1, [{ gene: 0, index: 4, quantile }], "g", "Set");
    room().setGenes(1, [{ gene: 0, index: 5, quantile: 0.9 }], "g", "Set");
    expect(sent("set_genes")).toHaveLength(1);
    await bench.answer("set_genes");
    expect(sent("set_genes")).toHaveLength(2);
    expect(sent("set_genes")[1]).toMatchObject({ draws: [{ index: 4, quantile: 0.3 }, { index: 5, quantile: 0.9 }] });
  });

  test("a pair is compared once, then the next one comes", async () => {
    room().look("pairs");
    const close = room().state.close.value;
    expect(close).toMatchObject({ kind: "pairs", pair: [1, 2] });
    const picked = room().pick(1);
    await settle();
    expect(sent("compare")).toMatchObject([{ better: 2, worse: 1 }]);
    await bench.answer("compare");
    await picked;
    expect(room().state.close.value).toMatchObject({ pair: [1, 3] });
  });

  test("three parents at most, with a preview of theirs", () => {
    room().toggleParent(1);
    expect(sent("blend")).toEqual([]);
    room().toggleParent(2);
    expect(sent("blend")).toMatchObject([{ parents: [1, 2], weights: [0.5, 0.5] }]);
    expect(room().state.close.value.kind).toBe("blend");
    room().toggleParent(2);
    expect(room().state.close.value.kind).toBe("none");
  });

  test("nothing is bred twice while it is being bred", () => {
    room().breed();
    room().breed();
    expect(sent("breed")).toHaveLength(1);
    expect(room().state.waiting.value).not.toBeNull();
  });

  test("genes are asked for when the room is in sight, and again when they changed", async () => {
    const stop = bench.studio.watch();
    expect(sent("ask_individual")).toHaveLength(1);
    bench.socket.say(breedingOf(1, [1, 2, 3], { individuals: [{ ...individualsOf(1)[0]!, version: 2 }] }));
    expect(sent("ask_individual")).toHaveLength(2);
    room().go(false);
    bench.socket.say(breedingOf(1, [1], { individuals: [{ ...individualsOf(1)[0]!, version: 3 }] }));
    expect(sent("ask_individual")).toHaveLength(2);
    stop();
  });

  test("a lost connection leads back into the session", async () => {
    bench.socket.close();
    bench.clock.advance(60_000);
    bench.socket.onopen?.();
    bench.socket.say({ kind: "breedings", sessions: [breedingOf(1, []).session] });
    expect(sent("open_breeding")).toMatchObject([{ session: 1 }]);
  });

  test("and out of it, where it is not there any more", () => {
    bench.socket.close();
    bench.clock.advance(60_000);
    bench.socket.onopen?.();
    bench.socket.say({ kind: "breedings", sessions: [] });
    expect(room().state.breeding.value).toBeNull();
  });
});
