// The grammar pane with the store behind it.
import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test } from "vitest";
import { GrammarPane } from "../../src/editor/grammar_pane";
import { SHORTCUTS } from "../../src/page/shortcuts";
import { StudioContext } from "../../src/shell/studio_context";
import { Bench, documentOf } from "../fakes";

const text = "grammar a 1\nstart Stem\n\nrule Stem { spawn Leaf }\n\nrule Leaf { }\n";
let root: HTMLElement;

async function open(): Promise<Bench> {
  const bench = await new Bench().open(text);
  root = document.createElement("div");
  document.body.append(root);
  act(() => render(<StudioContext.Provider value={bench.studio}><GrammarPane /></StudioContext.Provider>, root));
  return bench;
}

afterEach(() => {
  act(() => render(null, root));
  document.body.replaceChildren();
});

describe("the rule under the cursor", () => {
  const goTo = (bench: Bench, word: string) => {
    const from = bench.studio.grammar.value.indexOf(word);
    bench.studio.state.jump.value = { at: { from, to: from + word.length }, focus: false };
  };

  test("stays lit while one looks at it in the view, until another is chosen or Escape", async () => {
    const bench = await open();
    const { state } = bench.studio;
    expect(state.cursorRule.value).toBeNull();
    goTo(bench, "spawn Leaf");
    expect(state.cursorRule.value).toBe("Stem");
    bench.socket.say(documentOf(2, `# a comment\n${text}`));
    expect(state.cursorRule.value).toBe("Stem");
    goTo(bench, "rule Leaf");
    expect(state.cursorRule.value).toBe("Leaf");
    goTo(bench, "spawn Leaf");
    SHORTCUTS.find((one) => one.key === "Escape")!.run!(bench.studio);
    expect(state.cursorRule.value).toBeNull();
    bench.socket.say(documentOf(3, text));
    expect(state.cursorRule.value).toBeNull();
    goTo(bench, "spawn Leaf");
    bench.socket.say(documentOf(1, text, {}, 2));
    expect(state.cursorRule.value).toBeNull();
  });
});

describe("undo in the editor", () => {
  test("goes to the text that it changed, and what changes the text later does not", async () => {
    const bench = await open();
    const content = root.querySelector(".grammar-editor")!.shadowRoot!.querySelector(".cm-content")!;
    const undo = () => void content.dispatchEvent(new KeyboardEvent("keydown", { key: "z", ctrlKey: true, bubbles: true, cancelable: true }));
    undo();
    bench.socket.say(documentOf(2, text, { seed: 2 }));
    await bench.answer("undo");
    bench.socket.say(documentOf(3, `${text}rule Stem2 { }\n`));
    expect(bench.studio.state.cursorRule.value).toBeNull();
    undo();
    bench.socket.say(documentOf(4, `${text}rule Other { }\n`));
    await bench.answer("undo");
    expect(bench.studio.state.cursorRule.value).toBe("Other");
  });
});
