// What tests put in the place of the browser and the server.
import { signal } from "@preact/signals";
import type { Checked, Document, Message, Request, Scene, Shown } from "../src/api";
import type { Socket } from "../src/connection/connection";
import { Files } from "../src/connection/files";
import { PREFERENCE_DEFAULTS } from "../src/store/preferences";
import { Studio } from "../src/store/studio";

/** A socket whose other end is the test. */
export class FakeSocket implements Socket {
  binaryType = "";
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  readonly sent: Request[] = [];

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Request);
  }
  close(): void {
    this.onclose?.();
  }
  say(message: Message | object): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
  sayBinary(data: ArrayBuffer): void {
    this.onmessage?.({ data });
  }
  kinds(): string[] {
    return this.sent.map((one) => one.kind);
  }
}

/** Time that the test moves. */
export class FakeClock {
  private time = 0;
  private timers: { at: number; action: () => void }[] = [];

  readonly now = () => this.time;

  readonly later = (milliseconds: number, action: () => void): (() => void) => {
    const timer = { at: this.time + milliseconds, action };
    this.timers.push(timer);
    return () => {
      this.timers = this.timers.filter((one) => one !== timer);
    };
  };

  advance(milliseconds: number): void {
    this.time += milliseconds;
    for (;;) {
      const due = this.timers.filter((one) => one.at <= this.time).sort((a, b) => a.at - b.at)[0];
      if (due === undefined) return;
      this.timers = this.timers.filter((one) => one !== due);
      due.action();
    }
  }

  get waiting(): number {
    return this.timers.length;
  }
}

/** Lets promises that are settled run on. */
export async function settle(): Promise<void> {
  for (let i = 0; i < 10; ++i) await Promise.resolve();
}

export function documentOf(revision: number, grammar: string, scene: Scene = {}, project = 1): Document {
  return { kind: "document", project: { id: project, name: `P${project}`, changed: 0 }, revision, grammar, scene, files: [], favourites: [] };
}

export function checkedOf(revision: number, changes: Partial<Checked> = {}): Checked {
  return { kind: "checked", revision, problems: [], symbols: [], attributes: [], ...changes };
}

export function shownOf(model: number, changes: Partial<Shown> = {}): Shown {
  return { kind: "shown", model, genes: 1, parts: 1, bones: 0, words: "", terms: [], rules: [], locked: [], truncated: false, ...changes };
}

/** A studio with a socket for each connection that it opens. */
export class Bench {
  readonly sockets: FakeSocket[] = [];
  readonly clock = new FakeClock();
  readonly preferences = signal({ ...PREFERENCE_DEFAULTS });
  readonly places: [project: number, session: number | null][] = [];
  readonly studio: Studio;

  /** `parked`: what an earlier page left there. */
  constructor(firstProject: number | null = null, firstSession: number | null = null, readonly parked = new Map<string, string>()) {
    this.studio = new Studio({
      openSocket: () => {
        const socket = new FakeSocket();
        this.sockets.push(socket);
        return socket;
      },
      files: new Files("http://127.0.0.1:1/", "t"),
      preferences: this.preferences,
      parking: {
        getItem: (key) => parked.get(key) ?? null,
        setItem: (key, text) => void parked.set(key, text),
        removeItem: (key) => void parked.delete(key),
      },
      systemDark: signal(true),
      firstProject,
      firstSession,
      onPlace: (project, session) => this.places.push([project, session]),
      later: this.clock.later,
      random: () => 1,
    });
    this.studio.connection.connect();
  }

  get socket(): FakeSocket {
    return this.sockets.at(-1)!;
  }

  sayProjects(...ids: number[]): void {
    this.socket.say({ kind: "projects", version: "1", samples: [], projects: ids.map((id) => ({ id, name: `P${id}`, changed: id })) });
  }

  /** Answers the newest request of that kind. */
  async answer(kind: Request["kind"], how: "done" | string = "done"): Promise<void> {
    const request = this.socket.sent.filter((one) => one.kind === kind).at(-1);
    if (request?.request === undefined) throw new Error(`no request ${kind}`);
    this.socket.say(how === "done" ? { kind: "done", request: request.request } : { kind: "failed", text: how, request: request.request });
    await settle();
  }

  /** Connected, with a project open. */
  async open(grammar = "grammar a 1\n", scene: Scene = {}): Promise<this> {
    this.socket.onopen?.();
    this.sayProjects(1);
    this.socket.say(documentOf(1, grammar, scene));
    this.socket.say(checkedOf(1));
    await this.answer("open_project");
    return this;
  }

  edits(): Extract<Request, { kind: "edit" }>[] {
    return this.socket.sent.filter((one) => one.kind === "edit");
  }
}
