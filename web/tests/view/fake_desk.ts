// A view without drawing: the state that tools work on, and a host that writes down what it is asked for.
import type { Curve, Scene } from "../../src/api";
import type { Desk, Pointer, Under } from "../../src/view/desk";
import { Draft } from "../../src/view/draft";
import { kNoneHidden, type Hidden, type Selection, type Side, type Tool, type ViewHost } from "../../src/view/host";
import { eyeOf, type Orbit } from "../../src/view/orbit";
import type { Hover } from "../../src/view/overlay";
import type { Ink } from "../../src/view/stroke_placing";
import type { V } from "../../src/view/vec";

export type Edit = Parameters<ViewHost["edit"]>[0];

export class FakeDesk implements Desk {
  edits: Edit[] = [];
  selections: (Selection | null)[] = [];
  toolsSet: Tool[] = [];
  said: string[] = [];
  sides: Side[] = [];
  frames = 0;
  selection: Selection | null = null;
  tool: Tool = "select";
  targets = true;
  hidden: Hidden = kNoneHidden;
  orbit: Orbit = { target: [0, 1, 0], distance: 8, azimuth: 0, elevation: 0.4 };
  hover: Hover | null = null;
  ink: readonly Ink[] = [];
  snapMark: V | null = null;
  hit: Under | null = null;
  shownGenes: readonly number[] = [];
  asked = 0;
  waiting: (() => void)[] = [];
  readonly draft: Draft;
  readonly host: ViewHost = {
    paintedBefore: () => null,
    edit: (change) => {
      this.edits.push(change);
      return change.scene;
    },
    select: (selection) => this.selections.push(selection),
    setTool: (tool) => this.toolsSet.push(tool),
    newCurve: (): Omit<Curve, "points"> => ({ offset: 0.7 }),
    painter: () => () => {},
    drawn: () => {},
  };

  constructor(scene: Scene = {}) {
    this.draft = new Draft(this.host, { frame: (call) => this.waiting.push(call), later: () => () => {} }, () => {});
    this.draft.receive(scene);
  }

  eye(): ReturnType<typeof eyeOf> {
    return eyeOf(this.orbit, 800, 600);
  }

  genes(): readonly number[] {
    return this.shownGenes;
  }

  under(): Under | null {
    ++this.asked;
    return this.hit;
  }

  select(selection: Selection | null): void {
    this.selection = selection;
    this.host.select(selection);
  }

  snapSide(side: Side): void {
    this.sides.push(side);
  }

  frame(): void {
    ++this.frames;
  }

  say(words: string): void {
    this.said.push(words);
  }

  redraw(): void {}

  /** The next animation frame. */
  tick(): void {
    for (const call of this.waiting.splice(0)) call();
  }
}

export function pointer(x: number, y: number, more: Partial<Pointer> = {}): Pointer {
  return { x, y, button: 0, shift: false, ctrl: false, alt: false, pen: false, ink: [{ x, y, pressure: 0.5 }],
    ...more };
}
