// Searches: their seconds, starting and stopping them.
import type { Studio } from "./studio";

/** What a search may take where the scene says nothing; the server's own default. */
export const kSecondsDefault = 2;

export class Searching {
  constructor(private readonly studio: Studio) {}

  seconds(): number {
    const seconds = this.studio.scene.value["budget"]?.["seconds"];
    return typeof seconds === "number" ? seconds : kSecondsDefault;
  }

  start(how: "new" | "onward"): void {
    const locked = (this.studio.state.shown.value?.locked.length ?? 0) > 0;
    const seconds = Math.min(86400, Math.max(0.01, this.seconds()));
    void this.studio.askAfterEdits(
      how === "onward"
        ? { kind: "start_search", seconds, onward: true }
        : { kind: "start_search", seconds, from: locked ? "shown" : "nothing" },
    );
  }

  stop(): void {
    void this.studio.ask({ kind: "stop_search" });
  }

  toggle(): void {
    if (this.studio.state.status.value.kind !== "open" || this.studio.document.value === null) return;
    if (this.studio.state.search.value?.running) this.stop();
    else this.start("new");
  }
}
