// Edits that wait while the server is away, kept over a reload: they are sent as soon as their project is open again.
import { effect } from "@preact/signals";
import type { DocumentEdit } from "./edit_queue";
import type { Studio } from "./studio";

/** Of one page: other tabs see nothing of it. */
export type Parking = Pick<Storage, "getItem" | "setItem" | "removeItem">;

interface Parked {
  project: number;
  edits: DocumentEdit[];
}

const kKey = "espalier-studio-edits";

export class ParkedEdits {
  /** Of before the reload, until their project is open. */
  private found: Parked | null;

  constructor(private readonly studio: Studio, private readonly parking: Parking) {
    this.found = this.read();
  }

  /** The project is open: what had waited for it before a reload goes on waiting in the queue. */
  opened(project: number): void {
    if (this.found?.project !== project) return;
    const { edits } = this.found;
    this.found = null;
    for (const edit of edits) this.studio.edits.push(edit);
  }

  watch(): () => void {
    return effect(() => {
      const edits = this.studio.edits.waiting.value;
      const project = this.studio.state.confirmed.value?.project.id;
      const away = this.studio.state.status.value.kind !== "open";
      if (this.found !== null) return;
      // What is sent already, and may have been taken back since, is not sent once more.
      const parked: Parked | null = away && project !== undefined && edits.length > 0 ? { project, edits: [...edits] } : null;
      try {
        if (parked === null) this.parking.removeItem(kKey);
        else this.parking.setItem(kKey, JSON.stringify(parked));
      } catch {
        // Full or forbidden.
      }
    });
  }

  private read(): Parked | null {
    try {
      const parked = JSON.parse(this.parking.getItem(kKey) ?? "null") as Parked | null;
      return typeof parked?.project === "number" && Array.isArray(parked.edits) ? parked : null;
    } catch {
      return null;
    }
  }
}
