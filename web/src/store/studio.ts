// What a person can do, and the state that it changes. One history for all: undo and redo are the server's.
import { batch, computed, effect, untracked, type Signal } from "@preact/signals";
import type { Camera, Curve, Document, Message, Scene } from "../api";
import { Connection, RequestFailed, type Ask, type Socket, type Status } from "../connection/connection";
import { Files, freeName } from "../connection/files";
import { isRoomMessage } from "../breeding/apply_room";
import { Room } from "../breeding/room";
import type { Look, Painter, ViewHost } from "../view/host";
import { MessageError } from "../view/messages";
import { applyBinary, applyMessage } from "./apply_message";
import { EditQueue, kTypingPause } from "./edit_queue";
import { Genes } from "./genes";
import { ParkedEdits, type Parking } from "./parked_edits";
import type { Preferences } from "./preferences";
import { Projects } from "./projects";
import {
  addSilhouette, changeSilhouette, countOf, curvesOf, duplicateTarget, FIRST_CURVE, removeTarget, sameCamera,
  silhouettesOf, withGuidedEngine, type TargetKind,
} from "./scene";
import { Searching } from "./searching";
import { stable } from "./stable";
import { addLog, newState, type NoticeMore, type TargetSelection } from "./state";
import { Visibility } from "./visibility";
import { watchReach } from "./watch_reach";

export interface StudioOptions {
  openSocket(): Socket;
  files: Files;
  preferences: Signal<Preferences>;
  /** Keeps edits over a reload. */
  parking: Parking;
  /** Whether the system wants dark. */
  systemDark: Signal<boolean>;
  /** What to open first; null: the newest project, and no session. */
  firstProject: number | null;
  firstSession: number | null;
  /** What the page shows, a project and, in the breeding room, a session of it: for the address bar. */
  onPlace(project: number, session: number | null): void;
  later(milliseconds: number, action: () => void): () => void;
  random(): number;
}

const kNoticeMilliseconds = 5000;
/** Of notices that something can be done about. */
const kOfferMilliseconds = 15000;

interface Painting {
  project: number;
  image: Blob;
  camera: Camera;
}

export class Studio implements ViewHost {
  readonly state = newState();
  private unsaved: Painting[] = [];
  readonly connection: Connection;
  readonly edits: EditQueue;
  readonly files: Files;
  readonly preferences: Signal<Preferences>;

  /** The document as a person sees it: the server's with what is on its way laid over it. */
  readonly document = computed<Document | null>(() => {
    const confirmed = this.state.confirmed.value;
    return confirmed === null ? null : { ...confirmed, ...this.edits.overlay.value };
  });
  readonly grammar = computed(() => this.document.value?.grammar ?? "");
  /** Every message of the server brings the scene anew; it is another one only when it says something else. */
  readonly scene = stable<Scene>(() => this.document.value?.scene ?? {});
  readonly dark = computed(() => {
    const theme = this.preferences.value.theme;
    return theme === "system" ? this.options.systemDark.value : theme === "dark";
  });
  readonly look = stable<Look>(() => {
    const { parts, bones, field, targets, ground } = this.preferences.value;
    return { parts, bones, field, targets, ground, dark: this.dark.value };
  });

  readonly later: StudioOptions["later"];
  readonly projects: Projects;
  readonly searching = new Searching(this);
  readonly genes = new Genes(this);
  readonly visibility = new Visibility(this);
  readonly room: Room;
  readonly parked: ParkedEdits;
  private notices = 0;

  constructor(private readonly options: StudioOptions) {
    this.later = options.later;
    this.files = options.files;
    this.preferences = options.preferences;
    this.room = new Room(this, options.firstSession);
    this.projects = new Projects(this, options.firstProject);
    this.connection = new Connection({
      open: options.openSocket,
      later: options.later,
      random: options.random,
      onStatus: (status) => this.onStatus(status),
      onMessage: (message) => this.onMessage(message),
      onBinary: (kind, data) => this.onBinary(kind, data),
      onNonsense: (text) => addLog(this.state, "warning", `The server sent ${text}.`),
    });
    this.edits = new EditQueue({
      send: (edit) => this.connection.request({ kind: "edit", ...edit }),
      onFailed: (edit, text) => this.tell(`${edit.label}: ${text}`, true),
      later: options.later,
    });
    this.parked = new ParkedEdits(this, options.parking);
  }

  // --- Connection -------------------------------------------------------------------------------------------------------

  private onStatus(status: Status): void {
    this.state.status.value = status;
    if (status.kind !== "open") this.edits.pause();
    else this.projects.expectList();
    if (status.kind !== "open") this.room.onLost();
  }

  private onMessage(message: Message): void {
    const other = message.kind === "document" && message.project.id !== (this.state.confirmed.value?.project.id ?? message.project.id);
    if (other) this.room.onOtherProject();
    if (isRoomMessage(message)) this.room.onMessage(message);
    else applyMessage(this.state, message);
    if (message.kind === "projects") this.projects.onList();
    if (message.kind === "document") this.projects.arrived(message.project.id);
  }

  private onBinary(kind: string, data: ArrayBuffer): void {
    try {
      if (!this.room.onBinary(kind, data)) applyBinary(this.state, kind, data);
    } catch (error) {
      if (!(error instanceof MessageError)) throw error;
      addLog(this.state, "error", `The server sent what cannot be shown: ${error.message}.`);
    }
  }

  /** Sends a request; tells the person when it fails. */
  async ask(ask: Ask): Promise<boolean> {
    try {
      await this.connection.request(ask);
      return true;
    } catch (error) {
      if (error instanceof RequestFailed) this.tell(error.message, true);
      return false;
    }
  }

  /** After all edits and draws that were made before it. */
  async askAfterEdits(ask: Ask): Promise<boolean> {
    if (this.genes.rest !== null) await this.genes.rest;
    this.edits.flush();
    return this.ask(ask);
  }

  /** Until the server has confirmed all that was done here; null: it has. */
  get rest(): Promise<void> | null {
    if (this.genes.rest === null && this.edits.size.value === 0) return null;
    return Promise.resolve(this.genes.rest).then(() => {
      this.edits.flush();
      return this.edits.rest();
    });
  }

  /** It goes by itself, and stands in the log. */
  tell(text: string, bad = false, more: NoticeMore = {}): void {
    const number = ++this.notices;
    this.state.notices.value = [...this.state.notices.value, { number, text, bad, ...more }].slice(-3);
    addLog(this.state, bad ? "error" : "info", text, new Date(), more.picture);
    this.options.later(more.action === undefined ? kNoticeMilliseconds : kOfferMilliseconds, () => this.unsay(number));
  }

  unsay(notice: number): void {
    this.state.notices.value = this.state.notices.value.filter(({ number }) => number !== notice);
  }

  // --- Editing ----------------------------------------------------------------------------------------------------------

  /** Of the grammar, while typing: sent when the keys rest. */
  type(grammar: string, gesture: string, rule: string | null): void {
    if (this.state.confirmed.value === null) return;
    this.edits.push({ label: rule === null ? "Edit grammar" : `Edit ${rule}`, gesture, grammar, search: this.live() }, kTypingPause);
  }

  setGrammar(label: string, grammar: string): void {
    if (this.state.confirmed.value === null) return;
    this.edits.push({ label, grammar, search: this.live() });
  }

  setScene(label: string, scene: Scene, gesture?: string): void {
    if (this.state.confirmed.value === null) return;
    this.edits.push({ label, scene, search: this.live(), ...(gesture === undefined ? {} : { gesture }) });
  }

  private live(): boolean {
    return this.preferences.value.live;
  }

  undo(): Promise<boolean> {
    return this.askAfterEdits({ kind: "undo" });
  }
  redo(): Promise<boolean> {
    return this.askAfterEdits({ kind: "redo" });
  }
  format(): void {
    void this.askAfterEdits({ kind: "format" });
  }

  removeTarget(kind: TargetKind, index: number): void {
    batch(() => {
      this.visibility.removed(kind, index);
      this.setScene(`Delete ${kind} ${index + 1}`, removeTarget(this.scene.value, kind, index));
      this.select(null);
    });
  }

  duplicateTarget(kind: TargetKind, index: number): void {
    batch(() => {
      this.setScene(`Duplicate ${kind} ${index + 1}`, duplicateTarget(this.scene.value, kind, index));
      this.select({ kind, index: countOf(this.scene.value, kind) - 1 });
    });
  }

  async dropFavourite(favourite: number): Promise<void> {
    if (!(await this.ask({ kind: "drop_favourite", favourite }))) return;
    const run = () => void this.ask({ kind: "restore_favourite", favourite });
    this.tell("A favourite was dropped.", false, { action: { words: "Take it back", run } });
  }

  /** The name that the file got, or null. */
  async addFile(name: string, content: Blob): Promise<string | null> {
    const document = this.document.value;
    if (document === null) return null;
    const free = freeName(name, document.files.map((file) => file.path));
    try {
      await this.files.upload(document.project.id, free, content);
      return free;
    } catch (error) {
      this.tell(`${name} could not be added: ${(error as Error).message}`, true);
      return null;
    }
  }

  setPreferences(changes: Partial<Preferences>): void {
    this.preferences.value = { ...this.preferences.value, ...changes };
  }

  // --- What the view asks for -------------------------------------------------------------------------------------------

  edit(change: { label: string; gesture?: string; scene: Scene; search: boolean }): Scene {
    if (this.state.confirmed.value === null) return change.scene;
    const scene = withGuidedEngine(this.scene.value, change.scene);
    this.edits.push({ ...change, scene, search: change.search && this.live() });
    return scene;
  }

  select(selection: TargetSelection | null): void {
    this.state.selection.value = selection;
    const model = this.state.shown.value?.model;
    if (selection?.kind === "gene") {
      this.state.wantedPath.value = null;
      if (model !== undefined) void this.ask({ kind: "ask_gene", gene: selection.gene, model });
    } else this.state.gene.value = null;
  }

  setTool(tool: Studio["state"]["tool"]["value"]): void {
    this.state.tool.value = tool;
  }

  newCurve(): Omit<Curve, "points"> {
    const curves = curvesOf(this.scene.value);
    const selection = this.state.selection.value;
    const curve = (selection?.kind === "curve" ? curves[selection.index] : undefined) ?? curves.at(-1);
    if (curve === undefined) return FIRST_CURVE;
    const { points: _, ...settings } = curve;
    return settings;
  }

  paintedBefore(camera: Camera): { camera: Camera; url: string } | null {
    const project = this.document.value?.project.id;
    const silhouettes = silhouettesOf(this.scene.value);
    const selection = this.state.selection.value;
    const selected = selection?.kind === "silhouette" ? silhouettes[selection.index] : undefined;
    const found = selected?.camera?.eye !== undefined ? selected : silhouettes.find((one) => sameCamera(one.camera, camera));
    if (project === undefined || found?.image === undefined) return null;
    return { camera: found.camera!, url: this.files.url(project, found.image) };
  }

  painter(): Painter {
    const project = this.document.value?.project.id;
    return (image, camera) => {
      if (project !== undefined) void this.addPainted({ project, image, camera });
    };
  }

  /** Whether something that was painted waits for the server. */
  get hasUnsaved(): boolean {
    return this.unsaved.length > 0;
  }

  /** What could not be sent is sent when the server is back, in the project that it was painted in. */
  private async sendUnsaved(project: number): Promise<void> {
    const mine = this.unsaved.filter((one) => one.project === project);
    this.unsaved = this.unsaved.filter((one) => one.project !== project);
    for (const painting of mine) await this.addPainted(painting);  // each finds a free name
  }

  private async addPainted(painting: Painting): Promise<void> {
    const { project, image, camera } = painting;
    const file = this.document.value?.project.id === project ? await this.addFile("painted.png", image) : null;
    if (file === null || this.document.value?.project.id !== project) {
      this.unsaved.push(painting);
      return;
    }
    const before = this.scene.value;
    const index = silhouettesOf(before).findIndex((silhouette) => sameCamera(silhouette.camera, camera));
    const scene = index >= 0
      ? changeSilhouette(before, index, { image: file, want_image: undefined, avoid_image: undefined })
      : addSilhouette(before, { image: file, view: "parts", camera });
    this.setScene("Paint silhouette", scene);
    this.select({ kind: "silhouette", index: index >= 0 ? index : silhouettesOf(scene).length - 1 });
  }

  drawn(_model: number, milliseconds: number): void {
    this.state.drawn.value = milliseconds;
  }

  /** Keeps what follows from the state itself; call once. */
  watch(): () => void {
    const project = computed(() => this.state.confirmed.value?.project.id);
    const place = effect(() => {
      if (project.value !== undefined) this.options.onPlace(project.value, this.room.place.value);
    });
    const here = computed(() => (this.state.status.value.kind === "open" ? project.value : undefined));
    const paintings = effect(() => {
      if (here.value !== undefined) void untracked(() => this.sendUnsaved(here.value!));
    });
    const stops = [place, paintings, this.genes.watch(), this.visibility.watch(), this.room.watch(), this.parked.watch(), watchReach(this, this.options.later)];
    return () => stops.forEach((stop) => stop());
  }
}
