// What the view and the rest of the page know of each other.
import type { Camera, Curve, Scene } from "../api";

export type Tool = "select" | "curve" | "box" | "sphere" | "cylinder" | "paint";
export type Brush = "want" | "avoid" | "erase";
export type Side = "+x" | "-x" | "+y" | "-y" | "+z" | "-z";

/** What is selected, by its place in the scene. */
export type Selection =
  | { kind: "curve"; index: number; point?: number }
  | { kind: "mesh"; index: number }
  | { kind: "gene"; gene: number };

/** What the view asks for. All of it ends up as an edit of the document. */
export type Painter = (image: Blob, camera: Camera) => void;

export interface ViewHost {
  /** The scene shall be `scene`. Edits with the same gesture in a row are one step of undo; `search`: search anew. Returns
   *  the scene that it became, which may have more to it. */
  edit(change: { label: string; gesture?: string; scene: Scene; search: boolean }): Scene;
  select(selection: Selection | null): void;
  setTool(tool: Tool): void;
  /** Settings of a curve that is drawn: those of the curve drawn or selected last. */
  newCurve(): Omit<Curve, "points">;
  /** The silhouette that painting goes on with: the selected one, or else the one of this camera; null: a new one. */
  paintedBefore(camera: Camera): { camera: Camera; url: string } | null;
  /** Takes a painted silhouette for the camera it was painted with, into the project that is open at this call. */
  painter(): Painter;
  /** The first frame with a new model was submitted: number of the model, milliseconds since it arrived. */
  drawn(model: number, milliseconds: number): void;
}

export interface Look {
  parts: boolean;
  bones: boolean;
  field: boolean;
  targets: boolean;
  ground: boolean;
  dark: boolean;
}

export interface Highlight {
  rule?: string;
  gene?: number;
  locked: number[];
}

/** Targets that are not shown, by their places in the scene. */
export interface Hidden {
  curves: readonly number[];
  meshes: readonly number[];
  silhouettes: readonly number[];
}

export const kNoneHidden: Hidden = { curves: [], meshes: [], silhouettes: [] };

/** Whether that target is among them. */
export function isHidden(hidden: Hidden, target: { kind: string; index?: number }): boolean {
  if (target.index === undefined) return false;
  return target.kind === "curve" ? hidden.curves.includes(target.index)
    : target.kind === "mesh" && hidden.meshes.includes(target.index);
}

export interface Portrait {
  /** Number of the model. */
  model: number;
  image: Blob;
}

export interface StudioView {
  /** Binary messages as they come: docs/studio-protocol.md. */
  setMeshes(message: ArrayBuffer): void;
  /** null: none, until another comes. */
  setModel(message: ArrayBuffer | null): void;
  setCloud(message: ArrayBuffer | null): void;
  setRules(names: string[]): void;
  /** `meshUrl`: where a file of the scene is to be had as a mesh. */
  setScene(scene: Scene, meshUrl: (path: string) => string): void;
  /** Targets that shall not be drawn, nor taken by the pointer or by Tab, although they count. */
  setHidden(hidden: Hidden): void;
  setSelection(selection: Selection | null): void;
  setTool(tool: Tool): void;
  setBrush(brush: Brush, radius: number): void;
  setLook(look: Look): void;
  setHighlight(highlight: Highlight): void;
  snap(side: Side): void;
  /** Moves the camera so that all is seen. */
  frame(): void;
  camera(): Camera;
  /** Whether strokes of the brush would be lost with the page. */
  readonly painting: boolean;
  /** A small picture of the parts as they are seen now, framed by themselves on nothing; null where there are none. */
  picture(): Promise<Portrait | null>;
  dispose(): void;
}
