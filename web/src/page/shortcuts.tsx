// Keys of the page: the same list is the sheet that `?` shows.
import { RoomKeys } from "../breeding/room_keys_sheet";
import { roomKeyFor, whereOf } from "../breeding/room_keys";
import { runRoomAction } from "../breeding/run_action";
import type { Side, Tool } from "../view/host";
import type { Studio } from "../store/studio";
import { countOf } from "../store/scene";
import { Dialog } from "../shell/dialog";
import { keepFavourite } from "../panels/keep_favourite";
import { useStudio } from "../shell/studio_context";
import { currentView } from "../shell/view_access";

export interface Shortcut {
  /** As a KeyboardEvent has it: "z", "F8", "?". */
  key: string;
  mod?: boolean;
  shift?: boolean;
  words: string;
  group: string;
  /** Also while text is typed. */
  everywhere?: boolean;
  /** Not on the sheet: another key for the same. */
  unlisted?: boolean;
  run?(studio: Studio): void;
}

const tool = (key: string, name: Tool, words: string): Shortcut => ({ key, words, group: "Tools", run: (studio) => studio.setTool(name) });
const side = (key: string, shift: boolean, name: Side, words: string): Shortcut => ({
  key, shift, words, group: "View", run: () => currentView.value?.snap(name),
});
const toggle = (key: string, name: "parts" | "bones" | "field" | "targets" | "ground" | "reach", words: string): Shortcut => ({
  key, words, group: "View", run: (studio) => studio.setPreferences({ [name]: !studio.preferences.value[name] }),
});

function onSelected(studio: Studio, action: "removeTarget" | "duplicateTarget"): void {
  const selection = studio.state.selection.value;
  if (selection !== null && selection.kind !== "gene") studio[action](selection.kind, selection.index);
}

/** The next or previous target. */
function stepTarget(studio: Studio, step: 1 | -1): void {
  const scene = studio.scene.value;
  const all = (["curve", "mesh", "silhouette"] as const).flatMap((kind) =>
    Array.from({ length: countOf(scene, kind) }, (_, index) => ({ kind, index })),
  );
  if (all.length === 0) return;
  const now = studio.state.selection.value;
  const at = all.findIndex((one) => now !== null && now.kind === one.kind && now.index === one.index);
  studio.select(all[at < 0 ? (step > 0 ? 0 : all.length - 1) : (at + step + all.length) % all.length]!);
}

export const SHORTCUTS: readonly Shortcut[] = [
  { key: "z", mod: true, words: "Undo, whatever it was", group: "Editing", everywhere: true, run: (studio) => studio.undo() },
  { key: "z", mod: true, shift: true, words: "Redo", group: "Editing", everywhere: true, run: (studio) => studio.redo() },
  { key: "y", mod: true, words: "Redo", group: "Editing", unlisted: true, everywhere: true, run: (studio) => studio.redo() },
  { key: "d", mod: true, words: "Duplicate the selected target", group: "Editing", run: (studio) => onSelected(studio, "duplicateTarget") },
  { key: "Delete", words: "Delete the selected target", group: "Editing", run: (studio) => onSelected(studio, "removeTarget") },
  { key: "Backspace", words: "Delete the selected target", group: "Editing", unlisted: true, run: (studio) => onSelected(studio, "removeTarget") },
  { key: "]", words: "Select the next target", group: "Editing", run: (studio) => stepTarget(studio, 1) },
  { key: "[", words: "Select the target before", group: "Editing", run: (studio) => stepTarget(studio, -1) },
  { key: "Escape", words: "Select nothing, light no rule; the select tool", group: "Editing", run: (studio) => {
    studio.state.cursorRule.value = null;
    studio.setTool("select");
    studio.select(null);
  } },
  tool("v", "select", "Select and move"),
  tool("c", "curve", "Draw a curve"),
  tool("b", "box", "Place a box"),
  tool("o", "sphere", "Place a sphere"),
  tool("u", "cylinder", "Place a cylinder"),
  tool("p", "paint", "Paint a silhouette"),
  { key: "f", words: "See all of it", group: "View", run: () => currentView.value?.frame() },
  side("1", false, "+z", "From the front"),
  side("1", true, "-z", "From behind"),
  side("3", false, "+x", "From the right"),
  side("3", true, "-x", "From the left"),
  side("7", false, "+y", "From above"),
  side("7", true, "-y", "From below"),
  toggle("g", "ground", "Ground"),
  toggle("m", "parts", "Model"),
  toggle("j", "bones", "Bones"),
  toggle("w", "field", "Field of directions"),
  toggle("t", "targets", "Targets"),
  toggle("h", "reach", "Where the rule under the cursor can reach"),
  // What the view itself understands while it has the focus: see view/keys.ts.
  { key: "Tab", words: "The next curve, point or volume; with Shift the one before", group: "In the view" },
  { key: "Arrows", words: "Turn the camera, or move what is selected", group: "In the view" },
  { key: "Arrows", shift: true, words: "Shift the view, or move what is selected tenfold", group: "In the view" },
  { key: "PageUp, PageDown", words: "Move what is selected away or nearer", group: "In the view" },
  { key: "+, -", words: "Nearer, farther", group: "In the view" },
  { key: ", .", words: "The part before, the next part; of a volume: smaller, larger", group: "In the view" },
  { key: "Insert, N", words: "Add a curve or a volume, as the tool says", group: "In the view" },
  { key: "X, Y, Z", words: "A volume longer along an axis; with Shift shorter", group: "In the view" },
  { key: "R", words: "Turn a volume; with Shift the other way", group: "In the view" },
  { key: "Arrow keys", words: "Move the brush; with Shift paint; Ctrl-Z takes strokes back", group: "While painting" },
  { key: "Enter, Escape", words: "Done: the silhouette is a target", group: "While painting" },
  { key: " ", words: "Start or stop the search", group: "Search", run: (studio) => studio.searching.toggle() },
  { key: "k", words: "Keep the model as a favourite", group: "Search", run: (studio) => void keepFavourite(studio) },
  { key: "l", words: "Lock or free the selected gene", group: "Search", run: (studio) => {
    const gene = studio.state.gene.value;
    if (gene !== null && studio.state.selection.value?.kind === "gene") void studio.genes.setLock(!gene.locked);
  } },
  { key: "s", mod: true, words: "Format the grammar (all is saved as you go)", group: "Grammar", everywhere: true, run: (studio) => studio.format() },
  { key: "F8", words: "Next problem", group: "Grammar" },
  { key: "F12", words: "Go to the definition (or Ctrl-click)", group: "Grammar" },
  { key: "/", mod: true, words: "Comment lines", group: "Grammar" },
  { key: "f", mod: true, words: "Find and replace", group: "Grammar" },
  { key: " ", mod: true, words: "Complete", group: "Grammar" },
  { key: "o", mod: true, words: "Projects", group: "Page", everywhere: true, run: (studio) => {
    studio.state.dialog.value = "projects";
  } },
  { key: "e", mod: true, words: "To the grammar and back to the view", group: "Page", everywhere: true, run: () => switchFocus() },
  { key: "b", mod: true, words: "To the breeding room and back", group: "Page", everywhere: true, run: (studio) => studio.room.go(!studio.room.here.value) },
  { key: "?", words: "This sheet", group: "Page", run: (studio) => {
    studio.state.dialog.value = "shortcuts";
  } },
];

function switchFocus(): void {
  const editor = document.querySelector(".grammar-editor")?.shadowRoot?.querySelector<HTMLElement>(".cm-content");
  const view = document.querySelector<HTMLElement>(".view-element");
  if (document.activeElement?.shadowRoot?.activeElement === editor) view?.focus();
  else editor?.focus();
}

const kTextual = new Set(["text", "search", "number", ""]);

/** Whether keys are text there. */
export function takesText(target: EventTarget | null | undefined): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target.tagName === "TEXTAREA" || target.tagName === "SELECT") return true;
  return target.tagName === "INPUT" && kTextual.has((target as HTMLInputElement).type);
}

/** Keys that the focused thing itself understands: Space presses a button, Enter too, arrows move a slider. */
function takesSpace(target: EventTarget | null | undefined): boolean {
  return target instanceof HTMLElement && target.matches("button, a, input, summary, [role=tab], [role=menuitem]");
}

export type KeyPress = Pick<KeyboardEvent, "key" | "code" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

export function shortcutFor(event: KeyPress, inText: boolean): Shortcut | undefined {
  if (event.altKey) return undefined;
  const mod = event.ctrlKey || event.metaKey;
  // With Shift a digit is another letter, which one depends on the keyboard; a number pad has them with and without.
  const digit = /^(?:Digit|Numpad)(\d)$/.exec(event.code)?.[1];
  const key = (event.shiftKey ? digit : undefined) ?? (event.key.length === 1 ? event.key.toLowerCase() : event.key);
  return SHORTCUTS.find(
    (one) => one.run !== undefined && one.key === key && Boolean(one.mod) === mod && (!inText || one.everywhere) &&
      (Boolean(one.shift) === event.shiftKey || (one.shift === undefined && !one.mod && /[^a-z]/.test(key))),
  );
}

export function listenForShortcuts(studio: Studio): () => void {
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]") !== null) return;
    const target = event.composedPath()[0];
    const here = studio.room.here.value;
    if (here && studio.room.state.breeding.value !== null && !studio.room.state.choosing.value) {
      const action = roomKeyFor(event, whereOf(target, takesText(target)), studio.room.state.close.value.kind === "pairs");
      if (action !== null) {
        event.preventDefault();
        // A key that is held steps on and on; it does not breed, choose or rate again and again.
        if (event.repeat && !["step", "undo", "redo", "point"].includes(action.do)) return;
        return runRoomAction(studio, action);
      }
    }
    if (event.key === " " && takesSpace(target)) return;
    const shortcut = shortcutFor(event, takesText(target));
    // In the room only what belongs to the page as a whole.
    if (shortcut === undefined || (here && shortcut.group !== "Page")) return;
    event.preventDefault();
    shortcut.run!(studio);
  };
  window.addEventListener("keydown", onKeyDown);
  return () => window.removeEventListener("keydown", onKeyDown);
}

export function keyNames(shortcut: Shortcut): string[] {
  const key = shortcut.key === " " ? "Space" : shortcut.key.length === 1 ? shortcut.key.toUpperCase() : shortcut.key;
  return [...(shortcut.mod ? ["Ctrl"] : []), ...(shortcut.shift ? ["Shift"] : []), key];
}

export function ShortcutsDialog({ onClose }: { onClose(): void }) {
  const here = useStudio().room.here.value;
  const groups = [...new Set(SHORTCUTS.map((one) => one.group))].filter((group) => !here || group === "Page");
  return (
    <Dialog title="Keys" kind="shortcuts" onClose={onClose}>
      <div class="shortcut-groups" tabIndex={0} role="group" aria-label="All keys">
        {groups.map((group) => (
          <section key={group} aria-label={group}>
            <h3>{group}</h3>
            <dl>
              {SHORTCUTS.filter((one) => one.group === group && !one.unlisted).map((one, i) => (
                <div key={i}>
                  <dt>{keyNames(one).map((name) => <kbd key={name}>{name}</kbd>)}</dt>
                  <dd>{one.words}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
        {here && <RoomKeys />}
        <section aria-label="Numbers">
          <h3>Numbers and sliders</h3>
          <dl>
            <div><dt><kbd>↑</kbd><kbd>↓</kbd></dt><dd>A step; with Shift ten, with Alt a tenth</dd></div>
            <div><dt>Drag</dt><dd>Sideways over a number changes it</dd></div>
            <div><dt>Double click</dt><dd>On a name takes the default</dd></div>
            <div><dt><kbd>Alt</kbd><kbd>Backspace</kbd></dt><dd>Takes the default, too</dd></div>
          </dl>
        </section>
      </div>
    </Dialog>
  );
}
