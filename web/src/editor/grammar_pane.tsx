// The grammar on the left: the editor, tied to the store.
import { computed, effect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { addMeshFiles, isMeshFile } from "./drop_mesh";
import { Editor } from "./editor";
import { ruleAt } from "./scan";
import { TypingBursts } from "./typing";
import { useStudio } from "../shell/studio_context";

export function GrammarPane() {
  const studio = useStudio();
  const place = useRef<HTMLDivElement>(null);
  const [over, setOver] = useState(false);

  useEffect(() => {
    const { state } = studio;
    const hasProject = computed(() => studio.document.value !== null);
    const bursts = new TypingBursts();
    /** Steps back and forth that are asked for here and not answered: the cursor goes to what they change. */
    let steps = 0;
    const ownHistory = (action: () => Promise<boolean>) => () => {
      bursts.end();
      steps += 1;
      void action().finally(() => {
        steps -= 1;
      });
    };
    const made = new Editor(place.current!, studio.grammar.peek(), {
      symbols: () => state.checked.peek()?.symbols ?? [],
      typed: (text, key) => studio.type(text, bursts.gesture(key), ruleAt(text, key.to)),
      // The rule stays lit while one looks at it in the view, which takes the focus.
      cursor: (at, chosen) => {
        if (chosen || state.cursorRule.peek() !== null) state.cursorRule.value = ruleAt(made.text(), at);
      },
      undo: ownHistory(() => studio.undo()),
      redo: ownHistory(() => studio.redo()),
      format: () => {
        bursts.end();
        studio.format();
      },
    });
    const stops = [
      effect(() => {
        const text = studio.grammar.value;
        if (text === made.text()) return;
        made.setText(text, steps > 0);
      }),
      effect(() => made.setReadOnly(!hasProject.value)),
      effect(() => {
        const checked = state.checked.value;
        made.setProblems(checked?.problems ?? [], state.checkedText.peek());
      }),
      effect(() => {
        const jump = state.jump.value;
        if (jump === null) return;
        state.jump.value = null;
        made.goTo(jump.at.from, jump.at.to, jump.focus);
      }),
    ];
    return () => {
      stops.forEach((stop) => stop());
      made.dispose();
      place.current?.shadowRoot?.replaceChildren();
    };
  }, [studio]);

  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  const onDrop = (event: DragEvent) => {
    setOver(false);
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const good = files.filter((file) => isMeshFile(file.name));
    if (good.length < files.length) studio.tell("Only OBJ, GLB, PLY and STL files can be dropped here.", true);
    void addMeshFiles(studio, good);
  };

  return (
    <div
      class={over ? "grammar grammar-over" : "grammar"}
      onDragOver={(event) => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDropCapture={onDrop}
    >
      <div class="grammar-editor" ref={place} />
      {over && <div class="grammar-drop">Drop a mesh: OBJ, GLB, PLY or STL</div>}
    </div>
  );
}
