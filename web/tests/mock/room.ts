// The breeding room of the mock server: sessions of made-up trees, bred by the plainest means. It follows the protocol, not the
// program: what it breeds says nothing of what the program breeds.
import type { Bred, BredIndividual, Breeding, BreedingInfo, GenerationInfo, Message, Request, RoomSettings } from "../../src/api";
import { genesOf, grow, individualMessage, kDraws, pathOf, placeOf, randomOf, treeTable } from "./tree.ts";

interface Individual extends BredIndividual {
  quantiles: number[];
}
interface Generation extends GenerationInfo {
  members: Individual[];
}
interface Step {
  label: string;
  gesture: string | undefined;
  back(): void;
  on(): void;
}
export interface Voice {
  say(message: Message): void;
  bytes(data: ArrayBuffer): void;
}

const kStandard: Required<Omit<RoomSettings, "classic">> = {
  method: "free", mode: "rate_and_edit", population: 12, strength: 0.35, keep: 2, newcomers: 0.1, taste: false, max_triangles: 0, max_height: 0, max_spread: 0,
};
const kClassic = { crossover: 0.6, mutation: 0.001, gap: 1, window: 5, selection: "proportional", elitist: true, gray: true } as const;

export class MockSession {
  readonly id: number;
  generations: Generation[] = [];
  shown = 1;
  locked: { path: string; index: number }[] = [];
  settings: RoomSettings;
  name: string;
  revision = 1;
  private people = 0;
  private steps: Step[] = [];
  private at = 0;
  private readonly random: () => number;

  constructor(id: number, name: string | undefined, settings: RoomSettings) {
    this.id = id;
    this.name = name ?? `Session ${id}`;
    const classic = settings.method === "classic";
    this.settings = { ...kStandard, ...(classic ? { population: 20, classic: kClassic } : {}), ...settings };
    this.random = randomOf(0.31 + 0.07 * id);
    this.generations.push(this.generation("First generation", undefined, Array.from({ length: this.settings.population! }, () => this.born("sampled", [], this.drawn()))));
  }

  get here(): Generation {
    return this.generations[this.shown - 1]!;
  }
  find(id: number): Individual | undefined {
    return this.generations.flatMap((one) => one.members).find((one) => one.id === id);
  }

  info(): BreedingInfo {
    return { id: this.id, name: this.name, method: this.settings.method!, generations: this.generations.length, individuals: this.people, changed: Date.now() / 1000 };
  }

  message(): Breeding {
    const undo = this.steps[this.at - 1]?.label, redo = this.steps[this.at]?.label;
    const { taste } = this.settings;
    return {
      kind: "breeding", session: this.info(), revision: ++this.revision, settings: this.settings, seed: 7, locked: this.locked, generation: this.shown,
      generations: this.generations.map(({ members, ...one }) => ({ ...one, individuals: members.length, rated: members.filter((m) => m.rating !== undefined).length, edited: members.filter((m) => m.edited).length })),
      individuals: this.here.members.map(({ quantiles: _, ...one }, i) => (taste
        ? { ...one, role: i % 5 === 3 ? "different" as const : i % 5 === 4 ? "uncertain" as const : "best" as const, taste: { mean: 1.4 - 0.2 * i, sd: 0.6, why: ["for: a wide crown", "against: few leaves"] } }
        : one)),
      diversity: this.diversity(), ...(taste ? { taste_why: ["wide crowns", "many leaves", "thin trunks"] } : {}),
      ...(undo === undefined ? {} : { undo }), ...(redo === undefined ? {} : { redo }),
      ...(this.generations.length >= 10 ? { hint: "10 generations: choose one, or branch from an earlier one" } : {}),
    };
  }

  model(one: { id: number; version: number; quantiles: number[] }): [ArrayBuffer, Bred] {
    const grown = grow(one.quantiles);
    const low = grown.low < -0.05;
    return [individualMessage(this.id, one.id, one.version, grown, one.quantiles[10]!), {
      kind: "bred", session: this.id, individual: one.id, version: one.version, genes: 2, parts: grown.parts.length, triangles: grown.triangles, height: grown.height, spread: grown.spread,
      terms: [], words: "", viable: !low, why: low ? ["it grows into the ground"] : [], truncated: false,
    }];
  }

  /** What a request changes; a text: why not. */
  handle(message: Request): string | null {
    switch (message.kind) {
      case "set_breeding": {
        const before = this.settings;
        const after = { ...before, ...message.settings, ...(message.settings.classic ? { classic: { ...before.classic, ...message.settings.classic } } : {}) };
        return this.step("Settings", message.gesture, () => (this.settings = before), () => (this.settings = after));
      }
      case "rate": {
        if (!["rate_and_edit", "rate"].includes(this.settings.mode!)) return "this session is bred without ratings";
        const before = message.ratings.map(({ individual }) => [individual, this.find(individual)?.rating] as const);
        const set = (list: readonly (readonly [number, number | undefined])[]) => list.forEach(([id, rating]) => {
          const one = this.find(id)!;
          if (rating === undefined) delete one.rating;
          else one.rating = rating;
        });
        return this.step(message.label ?? "Rate", message.gesture, () => set(before), () => set(message.ratings.map((one) => [one.individual, one.rating])));
      }
      case "compare":
        return this.handle({ kind: "rate", label: "Compare", ratings: [
          { individual: message.better, rating: (this.find(message.better)!.rating ?? 0) + 1 }, { individual: message.worse, rating: (this.find(message.worse)!.rating ?? 0) - 1 },
        ] });
      case "breed":
        return this.next("Bred", this.bredMembers());
      case "more_like_this": {
        const one = this.find(message.individual)!;
        const others = Array.from({ length: this.settings.population! - 1 }, () => this.born("sibling", [one.id], this.mutated(one.quantiles, 0.08, one)));
        return this.next(`More like ${one.id}`, [this.copy(one), ...others]);
      }
      case "blend": {
        const quantiles = this.blended(message.parents, message.weights);
        const one = this.born("blended", message.parents, quantiles);
        const { members } = this.here;
        return this.step("Blend", undefined, () => members.splice(members.indexOf(one), 1), () => members.push(one));
      }
      case "set_genes": {
        if (!["rate_and_edit", "edit"].includes(this.settings.mode!)) return "this session is bred without editing";
        const one = this.find(message.individual)!;
        const before = one.quantiles, was = one.edited, after = [...before];
        for (const draw of message.draws) after[placeOf(draw.gene, draw.index)] = draw.quantile;
        const set = (quantiles: number[], edited: boolean) => Object.assign(one, { quantiles, edited, version: one.version + 1 });
        return this.step(message.label ?? "Edit", message.gesture, () => set(before, was), () => set(after, true));
      }
      case "lock_draws": {
        const before = this.locked;
        const rest = before.filter((one) => !message.draws.some((draw) => draw.path === one.path && draw.index === one.index));
        return this.step(message.locked ? "Lock" : "Free", undefined, () => (this.locked = before), () => (this.locked = message.locked ? [...rest, ...message.draws] : rest));
      }
      case "go_to_generation": {
        const before = this.shown;
        return this.step(`Go to generation ${message.generation}`, undefined, () => (this.shown = before), () => (this.shown = message.generation));
      }
      case "undo_breeding": {
        const step = this.steps[this.at - 1];
        if (step === undefined) return "there is nothing to undo";
        this.at -= 1;
        step.back();
        return null;
      }
      case "redo_breeding": {
        const step = this.steps[this.at];
        if (step === undefined) return "there is nothing to redo";
        this.at += 1;
        step.on();
        return null;
      }
      default:
        return `the mock does not know ${message.kind}`;
    }
  }

  blended(parents: readonly number[], weights: readonly number[]): number[] {
    const sum = weights.reduce((a, b) => a + b, 0);
    return Array.from({ length: kDraws }, (_, k) => parents.reduce((q, id, i) => q + this.find(id)!.quantiles[k]! * weights[i]! / sum, 0));
  }

  private step(label: string, gesture: string | undefined, back: () => void, on: () => void): null {
    const last = this.steps[this.at - 1];
    this.steps = this.steps.slice(0, this.at);
    on();
    if (gesture !== undefined && last?.gesture === gesture) this.steps[this.at - 1] = { ...last, on };
    else this.at = this.steps.push({ label, gesture, back, on });
    return null;
  }

  private next(label: string, members: Individual[]): null {
    const from = this.shown, made = this.generation(label, from, members);
    this.generations.push(made);
    return this.step("Next generation", undefined, () => (this.shown = from), () => (this.shown = made.number));
  }

  private generation(label: string, parent: number | undefined, members: Individual[]): Generation {
    const number = this.generations.length + 1;
    members.forEach((one) => (one.generation = number));
    return { number, ...(parent === undefined ? {} : { parent }), depth: parent === undefined ? 0 : this.generations[parent - 1]!.depth + 1, label, individuals: members.length, rated: 0, edited: 0, seconds: 0, members };
  }

  private bredMembers(): Individual[] {
    const { members } = this.here, { population, keep, newcomers, strength, mode } = this.settings;
    const rated = mode === "rate" || mode === "rate_and_edit";
    const ratings = members.flatMap((one) => one.rating ?? []), mean = ratings.length === 0 ? 0 : ratings.reduce((a, b) => a + b, 0) / ratings.length;
    const weights = members.map((one) => Math.exp(rated ? (one.rating ?? mean) : 0)), sum = weights.reduce((a, b) => a + b, 0);
    const choose = () => {
      let left = this.random() * sum;
      return members[weights.findIndex((weight) => (left -= weight) <= 0)] ?? members[0]!;
    };
    const best = [...members].filter((one) => (one.rating ?? 0) > 0).sort((a, b) => b.rating! - a.rating!).slice(0, keep);
    const out = best.map((one) => this.copy(one));
    while (out.length < population!) {
      if (this.random() < newcomers!) out.push(this.born("sampled", [], this.drawn()));
      else {
        const a = choose(), b = choose();
        const mixed = a.quantiles.map((q, i) => (this.random() < 0.5 ? q : b.quantiles[i]!));
        out.push(this.born(a === b ? "mutated" : "crossed", a === b ? [a.id] : [a.id, b.id], this.mutated(mixed, 0.3 * strength!, a)));
      }
    }
    return out;
  }

  private copy(one: Individual): Individual {
    const copy = this.born("kept", [one.id], one.quantiles);
    if (one.rating !== undefined) copy.rating = one.rating;
    return copy;
  }
  private born(origin: Individual["origin"], parents: readonly number[], quantiles: number[]): Individual {
    return { id: ++this.people, generation: this.shown, origin, parents: [...parents], edited: false, version: 1, quantiles };
  }
  private drawn(): number[] {
    return Array.from({ length: kDraws }, () => this.random());
  }
  private mutated(quantiles: readonly number[], much: number, first: Individual): number[] {
    return quantiles.map((q, i) => {
      const { path, index } = pathOf(i);
      if (this.locked.some((one) => one.path === path && one.index === index)) return first.quantiles[i]!;
      return Math.min(1, Math.max(0, q + much * (this.random() + this.random() - 1) * 2));
    });
  }
  private diversity(): number {
    const { members } = this.here;
    let sum = 0, pairs = 0;
    members.forEach((a, i) => members.slice(i + 1).forEach((b) => {
      sum += a.quantiles.reduce((d, q, k) => d + Math.abs(q - b.quantiles[k]!), 0) / kDraws;
      ++pairs;
    }));
    return pairs === 0 ? 0 : Math.min(1, sum / pairs / 0.5);
  }
}

/** One room for all projects of the mock. */
export class MockRoom {
  sessions: MockSession[] = [];
  open: MockSession | null = null;
  readonly inside = new Set<Voice>();
  private made = 0;

  list(): Message {
    return { kind: "breedings", sessions: this.sessions.map((one) => one.info()), ...(this.open === null ? {} : { open: this.open.id }) };
  }

  /** Null: not a request of the room's; "": done; else why it failed. */
  handle(message: Request, voice: Voice, everyone: (message: Message) => void): string | null {
    const named = "session" in message && typeof message.session === "number" ? this.sessions.find((one) => one.id === message.session) : undefined;
    switch (message.kind) {
      case "start_breeding":
        this.sessions.unshift(new MockSession(++this.made, message.name, message.settings));
        this.enter(this.sessions[0]!, voice);
        everyone(this.list());
        return "";
      case "open_breeding":
        if (named === undefined) return `there is no session ${message.session}`;
        this.enter(named, voice);
        return "";
      case "leave_breeding":
        this.inside.delete(voice);
        return "";
      case "rename_breeding":
        named!.name = message.name;
        if (this.open !== null) this.tell();
        everyone(this.list());
        return "";
      case "delete_breeding":
        this.sessions = this.sessions.filter((one) => one !== named);
        if (this.open === named) this.open = null;
        everyone(this.list());
        return "";
    }
    if (!["set_breeding", "rate", "compare", "breed", "more_like_this", "blend", "set_genes", "lock_draws", "go_to_generation", "undo_breeding", "redo_breeding", "ask_individual", "ask_model", "ask_lineage", "keep_individual", "show_individual"].includes(message.kind)) return null;
    const session = this.open;
    if (session === null) return "no session is open";
    switch (message.kind) {
      case "ask_individual": {
        const one = session.find(message.individual);
        if (one === undefined) return `there is no individual ${message.individual}`;
        voice.say({ kind: "individual_genes", session: session.id, individual: one.id, version: one.version, genes: genesOf(one.quantiles, session.locked), truncated: false });
        return "";
      }
      case "ask_model":
        this.show(session, session.find(message.individual)!, voice);
        return "";
      case "ask_lineage":
        voice.say({ kind: "lineage", session: session.id, individuals: session.generations.flatMap((one) => one.members).map(({ id, generation, origin, parents, rating, edited }) => ({ id, generation, origin, parents, edited, ...(rating === undefined ? {} : { rating }) })) });
        return "";
      case "keep_individual":
      case "show_individual":
        return "";
      case "blend":
        if (message.keep !== true) {
          this.show(session, { id: 0, version: ++this.made, quantiles: session.blended(message.parents, message.weights) }, voice);
          return "";
        }
    }
    const shown = session.shown;
    const versions = new Map(session.here.members.map((one) => [one.id, one.version]));
    const why = session.handle(message);
    if (why !== null) return why;
    this.tell();
    for (const one of session.here.members)
      if (session.shown !== shown || versions.get(one.id) !== one.version) for (const other of this.inside) this.show(session, one, other);
    return "";
  }

  private enter(session: MockSession, voice: Voice): void {
    this.open = session;
    this.inside.add(voice);
    voice.say(session.message());
    voice.bytes(treeTable());
    for (const one of session.here.members) this.show(session, one, voice);
  }

  private tell(): void {
    const message = this.open!.message();
    for (const voice of this.inside) voice.say(message);
  }

  private show(session: MockSession, one: { id: number; version: number; quantiles: number[] }, voice: Voice): void {
    const [bytes, bred] = session.model(one);
    voice.bytes(bytes);
    voice.say(bred);
  }
}
