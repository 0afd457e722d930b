// Edits on their way to the server. Each holds the whole new grammar or scene, so what the page shows is what the server
// confirmed with these laid over it, and sending one again after a lost connection does no harm.
import { computed, effect, signal } from "@preact/signals";
import type { Scene } from "../api";
import { ConnectionLost } from "../connection/connection";

/** Milliseconds without a key before typed text is sent. */
export const kTypingPause = 150;

export interface DocumentEdit {
  label: string;
  gesture?: string;
  grammar?: string;
  scene?: Scene;
  search?: boolean;
}

interface Entry {
  edit: DocumentEdit;
  state: "held" | "ready" | "sent";
}

export interface EditQueueOptions {
  send(edit: DocumentEdit): Promise<void>;
  onFailed(edit: DocumentEdit, text: string): void;
  later(milliseconds: number, action: () => void): () => void;
}

export class EditQueue {
  private readonly entries = signal<readonly Entry[]>([]);
  private paused = true;
  private cancelHold: (() => void) | null = null;

  /** The newest grammar and scene that the server has not confirmed. */
  readonly overlay = computed(() => {
    const out: { grammar?: string; scene?: Scene } = {};
    for (const { edit } of this.entries.value) {
      if (edit.grammar !== undefined) out.grammar = edit.grammar;
      if (edit.scene !== undefined) out.scene = edit.scene;
    }
    return out;
  });
  /** All that the server has not confirmed, oldest first. */
  readonly waiting = computed<readonly DocumentEdit[]>(() => this.entries.value.map((entry) => entry.edit));
  readonly size = computed(() => this.entries.value.length);

  constructor(private readonly options: EditQueueOptions) {}

  /** `hold`: milliseconds to wait for more of the same gesture before it is sent. One edit is on its way at a time; what comes
   *  meanwhile of one gesture becomes one edit, so dragging never piles up. */
  push(edit: DocumentEdit, hold = 0): void {
    const entries = this.entries.value.map((entry) => entry);
    const last = entries.at(-1);
    if (last && last.state !== "sent" && edit.gesture !== undefined && last.edit.gesture === edit.gesture) {
      const search = Boolean(last.edit.search) || Boolean(edit.search);
      entries[entries.length - 1] = { edit: { ...last.edit, ...edit, search }, state: hold > 0 ? "held" : "ready" };
    } else {
      for (let i = 0; i < entries.length; ++i)
        if (entries[i]!.state === "held") entries[i] = { edit: entries[i]!.edit, state: "ready" };
      entries.push({ edit, state: hold > 0 ? "held" : "ready" });
    }
    this.entries.value = entries;
    this.cancelHold?.();
    this.cancelHold = hold > 0 ? this.options.later(hold, () => this.release()) : null;
    this.pump(1);
  }

  /** Sends all at once: what follows (undo, format) is about the text as it stands. */
  flush(): void {
    this.release();
    this.pump(Infinity);
  }

  /** Until nothing waits and all was answered. */
  rest(): Promise<void> {
    return new Promise((done) => {
      const stop = effect(() => {
        if (this.size.value > 0) return;
        queueMicrotask(() => stop());
        done();
      });
    });
  }

  /** The connection is there and the project is open. */
  resume(): void {
    this.paused = false;
    this.release();
  }

  pause(): void {
    this.paused = true;
  }

  clear(): void {
    this.entries.value = [];
    this.cancelHold?.();
    this.cancelHold = null;
  }

  private release(): void {
    this.cancelHold?.();
    this.cancelHold = null;
    if (this.entries.value.some((entry) => entry.state === "held"))
      this.entries.value = this.entries.value.map((entry) =>
        entry.state === "held" ? { edit: entry.edit, state: "ready" } : entry,
      );
    this.pump(1);
  }

  private pump(most: number): void {
    if (this.paused) return;
    let under_way = this.entries.value.filter((entry) => entry.state === "sent").length;
    for (const entry of this.entries.value) {
      if (entry.state === "held" || under_way >= most) break;
      if (entry.state === "sent") continue;
      entry.state = "sent";
      under_way += 1;
      this.options.send(entry.edit).then(
        () => this.finish(entry),
        (error: unknown) => this.refused(entry, error),
      );
    }
  }

  private finish(entry: Entry): void {
    this.entries.value = this.entries.value.filter((other) => other !== entry);
    this.pump(1);
  }

  private refused(entry: Entry, error: unknown): void {
    if (error instanceof ConnectionLost) {
      entry.state = "ready"; // Sent again when the project is open again.
      return;
    }
    this.finish(entry);
    this.options.onFailed(entry.edit, error instanceof Error ? error.message : String(error));
  }
}
