import type { ComponentChildren } from "preact";
import { useReveal } from "./use_reveal";
import { Icon } from "../controls/icons";
import { useStudio } from "../shell/studio_context";

/** A part of the right side that folds away. */
export function Panel({ id, title, note, actions, reveal, children }: {
  id: string; title: string; note?: ComponentChildren; actions?: ComponentChildren; children: ComponentChildren;
  /** Scrolled into sight when this becomes something else. */
  reveal?: unknown;
}) {
  const studio = useStudio();
  const element = useReveal<HTMLElement>(reveal);
  const folded = studio.preferences.value.folded.includes(id);
  const toggle = () => {
    const others = studio.preferences.value.folded.filter((name) => name !== id);
    studio.setPreferences({ folded: folded ? others : [...others, id] });
  };
  return (
    <section class="panel" ref={element} aria-labelledby={`panel-${id}`}>
      <header class="panel-head">
        <h2>
          <button type="button" id={`panel-${id}`} aria-expanded={!folded} aria-controls={`panel-${id}-body`} class={folded ? "folded" : ""} onClick={toggle}>
            <Icon name="down" />
            {title}
          </button>
        </h2>
        <span class="panel-note">{note}</span>
        {actions}
      </header>
      <div id={`panel-${id}-body`} class="panel-body" hidden={folded}>
        {!folded && children}
      </div>
    </section>
  );
}
