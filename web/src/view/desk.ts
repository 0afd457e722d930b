// What the tools know of the view: the state that they read and change, and what is under a pixel.
import type { Draft } from "./draft";
import type { Hidden, Selection, Side, Tool, ViewHost } from "./host";
import type { Eye, Orbit } from "./orbit";
import type { Hover } from "./overlay";
import type { Ink } from "./stroke_placing";
import type { V } from "./vec";

/** A pointer in pixels of the view, with the positions since the last event. */
export interface Pointer {
  x: number;
  y: number;
  button: number;
  shift: boolean;
  ctrl: boolean;
  alt: boolean;
  pen: boolean;
  ink: Ink[];
}

/** What a pressed pointer does until it is let go. */
export interface Drag {
  move(p: Pointer): void;
  /** `click`: it hardly moved. */
  end(p: Pointer, click: boolean): void;
  cancel(): void;
}

/** The nearest thing under a pixel; ghosts only where no part is. */
export type Under = { kind: "gene"; gene: number; point: V } | { kind: "mesh"; index: number; point: V };

export interface Desk {
  readonly host: ViewHost;
  readonly draft: Draft;
  readonly selection: Selection | null;
  readonly tool: Tool;
  /** Whether curves and volumes are shown. */
  readonly targets: boolean;
  /** Those of them that are not. */
  readonly hidden: Hidden;
  orbit: Orbit;
  hover: Hover | null;
  ink: readonly Ink[];
  /** Where a dragged end would snap. */
  snapMark: V | null;
  eye(): Eye;
  /** Genes that have parts, in the order of the derivation. */
  genes(): readonly number[];
  under(x: number, y: number): Under | null;
  select(selection: Selection | null): void;
  snapSide(side: Side): void;
  frame(): void;
  /** Says to those who do not see the view what happened. */
  say(words: string): void;
  redraw(): void;
}
