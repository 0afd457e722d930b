// Which targets are hidden. A target has no name, only a place in a list: what is hidden goes along when edits, undo or
// other tabs move it, and is found again by what it says.
import { batch, effect } from "@preact/signals";
import type { Hidden } from "../view/host";
import { curvesOf, meshesOf, silhouettesOf, type TargetKind } from "./scene";
import type { Studio } from "./studio";

const kKinds = ["curve", "mesh", "silhouette"] as const;
const kKeys = { curve: "curves", mesh: "meshes", silhouette: "silhouettes" } as const satisfies Record<TargetKind, keyof Hidden>;

/** For each item of `after` its place in `before`, or -1 for a new one: equal items first, what is left over in order. */
export function followed(before: readonly string[], after: readonly string[]): number[] {
  const places = after.map(() => -1);
  const left = new Set(before.keys());
  const pair = (now: number, then: number) => {
    places[now] = then;
    left.delete(then);
  };
  const short = Math.min(before.length, after.length);
  let head = 0;
  while (head < short && before[head] === after[head]) pair(head, head++);
  for (let tail = 1; tail <= short - head && before.at(-tail) === after.at(-tail); ++tail) pair(after.length - tail, before.length - tail);
  after.forEach((item, now) => {
    if (places[now] !== -1) return;
    const same = [...left].find((then) => before[then] === item);
    if (same !== undefined) pair(now, same);
  });
  // As many left on both sides were changed where they stand; else some came or went, and nobody knows which.
  const unknown = [...places.keys()].filter((now) => places[now] === -1);
  if (unknown.length === left.size) [...left].forEach((then, i) => pair(unknown[i]!, then));
  return places;
}

export class Visibility {
  private project: number | undefined;
  private before: Record<TargetKind, string[]> = { curve: [], mesh: [], silhouette: [] };
  /** Hidden targets that went: undo may bring them back. */
  private gone = new Set<string>();

  constructor(private readonly studio: Studio) {}

  isHidden(kind: TargetKind, index: number): boolean {
    return this.studio.state.hidden.value[kKeys[kind]].includes(index);
  }

  toggle(kind: TargetKind, index: number): void {
    const hidden = this.studio.state.hidden.value;
    const list = hidden[kKeys[kind]];
    this.studio.state.hidden.value = { ...hidden, [kKeys[kind]]: list.includes(index) ? list.filter((i) => i !== index) : [...list, index] };
  }

  /** That target is being deleted: among equal ones this one. */
  removed(kind: TargetKind, index: number): void {
    const { hidden } = this.studio.state;
    const list = hidden.peek()[kKeys[kind]];
    const [item] = this.before[kind].splice(index, 1);
    if (list.includes(index)) this.gone.add(`${kind} ${item}`);
    hidden.value = { ...hidden.peek(), [kKeys[kind]]: list.filter((i) => i !== index).map((i) => (i > index ? i - 1 : i)) };
  }

  watch(): () => void {
    const { studio } = this;
    return effect(() => {
      const project = studio.document.value?.project.id;
      const scene = studio.scene.value;
      const now: Record<TargetKind, string[]> = {
        curve: curvesOf(scene).map((item) => JSON.stringify(item)),
        mesh: meshesOf(scene).map((item) => JSON.stringify(item)),
        silhouette: silhouettesOf(scene).map((item) => JSON.stringify(item)),
      };
      if (project !== this.project) this.gone.clear();
      else batch(() => kKinds.forEach((kind) => this.follow(kind, now[kind])));
      this.project = project;
      this.before = now;
    });
  }

  private follow(kind: TargetKind, now: readonly string[]): void {
    const { hidden } = this.studio.state;
    const was = hidden.peek()[kKeys[kind]];
    if (was.length === 0 && this.gone.size === 0) return;
    const places = followed(this.before[kind], now);
    for (const index of was) if (!places.includes(index)) this.gone.add(`${kind} ${this.before[kind][index]}`);
    const is = places.flatMap((then, index) => (then >= 0 ? was.includes(then) : this.gone.delete(`${kind} ${now[index]}`)) ? [index] : []);
    if (is.length !== was.length || is.some((index, i) => was[i] !== index)) hidden.value = { ...hidden.peek(), [kKeys[kind]]: is };
  }
}
