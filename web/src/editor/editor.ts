// CodeMirror with everything that the grammar pane wants. It has no history of its own: undo is the server's, for all alike.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, indentWithTab, toggleComment } from "@codemirror/commands";
import { bracketMatching, codeFolding, foldGutter, foldKeymap, indentOnInput, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Annotation, Compartment, EditorState, Transaction, type Extension } from "@codemirror/state";
import {
  drawSelection, dropCursor, EditorView, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers, tooltips,
} from "@codemirror/view";
import type { Problem, Symbol } from "../api";
import { changesByLine } from "./changes";
import { completionSource } from "./completion";
import { toDiagnostics } from "./diagnostics";
import { espalierFolding } from "./folding";
import { hoverAt } from "./hover";
import { espalierHighlighting, espalierLanguage } from "./language";
import { definitionOf } from "./scan";
import { editorTheme } from "./theme";
import type { Keystroke } from "./typing";

export interface EditorHost {
  symbols(): readonly Symbol[];
  typed(text: string, key: Keystroke): void;
  /** `chosen`: a person went there, by key, click or jump; else the text moved, or the focus went. */
  cursor(at: number, chosen: boolean): void;
  undo(): void;
  redo(): void;
  format(): void;
}

const fromServer = Annotation.define<boolean>();

export class Editor {
  readonly view: EditorView;
  private readonly access = new Compartment();

  constructor(parent: HTMLElement, text: string, private readonly host: EditorHost) {
    const root = parent.shadowRoot ?? parent.attachShadow({ mode: "open" });
    this.view = new EditorView({
      parent: root as unknown as HTMLElement,
      root,
      state: EditorState.create({ doc: text, extensions: this.extensions() }),
    });
  }

  text(): string {
    return this.view.state.doc.toString();
  }

  /** The text shall be this; cursor and folds stay as far as they can. `reveal`: go to where it changed. */
  setText(text: string, reveal: boolean): void {
    const changes = changesByLine(this.text(), text);
    if (changes.length === 0) return;
    const last = changes.at(-1)!;
    const shift = changes.slice(0, -1).reduce((sum, change) => sum + change.insert.length - (change.to - change.from), 0);
    this.view.dispatch({
      changes,
      annotations: [fromServer.of(true), Transaction.addToHistory.of(false)],
      ...(reveal ? { selection: { anchor: last.from + shift + last.insert.length }, scrollIntoView: true } : {}),
    });
  }

  setProblems(problems: readonly Problem[], checkedText: string | null): void {
    this.view.dispatch(setDiagnostics(this.view.state, toDiagnostics(problems, checkedText, this.text())));
  }

  goTo(from: number, to: number, focus: boolean): void {
    const length = this.view.state.doc.length;
    const anchor = Math.max(0, Math.min(from, length));
    const head = Math.max(anchor, Math.min(to, length));
    this.view.dispatch({ selection: { anchor, head: focus ? head : anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
    if (focus) this.view.focus();
  }

  /** Without a project there is nothing that could be typed. */
  setReadOnly(readOnly: boolean): void {
    this.view.dispatch({ effects: this.access.reconfigure(EditorState.readOnly.of(readOnly)) });
  }

  dispose(): void {
    this.view.destroy();
  }

  private extensions(): Extension[] {
    const run = (action: () => void) => () => (action(), true);
    return [
      lineNumbers(), foldGutter({ openText: "▾", closedText: "▸" }), codeFolding({ placeholderText: "…" }), lintGutter({ hoverTime: 150 }),
      drawSelection(), dropCursor(), highlightActiveLine(), highlightActiveLineGutter(), highlightSelectionMatches(),
      bracketMatching(), closeBrackets(), indentOnInput(), indentUnit.of("  "), EditorState.tabSize.of(2), search({ top: false }),
      this.access.of([]), espalierLanguage, espalierHighlighting, espalierFolding, editorTheme, tooltips({ position: "fixed" }),
      autocompletion({ override: [completionSource(() => this.host.symbols())], icons: false, activateOnTypingDelay: 60 }),
      hoverTooltip((view, at) => this.hover(view, at)),
      keymap.of([
        { key: "Mod-z", run: run(() => this.host.undo()), shift: run(() => this.host.redo()), preventDefault: true },
        { key: "Mod-y", run: run(() => this.host.redo()), preventDefault: true },
        { key: "Mod-s", run: run(() => this.host.format()), preventDefault: true },
        { key: "F12", run: (view) => this.goToDefinition(view.state.selection.main.head) },
        { key: "Mod-/", run: toggleComment },
        ...closeBracketsKeymap, ...completionKeymap, ...foldKeymap, ...lintKeymap, ...searchKeymap, ...defaultKeymap, indentWithTab,
      ]),
      EditorView.contentAttributes.of({ "aria-label": "Grammar", tabindex: "0", spellcheck: "false", autocorrect: "off", autocapitalize: "off" }),
      EditorView.domEventHandlers({
        mousedown: (event, view) => {
          if (!(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
          const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
          return at !== null && this.goToDefinition(at);
        },
      }),
      EditorView.updateListener.of((update) => {
        const mine = update.transactions.some((one) => one.docChanged && one.annotation(fromServer) === undefined);
        if (mine) {
          let from = update.state.doc.length;
          let to = 0;
          let erased = true;
          update.changes.iterChanges((_fromA, _toA, fromB, toB, inserted) => {
            from = Math.min(from, fromB);
            to = Math.max(to, toB);
            if (inserted.length > 0) erased = false;
          });
          this.host.typed(update.state.doc.toString(), { from, to, erased, at: performance.now() });
        }
        if (update.docChanged || update.selectionSet || update.focusChanged)
          this.host.cursor(update.state.selection.main.head, update.view.hasFocus || update.selectionSet);
      }),
    ];
  }

  private goToDefinition(at: number): boolean {
    const found = definitionOf(this.text(), at);
    if (found !== null) this.goTo(found.from, found.to, true);
    return found !== null;
  }

  private hover(view: EditorView, at: number) {
    const found = hoverAt(view.state.doc.toString(), at, this.host.symbols());
    if (found === null) return null;
    return {
      pos: found.from,
      end: found.to,
      above: true,
      create: () => {
        const dom = document.createElement("div");
        dom.className = "cm-hover";
        dom.append(Object.assign(document.createElement("code"), { textContent: found.signature }));
        if (found.text !== "") dom.append(Object.assign(document.createElement("p"), { textContent: found.text }));
        return { dom };
      },
    };
  }
}
