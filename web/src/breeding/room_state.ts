// What the page knows of the breeding room, as signals. What comes from the server changes them in apply_room.ts, what a person
// does in room.ts.
import { signal } from "@preact/signals";
import type { Bred, Breeding, BreedingInfo, IndividualGenes, Lineage } from "../api";
import type { CopiedGenes } from "./copied_genes";
import type { IndividualMessage } from "./individual_message";

/** What is large beside the grid: nothing, the selected one, two to compare, a blend, or one of before. */
export type Close = { kind: "none" } | { kind: "one" } | { kind: "pairs"; pair: readonly [number, number] | null } | { kind: "blend" } | { kind: "ancestor"; id: number };
export type RoomTab = "individual" | "blend" | "lineage" | "settings";

export interface IndividualModel extends IndividualMessage {
  /** What the server said of it; comes after the model. */
  bred: Bred | null;
}

export interface BlendPlan {
  parents: readonly number[];
  /** In sum 1. */
  weights: readonly number[];
}

export function newRoomState() {
  return {
    sessions: signal<readonly BreedingInfo[]>([]),
    /** The session that this page is in. */
    breeding: signal<Breeding | null>(null),
    /** The newest models, by individual; 0 is the preview of a blend. */
    models: signal<ReadonlyMap<number, IndividualModel>>(new Map()),
    meshes: signal<ArrayBuffer | null>(null),
    genes: signal<IndividualGenes | null>(null),
    lineage: signal<Lineage | null>(null),

    selected: signal<number | null>(null),
    close: signal<Close>({ kind: "none" }),
    tab: signal<RoomTab>("individual"),
    blend: signal<BlendPlan>({ parents: [], weights: [] }),
    copied: signal<CopiedGenes | null>(null),
    /** Pairs that were compared, or passed over on this page. */
    asked: signal<ReadonlySet<string>>(new Set()),
    /** The start screen, though a session is open. */
    choosing: signal(false),
    /** A request that takes its time is on its way. */
    waiting: signal<string | null>(null),
  };
}

export type RoomState = ReturnType<typeof newRoomState>;

/** Out of the session, on the page at least. */
export function forgetSession(state: RoomState): void {
  state.breeding.value = null;
  state.models.value = new Map();
  state.meshes.value = null;
  state.genes.value = null;
  state.lineage.value = null;
  state.selected.value = null;
  state.close.value = { kind: "none" };
  state.tab.value = "individual";
  state.blend.value = { parents: [], weights: [] };
  state.asked.value = new Set();
  state.waiting.value = null;
}

export function forgetRoom(state: RoomState): void {
  forgetSession(state);
  state.sessions.value = [];
  state.copied.value = null;
  state.choosing.value = false;
}
