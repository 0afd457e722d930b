// What stands over a model in the grid: its number, why it is here, and its rating.
import type { BredIndividual } from "../api";
import { Icon } from "../controls/icons";
import { useStudio } from "../shell/studio_context";
import type { Rect } from "./grid_layout";
import { kRoles, originSentence, originWords } from "./origin_words";
import { ratingWords, type RateBy } from "./rating";
import { RatingButtons } from "./rating_buttons";

export function ModelCell({ one, rect, column, by }: { one: BredIndividual; rect: Rect; column: number; by: RateBy }) {
  const { room } = useStudio();
  const { state } = room;
  const selected = state.selected.value === one.id;
  const corner = state.blend.value.parents.indexOf(one.id);
  const model = state.models.value.get(one.id);
  const bred = model?.bred ?? null;
  const role = one.role === undefined ? null : kRoles[one.role];
  const bad = bred !== null && !bred.viable;
  const words = [
    `Model ${one.id}`, room.mayRate.value ? ratingWords(one.rating) : "", originWords(one), one.edited ? "edited by hand" : "", role?.name ?? "",
    bad ? `not viable: ${bred.why.join(", ")}` : "", corner >= 0 ? "parent of the blend" : "",
  ].filter((part) => part !== "").join(", ");
  return (
    <div
      role="gridcell" aria-colindex={column + 1} aria-selected={selected} aria-label={words} tabIndex={selected ? 0 : -1} data-individual={one.id}
      class={`cell${selected ? " selected" : ""}${one.rating === undefined ? "" : one.rating > 0 ? " liked" : one.rating < 0 ? " disliked" : ""}`}
      style={{ left: `${rect.x}px`, top: `${rect.y}px`, width: `${rect.width}px`, height: `${rect.height}px` }}
      onClick={() => room.select(one.id)} onDblClick={() => room.look("one")} onFocus={() => room.select(one.id)}
    >
      <span class="cell-head">
        <span class="cell-number" title={originSentence(one)}>{one.id}</span>
        {one.origin === "kept" && <span class="cell-mark" title="A copy: it keeps its rating"><Icon name="copy" /></span>}
        {one.edited && <span class="cell-mark" title="Edited by hand"><Icon name="pencil" /></span>}
        {bad && <span class="cell-mark bad" title={`Not viable: ${bred.why.join("; ")}`}><Icon name="warning" /></span>}
        <span class="cell-space" />
        {corner >= 0 && <span class="cell-corner" data-text={"ABC"[corner]} />}
        {role !== null && <span class={`cell-role ${one.role}`} title={role.words} data-text={role.name} />}
      </span>
      {one.missing !== undefined && <span class="cell-words">{one.missing}</span>}
      {one.missing === undefined && model === undefined && <span class="cell-words quiet">Growing …</span>}
      {room.mayRate.value && by !== "pairs" && <span class="cell-foot"><RatingButtons id={one.id} rating={one.rating} by={by} tab={false} /></span>}
    </div>
  );
}
