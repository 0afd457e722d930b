// The gene that is selected: its draws, its lock, and where it is in the next model.
import { effect } from "@preact/signals";
import { RequestFailed } from "../connection/connection";
import type { Studio } from "./studio";

export class Genes {
  private nextDraw: { index: number; quantile: number; gesture: string } | null = null;
  private drawUnderWay = false;

  constructor(private readonly studio: Studio) {}

  /** One is on its way at a time, because each makes a new model in which the gene has another number; then the newest. */
  setDraw(index: number, quantile: number, gesture: string): void {
    this.nextDraw = { index, quantile, gesture };
    if (!this.drawUnderWay) void this.sendDraws();
  }

  private async sendDraws(): Promise<void> {
    this.drawUnderWay = true;
    for (let next = this.nextDraw; next !== null; next = this.nextDraw) {
      this.nextDraw = null;
      const gene = this.studio.state.gene.value;
      if (gene === null || !(await this.studio.ask({ kind: "set_draw", gene: gene.gene, model: gene.model, ...next }))) break;
    }
    this.nextDraw = null;
    this.drawUnderWay = false;
  }

  async setLock(locked: boolean): Promise<void> {
    const gene = this.studio.state.gene.value;
    if (gene === null) return;
    if (await this.studio.ask({ kind: "set_lock", gene: gene.gene, model: gene.model, locked })) this.askAgain();
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
