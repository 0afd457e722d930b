// All that the page knows, as signals. What it shows is a function of these; what comes from the server changes them in
// apply_message.ts, what a person does in studio.ts.
import { signal } from "@preact/signals";
import type { Checked, Document, Gene, Log, Place, ProjectInfo, Sample, SearchState, Shown } from "../api";
import type { Status } from "../connection/connection";
import { kNoneHidden, type Brush, type Hidden, type Selection, type Tool } from "../view/host";

/** The view knows nothing of selected silhouettes: they are pictures beside the model. */
export type TargetSelection = Selection | { kind: "silhouette"; index: number };

export interface LogLine extends Omit<Log, "kind" | "request"> {
  number: number;
  at: Date;
  /** Address of a picture beside it. */
  picture?: string;
}

export interface NoticeMore {
  /** Address of a picture beside it. */
  picture?: string;
  /** What can be done about it. */
  action?: { words: string; run(): void };
}

/** A word to the person that goes by itself. */
export interface Notice extends NoticeMore {
  number: number;
  text: string;
  bad: boolean;
}

/** Where the editor shall go; a new object each time. */
export interface Jump {
  at: Place;
  focus: boolean;
}

export const kLogLines = 500;

export function newState() {
  return {
    status: signal<Status>({ kind: "connecting" }),
    version: signal(""),
    projects: signal<readonly ProjectInfo[]>([]),
    samples: signal<readonly Sample[]>([]),
    /** The document as the server has it. */
    confirmed: signal<Document | null>(null),
    checked: signal<Checked | null>(null),
    /** The text that `checked` speaks of, where it is known. */
    checkedText: signal<string | null>(null),
    search: signal<SearchState | null>(null),
    shown: signal<Shown | null>(null),
    gene: signal<Gene | null>(null),
    /** Path of the gene that is asked for again in each new model; null: another was chosen, by its number. */
    wantedPath: signal<string | null>(null),
    log: signal<readonly LogLine[]>([]),
    /** The newest binary messages. */
    meshes: signal<ArrayBuffer | null>(null),
    model: signal<ArrayBuffer | null>(null),
    cloud: signal<ArrayBuffer | null>(null),
    /** Milliseconds from a model's arrival to its first frame, as the view tells. */
    drawn: signal<number | null>(null),

    selection: signal<TargetSelection | null>(null),
    tool: signal<Tool>("select"),
    brush: signal<{ brush: Brush; radius: number }>({ brush: "want", radius: 24 }),
    hidden: signal<Hidden>(kNoneHidden),
    /** The rule or detail that the cursor was put in, until Escape in the view; null: none. */
    cursorRule: signal<string | null>(null),
    jump: signal<Jump | null>(null),
    notices: signal<readonly Notice[]>([]),
    dialog: signal<"projects" | "shortcuts" | null>(null),
  };
}

export type State = ReturnType<typeof newState>;

export function addLog(state: State, level: LogLine["level"], text: string, at = new Date(), picture?: string): void {
  const number = (state.log.value.at(-1)?.number ?? 0) + 1;
  state.log.value = [...state.log.value, { number, level, text, at, ...(picture === undefined ? {} : { picture }) }].slice(-kLogLines);
}

/** Forgets what belongs to a project, before another is opened. */
export function forgetProject(state: State): void {
  state.confirmed.value = null;
  state.checked.value = null;
  state.checkedText.value = null;
  state.search.value = null;
  state.shown.value = null;
  state.gene.value = null;
  state.meshes.value = null;
  state.model.value = null;
  state.cloud.value = null;
  state.drawn.value = null;
  state.selection.value = null;
  state.cursorRule.value = null;
  state.hidden.value = kNoneHidden;
}
