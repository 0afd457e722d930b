// The scene as the view shows it: the document's, with what is being dragged. Edits go out once per animation frame
// under one gesture; what comes back meanwhile is older than what is shown, and waits.
import type { Scene } from "../api";
import { uniqueName } from "../base/unique_name";
import type { ViewHost } from "./host";

export interface Clock {
  /** Calls once before the next frame. */
  frame(call: () => void): void;
  /** Calls once after milliseconds; returns how to take it back. */
  later(call: () => void, milliseconds: number): () => void;
}

const kPatience = 400;

/** Whether two values of JSON say the same; the order of keys says nothing. */
export function same(a: unknown, b: unknown): boolean {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null ||
    Array.isArray(a) !== Array.isArray(b)) return false;
  const one = a as Record<string, unknown>, two = b as Record<string, unknown>, keys = Object.keys(one);
  return keys.length === Object.keys(two).length && keys.every((key) => key in two && same(one[key], two[key]));
}

interface Gesture {
  id: string;
  label: string;
  before: Scene;
  /** What is shown and was not sent, as a change of `before`. */
  preview: ((scene: Scene) => Scene) | null;
  dirty: boolean;
  sent: boolean;
}

export class Draft {
  scene: Scene = {};
  private gesture: Gesture | null = null;
  private held: Scene | null = null;
  /** What went out last, until it came back. */
  private awaited: Scene | null = null;
  private giveUp: (() => void) | null = null;

  constructor(
    private readonly host: Pick<ViewHost, "edit">, private readonly clock: Clock,
      private readonly changed: () => void) {}

  get busy(): boolean {
    return this.gesture !== null;
  }

  /** The document's scene, whenever it changed. */
  receive(scene: Scene): void {
    if (this.awaited && same(scene, this.awaited)) this.settle();
    this.held = scene;
    this.release();
  }

  newGesture(): string {
    return uniqueName("view");
  }

  begin(label: string, id = this.newGesture()): void {
    this.end();
    this.gesture = { id, label, before: this.scene, preview: null, dirty: false, sent: false };
  }

  /** Shown, not sent: laid over the document, and over whatever it becomes until the change is sent. */
  preview(change: (scene: Scene) => Scene): void {
    if (!this.gesture) return;
    this.gesture.preview = change;
    this.scene = change(this.gesture.before);
    this.changed();
  }

  /** Shown at once, sent with the next frame. */
  change(scene: Scene): void {
    const { gesture } = this;
    if (!gesture) return;
    gesture.preview = null;
    this.scene = scene;
    this.changed();
    if (gesture.dirty) return;
    gesture.dirty = true;
    this.clock.frame(() => this.flush(gesture));
  }

  end(): void {
    if (!this.gesture) return;
    this.flush(this.gesture);
    this.gesture = null;
    this.release();
  }

  /** As if the gesture had not been. */
  cancel(): void {
    const { gesture } = this;
    if (!gesture) return;
    this.gesture = null;
    gesture.dirty = false;
    this.scene = gesture.before;
    if (gesture.sent) this.send(gesture.label, gesture.id, this.scene);
    else this.release();
    this.changed();
  }

  /** One edit by itself. */
  once(label: string, scene: Scene, gesture?: string): void {
    this.end();
    this.scene = scene;
    this.send(label, gesture, scene);
    this.changed();
  }

  private flush(gesture: NonNullable<Draft["gesture"]>): void {
    if (!gesture.dirty) return;
    gesture.dirty = false;
    gesture.sent = true;
    this.send(gesture.label, gesture.id, this.scene);
  }

  private send(label: string, gesture: string | undefined, scene: Scene): void {
    this.awaited = scene;
    this.held = null;
    this.giveUp?.();
    this.giveUp = this.clock.later(() => this.settle(), kPatience);
    const taken = this.host.edit({ label, ...(gesture === undefined ? {} : { gesture }), scene, search: true });
    if (taken === scene || this.awaited !== scene) return;
    // The page has added something to it, which the next change must not take away.
    this.scene = this.awaited = taken;
    if (this.held && same(this.held, taken)) this.settle();
  }

  /** No answer is awaited any more. */
  private settle(): void {
    this.giveUp?.();
    this.giveUp = null;
    this.awaited = null;
    this.release();
  }

  private release(): void {
    const { gesture, held } = this;
    if (!held || this.awaited !== null || (gesture && !gesture.preview)) return;
    this.held = null;
    if (gesture) gesture.before = held;
    this.scene = gesture?.preview?.(held) ?? held;
    this.changed();
  }
}
