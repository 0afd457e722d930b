// The gene that is selected: its draws, its lock, and where it is in the next model.
import { effect } from "@preact/signals";
import { RequestFailed } from "../connection/connection";
import type { Studio } from "./studio";

/** Milliseconds to wait for the model that a draw made, before the next is set in the one before it. */
const kModelMilliseconds = 2000;

interface SetDraw {
  index: number;
  quantile: number;
  gesture: string;
}

export class Genes {
  /** Not sent yet: of each gesture the newest. */
  private draws: SetDraw[] = [];
  private underWay: Promise<void> | null = null;

  constructor(private readonly studio: Studio) {}

  /** One is on its way at a time, because each makes a new model in which the gene has another number. */
  setDraw(index: number, quantile: number, gesture: string): void {
    if (this.draws.at(-1)?.gesture === gesture) this.draws.pop();
    this.draws.push({ index, quantile, gesture });
    this.underWay ??= this.sendDraws().finally(() => {
      this.underWay = null;
    });
  }

  /** Until all that was set has been answered; null: it has. */
  get rest(): Promise<void> | null {
    return this.underWay;
  }

  private async sendDraws(): Promise<void> {
    let last: { index: number; model: number } | null = null;
    for (let next = this.draws.shift(); next !== undefined; next = this.draws.shift()) {
      if (last !== null && last.index !== next.index) await this.modelAfter(last.model);
      const gene = this.studio.state.gene.value;
      if (gene === null || !(await this.studio.ask({ kind: "set_draw", gene: gene.gene, model: gene.model, ...next }))) break;
      last = { index: next.index, model: gene.model };
    }
    this.draws = [];
  }

  /** Until the gene is known in another model. */
  private modelAfter(model: number): Promise<void> {
    return new Promise((done) => {
      const cancel = this.studio.later(kModelMilliseconds, () => end());
      const stop = effect(() => {
        if (this.studio.state.gene.value?.model !== model) end();
      });
      const end = () => {
        cancel();
        queueMicrotask(() => stop());
        done();
      };
    });
  }

  async setLock(locked: boolean): Promise<void> {
    const gene = this.studio.state.gene.value;
    if (gene === null) return;
    if (await this.studio.askAfterEdits({ kind: "set_lock", gene: gene.gene, model: gene.model, locked })) this.askAgain();
  }

  /** The gene as it is in the model that is shown now. Where that has none there, nothing is selected until one has. */
  private askAgain(): void {
    const { gene, shown, wantedPath, selection } = this.studio.state;
    const before = gene.peek();
    const model = shown.peek()?.model;
    const kind = selection.peek()?.kind;
    if (before === null || model === undefined || (kind !== undefined && kind !== "gene")) return;
    wantedPath.value = before.path;
    this.studio.connection.request({ kind: "ask_gene", path: before.path, model }).catch((error: unknown) => {
      // A model that is not there any more was followed by another, for which this is done again.
      const newest = shown.peek()?.model === model && gene.peek()?.path === before.path && gene.peek()?.model !== model;
      if (error instanceof RequestFailed && newest && selection.peek()?.kind === "gene") selection.value = null;
    });
  }

  /** A gene's number means nothing in another model: it is asked for again, by its path. */
  watch(): () => void {
    return effect(() => {
      const model = this.studio.state.shown.value?.model;
      const gene = this.studio.state.gene.peek();
      if (model !== undefined && gene !== null && gene.model !== model) this.askAgain();
    });
  }
}
