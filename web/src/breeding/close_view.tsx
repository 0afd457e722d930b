// One model large beside the grid, as GenTree showed them, and two to choose from.
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { useStudio } from "../shell/studio_context";
import type { Rect } from "./grid_layout";
import { kPreview } from "./individual_message";
import { originSentence } from "./origin_words";
import { RatingButtons } from "./rating_buttons";
import { selectAndFocus } from "./run_action";

const placeOf = (rect: Rect) => ({ left: `${rect.x}px`, top: `${rect.y}px`, width: `${rect.width}px`, height: `${rect.height}px` });

export function CloseView({ id, rect }: { id: number; rect: Rect }) {
  const studio = useStudio();
  const { room } = studio;
  const kind = room.state.close.value.kind;
  const all = room.individuals.value;
  const at = all.findIndex((one) => one.id === id);
  const one = all[at];
  const to = (next: number) => {
    const other = all[(next + all.length) % all.length];
    if (other !== undefined) selectAndFocus(studio, other.id);
  };
  const waiting = !room.state.models.value.has(id);
  return (
    <section class="close" style={placeOf(rect)} aria-label={id === kPreview ? "The blend" : `Model ${id}`}>
      <header class="close-head">
        <b>{id === kPreview ? "Blend" : kind === "ancestor" ? `${id}, an ancestor` : id}</b>
        {one !== undefined && <span class="dim">{originSentence(one)}</span>}
        {id === kPreview && <span class="dim">of {room.state.blend.value.parents.join(", ")}; not kept yet</span>}
        <span class="cell-space" />
        <IconButton label="Back to the grid" keys="Escape" kind="small" onClick={() => room.look("none")}><Icon name="close" /></IconButton>
      </header>
      {waiting && <span class="cell-words quiet">Growing …</span>}
      {kind === "one" && one !== undefined && (
        <footer class="close-foot">
          <IconButton label="Previous model" keys="←" onClick={() => to(at - 1)}><Icon name="left" /></IconButton>
          {room.mayRate.value && <RatingButtons id={id} rating={one.rating} by={studio.preferences.value.rateBy === "stars" ? "stars" : "points"} tab={true} />}
          <IconButton label="Next model" keys="→" onClick={() => to(at + 1)}><Icon name="right" /></IconButton>
          <span class="dim close-count">{at + 1} of {all.length}</span>
        </footer>
      )}
      {kind === "blend" && (
        <footer class="close-foot">
          <button type="button" class="button primary" onClick={() => void room.keepBlend()}><Icon name="plus" />Keep the blend</button>
        </footer>
      )}
    </section>
  );
}

/** Two to choose from. */
export function PairsView({ pair, places }: { pair: readonly [number, number]; places: readonly Rect[] }) {
  const { room } = useStudio();
  return (
    <>
      {pair.map((id, i) => (
        <section key={i} class="close" style={placeOf(places[i]!)} aria-label={`${"AB"[i]}: model ${id}`}>
          <header class="close-head"><b>{"AB"[i]}</b><span class="dim">{id}</span></header>
          <footer class="close-foot">
            <button type="button" class="button primary pick" onClick={() => void room.pick(i as 0 | 1)}>{"AB"[i]} is better <kbd>{i === 0 ? "←" : "→"}</kbd></button>
          </footer>
        </section>
      ))}
      <div class="pairs-middle">
        <button type="button" class="button" onClick={() => void room.pick(null)}>Alike: next pair</button>
        <button type="button" class="button" title="Escape" onClick={() => room.look("none")}>Back to the grid</button>
      </div>
    </>
  );
}
