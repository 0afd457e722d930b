// What a person can do in the breeding room.
import { batch, computed, effect, signal, type Signal } from "@preact/signals";
import type { BredGene, BredIndividual, DrawPlace, DrawSetting, Rating, RoomSettings, StartBreeding } from "../api";
import { base64Of } from "../base/base64";
import type { Ask } from "../connection/connection";
import type { Studio } from "../store/studio";
import { applyRoomBinary, applyRoomMessage, type RoomMessage } from "./apply_room";
import { nudged } from "./barycentric";
import { copyGenes, pasteGenes } from "./copied_genes";
import { NewestOnly } from "./newest_only";
import { extremes, nextPair, pairKey, ratingOfStars, stepped } from "./rating";
import { forgetRoom, forgetSession, newRoomState } from "./room_state";

const kMostParents = 3;

interface GeneEdit {
  individual: number;
  draws: DrawSetting[];
  gesture: string;
  label: string;
}

export class Room {
  readonly state = newRoomState();
  /** The page shows the room, not the model. */
  readonly here = signal(false);
  readonly individuals = computed<readonly BredIndividual[]>(() => this.state.breeding.value?.individuals ?? []);
  readonly selected = computed(() => this.individuals.value.find((one) => one.id === this.state.selected.value) ?? null);
  readonly mayRate = computed(() => ["rate_and_edit", "rate"].includes(this.state.breeding.value?.settings.mode ?? ""));
  readonly mayEdit = computed(() => ["rate_and_edit", "edit"].includes(this.state.breeding.value?.settings.mode ?? ""));
  /** The system asks for less movement: nothing turns but what a person sets turning. */
  readonly still = signal(typeof matchMedia === "function" && matchMedia("(prefers-reduced-motion: reduce)").matches);
  /** Of the grid as it stands: what the keys up and down step by. */
  columns = 1;
  /** A small picture of an individual; there where models are drawn. */
  portrait: ((id: number) => Promise<Blob | null>) | null = null;
  /** The session to be in, over lost connections too. */
  private readonly wanted: Signal<number | null>;
  /** The session that the page shows; null: the model, or none. */
  readonly place = computed(() => (this.here.value ? this.wanted.value : null));
  private inside = false;

  /** Ratings on their way: the second of two quick clicks counts from the first. */
  private readonly said = new Map<number, number | undefined>();
  private unanswered = 0;
  private picking = false;

  private readonly geneEdits = new NewestOnly<GeneEdit>(
    (edit) => this.ask({ kind: "set_genes", ...edit }),
    (before, after) => before.individual !== after.individual || before.gesture !== after.gesture ? null : {
      ...after, draws: [...before.draws.filter((one) => !after.draws.some((other) => other.gene === one.gene && other.index === one.index)), ...after.draws],
    },
  );
  private readonly settingEdits = new NewestOnly<{ settings: RoomSettings; gesture: string }>(
    (edit) => this.ask({ kind: "set_breeding", ...edit }),
    (before, after) => ({ ...after, settings: { ...before.settings, ...after.settings } }),
  );
  private readonly previews = new NewestOnly<{ parents: number[]; weights: number[] }>((plan) => this.ask({ kind: "blend", ...plan }));

  /** `first`: the session to be in as soon as its project is open; null: none, and the page begins with the model. */
  constructor(private readonly studio: Studio, first: number | null) {
    this.wanted = signal(first);
    this.here.value = first !== null;
  }

  // --- Messages -----------------------------------------------------------------------------------------------------------

  onMessage(message: RoomMessage): void {
    applyRoomMessage(this.state, message);
    if (message.kind === "breeding") {
      this.wanted.value = message.session.id;
      this.inside = true;
    } else if (message.kind === "breedings" && this.wanted.value !== null) {
      // Another page has deleted it, or the connection was lost meanwhile.
      if (!message.sessions.some((one) => one.id === this.wanted.value)) this.forget();
      else if (!this.inside && this.here.value) void this.open(this.wanted.value);
    }
  }

  onBinary(kind: string, data: ArrayBuffer): boolean {
    return applyRoomBinary(this.state, kind, data);
  }

  onLost(): void {
    this.inside = false;
    this.geneEdits.clear();
    this.previews.clear();
    this.state.waiting.value = null;
  }

  onOtherProject(): void {
    this.wanted.value = null;
    this.inside = false;
    forgetRoom(this.state);
  }

  private ask(ask: Ask): Promise<boolean> {
    if (this.studio.state.status.value.kind !== "open") {
      this.studio.tell("There is no connection to the server: nothing was changed.", true);
      return Promise.resolve(false);
    }
    return this.studio.ask(ask);
  }

  /** For what takes the session on or back: a slider's last step must not come after it. */
  private askAfterEdits(ask: Ask): Promise<boolean> {
    this.geneEdits.flush();
    this.settingEdits.flush();
    this.said.clear();
    return this.studio.askAfterEdits(ask);
  }

  /** Says what is being done, until it is. */
  private async slow(words: string, ask: Ask): Promise<boolean> {
    if (this.state.waiting.value !== null) return false;
    this.state.waiting.value = words;
    const done = await this.askAfterEdits(ask);
    this.state.waiting.value = null;
    return done;
  }

  // --- Sessions -----------------------------------------------------------------------------------------------------------

  /** To the room, or back to the model. The server makes models only for pages that are in the room. */
  go(here: boolean): void {
    this.here.value = here;
    if (this.wanted.value === null || this.studio.state.status.value.kind !== "open") return;
    if (here && !this.inside) void this.open(this.wanted.value);
    if (here || !this.inside) return;
    this.geneEdits.flush();
    this.settingEdits.flush();
    this.inside = false;
    void this.ask({ kind: "leave_breeding" });
  }

  async start(what: Omit<StartBreeding, "kind" | "request">): Promise<void> {
    forgetSession(this.state);
    if (await this.slow("Making the first generation …", { kind: "start_breeding", ...what })) this.state.choosing.value = false;
  }

  async open(session: number): Promise<void> {
    if (this.state.breeding.value !== null && this.state.breeding.value.session.id !== session) forgetSession(this.state);
    this.wanted.value = session;
    if (await this.slow("Opening …", { kind: "open_breeding", session })) this.state.choosing.value = false;
  }

  async leave(): Promise<void> {
    this.forget();
    await this.ask({ kind: "leave_breeding" });
  }

  private forget(): void {
    this.wanted.value = null;
    this.inside = false;
    forgetSession(this.state);
  }

  rename(session: number, name: string): void {
    void this.ask({ kind: "rename_breeding", session, name });
  }

  async delete(session: number): Promise<void> {
    if (session === this.wanted.value) this.forget();
    await this.ask({ kind: "delete_breeding", session });
  }

  async import(file: File): Promise<void> {
    const project = this.studio.document.value?.project.id;
    if (project === undefined) return;
    try {
      await this.open(await this.studio.files.importBreeding(project, file));
    } catch (error) {
      this.studio.tell(`${file.name} could not be imported: ${(error as Error).message}`, true);
    }
  }

  set(settings: RoomSettings, gesture: string): void {
    this.settingEdits.push({ settings, gesture });
  }

  // --- Looking ------------------------------------------------------------------------------------------------------------

  select(id: number): void {
    if (this.state.selected.value === id) return;
    batch(() => {
      this.state.selected.value = id;
      this.state.genes.value = null;
      if (this.state.close.value.kind === "ancestor") this.state.close.value = { kind: "none" };
    });
  }

  look(kind: "none" | "one" | "blend" | "pairs"): void {
    this.state.close.value = kind === "pairs" ? { kind, pair: nextPair(this.individuals.value, this.state.asked.value) } : { kind };
  }

  toggleLook(kind: "one" | "pairs"): void {
    this.look(this.state.close.value.kind === kind ? "none" : kind);
  }

  lookAtAncestor(id: number): void {
    if (this.individuals.value.some((one) => one.id === id)) return this.select(id);
    this.state.close.value = { kind: "ancestor", id };
    void this.ask({ kind: "ask_model", individual: id });
  }

  goToGeneration(generation: number): void {
    if (generation !== this.state.breeding.value?.generation) void this.slow("Going there …", { kind: "go_to_generation", generation });
  }

  // --- Rating -------------------------------------------------------------------------------------------------------------

  private rate(ratings: Rating[], label: string, gesture?: string): void {
    if (!this.mayRate.value) return this.studio.tell("This session is bred without ratings. Its settings can change that.");
    for (const { individual, rating } of ratings) this.said.set(individual, rating);
    void this.ask({ kind: "rate", ratings, label, ...(gesture === undefined ? {} : { gesture }) }).then(() => {
      if (--this.unanswered === 0) this.said.clear();
    });
    ++this.unanswered;
  }

  private rating(id: number): number | undefined {
    if (this.said.has(id)) return this.said.get(id);
    return this.individuals.value.find((one) => one.id === id)?.rating;
  }

  /** The same stars once more take them away. */
  stars(id: number, stars: number): void {
    const rating = ratingOfStars(stars);
    if (this.rating(id) === rating) this.unrate(id);
    else this.rate([{ individual: id, rating }], `${stars} stars for ${id}`);
  }

  point(id: number, by: 1 | -1): void {
    this.rate([{ individual: id, rating: stepped(this.rating(id), by) }], `Rate ${id}`);
  }

  unrate(id: number): void {
    if (this.rating(id) !== undefined) this.rate([{ individual: id }], `No rating for ${id}`);
  }

  extreme(id: number, which: "best" | "worst"): void {
    this.rate(extremes(this.individuals.value.map((one) => ({ id: one.id, rating: this.rating(one.id) })), id, which), `${id} is the ${which}`);
  }

  /** Of the two that are compared; null: neither. */
  async pick(which: 0 | 1 | null): Promise<void> {
    const { close } = this.state;
    if (close.value.kind !== "pairs" || close.value.pair === null) return;
    const [a, b] = close.value.pair;
    if (this.picking) return;
    this.picking = true;
    try {
      await this.pickOf(a, b, which);
    } finally {
      this.picking = false;
    }
  }

  private async pickOf(a: number, b: number, which: 0 | 1 | null): Promise<void> {
    const { asked } = this.state;
    if (which !== null) {
      if (!this.mayRate.value) return this.studio.tell("This session is bred without ratings. Its settings can change that.");
      if (!(await this.ask({ kind: "compare", better: which === 0 ? a : b, worse: which === 0 ? b : a }))) return;
    }
    batch(() => {
      asked.value = new Set([...asked.value, pairKey(a, b)]);
      this.look("pairs");
    });
  }

  // --- Breeding -----------------------------------------------------------------------------------------------------------

  breed(): void {
    if (this.state.breeding.value !== null) void this.slow("Breeding …", { kind: "breed" });
  }
  moreLike(id: number): void {
    void this.slow("Breeding …", { kind: "more_like_this", individual: id });
  }
  // What there is to take back the server knows: a hand may be quicker than its answers.
  undo(): void {
    if (this.state.breeding.value !== null) void this.askAfterEdits({ kind: "undo_breeding" });
  }
  redo(): void {
    if (this.state.breeding.value !== null) void this.askAfterEdits({ kind: "redo_breeding" });
  }

  async keep(id: number): Promise<void> {
    const image = (await this.portrait?.(id)) ?? null;
    const picture = image === null ? {} : { picture: await base64Of(image) };
    if (await this.ask({ kind: "keep_individual", individual: id, ...picture })) this.studio.tell(`${id} is a favourite of the project now.`);
  }

  async show(id: number): Promise<void> {
    if (await this.studio.askAfterEdits({ kind: "show_individual", individual: id })) this.go(false);
  }

  // --- Genes --------------------------------------------------------------------------------------------------------------

  setGenes(individual: number, draws: DrawSetting[], gesture: string, label: string): void {
    if (draws.length > 0) this.geneEdits.push({ individual, draws, gesture, label });
  }

  lock(draws: DrawPlace[], locked: boolean): void {
    if (draws.length > 0) void this.ask({ kind: "lock_draws", draws, locked });
  }

  copy(only?: BredGene): void {
    const genes = this.state.genes.value;
    if (genes === null) return;
    this.state.copied.value = copyGenes(genes.individual, genes.genes, only);
    this.studio.tell(only === undefined ? `The genes of ${genes.individual} are copied.` : `${only.rule} of ${genes.individual} is copied.`);
  }

  paste(only?: BredGene): void {
    const { copied, genes } = this.state;
    if (copied.value === null || genes.value === null) return;
    if (!this.mayEdit.value) return this.studio.tell("This session is bred without editing. Its settings can change that.");
    const draws = pasteGenes(copied.value, genes.value.genes, only);
    if (draws.length === 0) return this.studio.tell("Nothing to paste: no gene of these differs from what was copied.");
    void this.ask({ kind: "set_genes", individual: genes.value.individual, draws, label: `Paste genes of ${copied.value.individual}` });
  }

  // --- Blends -------------------------------------------------------------------------------------------------------------

  toggleParent(id: number): void {
    const parents = this.state.blend.value.parents;
    const next = parents.includes(id) ? parents.filter((one) => one !== id) : [...parents, id].slice(-kMostParents);
    batch(() => {
      this.state.blend.value = { parents: next, weights: next.map(() => 1 / next.length) };
      this.state.tab.value = "blend";
      if (next.length >= 2) this.look("blend");
      else if (this.state.close.value.kind === "blend") this.look("none");
    });
    this.preview();
  }

  weigh(weights: readonly number[]): void {
    this.state.blend.value = { ...this.state.blend.value, weights };
    this.preview();
  }

  nudge(corner: number, step: number): void {
    this.weigh(nudged(this.state.blend.value.weights, corner, step));
  }

  private preview(): void {
    const { parents, weights } = this.state.blend.value;
    if (parents.length >= 2) this.previews.push({ parents: [...parents], weights: [...weights] });
  }

  async keepBlend(): Promise<void> {
    const { parents, weights } = this.state.blend.value;
    if (parents.length < 2) return;
    if (!(await this.slow("Adding the blend …", { kind: "blend", parents: [...parents], weights: [...weights], keep: true }))) return;
    batch(() => {
      this.state.blend.value = { parents: [], weights: [] };
      this.look("none");
      const last = this.individuals.value.at(-1);
      if (last !== undefined) this.select(last.id);
      this.state.tab.value = "individual";
    });
  }

  // --- What follows from the state ------------------------------------------------------------------------------------------

  /** Genes of what is selected are asked for when they are looked at, and again after each change; so is the lineage. */
  watch(): () => void {
    const wanted = computed(() => {
      const one = this.selected.value;
      return one === null || !this.here.value ? "" : `${this.state.breeding.value!.session.id} ${one.id} ${one.version} ${this.locks.value}`;
    });
    const lineage = computed(() => {
      const breeding = this.state.breeding.value;
      return breeding === null || !this.here.value || this.state.tab.value !== "lineage" ? "" : `${breeding.session.id} ${breeding.revision}`;
    });
    const stops = [
      effect(() => {
        if (wanted.value === "") return;
        const individual = this.state.selected.peek()!;
        // One that is gone meanwhile is followed by another selection.
        this.studio.connection.request({ kind: "ask_individual", individual }).catch(() => undefined);
      }),
      effect(() => {
        if (lineage.value !== "") this.studio.connection.request({ kind: "ask_lineage" }).catch(() => undefined);
      }),
    ];
    return () => stops.forEach((stop) => stop());
  }

  private readonly locks = computed(() => (this.state.breeding.value?.locked ?? []).map((one) => `${one.path}:${one.index}`).join(","));
}
