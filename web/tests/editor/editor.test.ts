import { forEachDiagnostic } from "@codemirror/lint";
import { afterEach, describe, expect, test } from "vitest";
import { Editor, type EditorHost } from "../../src/editor/editor";

const made: Editor[] = [];

function make(text: string) {
  const typed: string[] = [];
  const asked: string[] = [];
  const host: EditorHost = {
    symbols: () => [],
    typed: (all) => typed.push(all),
    cursor: () => undefined,
    undo: () => asked.push("undo"),
    redo: () => asked.push("redo"),
    format: () => asked.push("format"),
  };
  const parent = document.createElement("div");
  document.body.append(parent);
  const editor = new Editor(parent, text, host);
  made.push(editor);
  return { editor, typed, asked, parent };
}

afterEach(() => {
  for (const editor of made.splice(0)) editor.dispose();
  document.body.replaceChildren();
});

describe("the editor", () => {
  test("tells what is typed, not what comes from the server", () => {
    const { editor, typed } = make("abc");
    editor.view.dispatch({ changes: { from: 3, insert: "d" } });
    editor.setText("abcx", false);
    expect(typed).toEqual(["abcd"]);
    expect(editor.text()).toBe("abcx");
  });

  test("keeps the cursor when other lines change, and goes to the change when asked", () => {
    const { editor } = make("one\ntwo\nthree\n");
    editor.view.dispatch({ selection: { anchor: 10 } });
    editor.setText("ones\ntwo\nthree\n", false);
    expect(editor.view.state.selection.main.head).toBe(11);
    editor.setText("ones\ntwos\nthree\n", true);
    expect(editor.view.state.selection.main.head).toBe(9);
  });

  test("shows problems where the text stands now", () => {
    const { editor } = make("rule A { spawn B }");
    editor.setText("# c\nrule A { spawn B }", false);
    editor.setProblems([{ severity: "error", code: "E0202", text: "no rule B", at: { from: 15, to: 16 } }], "rule A { spawn B }");
    const found: string[] = [];
    forEachDiagnostic(editor.view.state, (_one, from, to) => found.push(editor.view.state.sliceDoc(from, to)));
    expect(found).toEqual(["B"]);
  });

  test("takes no keys while there is no project, but the server's text", () => {
    const { editor } = make("");
    editor.setReadOnly(true);
    expect(editor.view.state.readOnly).toBe(true);
    editor.setText("abc", false);
    expect(editor.text()).toBe("abc");
    editor.setReadOnly(false);
    expect(editor.view.state.readOnly).toBe(false);
  });

  test("has no history of its own", () => {
    const { editor, asked } = make("a");
    const press = (key: string, more = {}) =>
      editor.view.contentDOM.dispatchEvent(new KeyboardEvent("keydown", { key, ctrlKey: true, bubbles: true, cancelable: true, ...more }));
    press("z");
    press("y");
    press("s");
    expect(asked).toEqual(["undo", "redo", "format"]);
  });

  test("places outside of the text do no harm", () => {
    const { editor } = make("abc");
    editor.goTo(-5, 900, false);
    editor.goTo(900, 1000, false);
    expect(editor.view.state.selection.main.head).toBe(3);
  });

  test("lives in a shadow root, so that the policy needs no inline styles", () => {
    const { parent } = make("abc");
    expect(parent.shadowRoot?.querySelector(".cm-content")).not.toBeNull();
    expect(document.head.querySelector("style")).toBeNull();
  });
});
