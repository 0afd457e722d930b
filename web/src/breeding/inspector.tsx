// The selected individual: what can be done with it, what it is, and its genes.
import { Icon } from "../controls/icons";
import { thousands } from "../controls/number";
import { useStudio } from "../shell/studio_context";
import type { Bred, BredIndividual } from "../api";
import { showNumber } from "../controls/number";
import { GeneList } from "./gene_list";
import { IndividualExports } from "./individual_exports";
import { kRoles, metres, originSentence } from "./origin_words";
import { ratingWords } from "./rating";

export function Inspector() {
  const { room } = useStudio();
  const one = room.selected.value;
  if (one === null) return <p class="hint room-pad">Click a model to see its genes.</p>;
  return (
    <>
      <Actions one={one} />
      <Facts one={one} bred={room.state.models.value.get(one.id)?.bred ?? null} />
      <GeneList one={one} />
      <IndividualExports key={one.id} id={one.id} />
    </>
  );
}

function Actions({ one }: { one: BredIndividual }) {
  const { room } = useStudio();
  const busy = room.state.waiting.value !== null || room.state.breeding.value?.busy !== undefined;
  const parent = room.state.blend.value.parents.includes(one.id);
  return (
    <div class="room-actions" role="group" aria-label={`What to do with ${one.id}`}>
      <button type="button" class="button" disabled={busy} title="A generation of it and of relatives close to it (M)" onClick={() => room.moreLike(one.id)}><Icon name="more" />More like this</button>
      <button type="button" class="button" title="To the favourites of the project (K)" onClick={() => void room.keep(one.id)}><Icon name="star" />Keep</button>
      <button type="button" class="button" title="It becomes the model that the project shows (E)" onClick={() => void room.show(one.id)}><Icon name="rule" />In the editor</button>
      <button type="button" class="button" aria-pressed={parent} title="A parent of a blend (X)" onClick={() => room.toggleParent(one.id)}><Icon name="branch" />Blend</button>
    </div>
  );
}

function Facts({ one, bred }: { one: BredIndividual; bred: Bred | null }) {
  const { room } = useStudio();
  const rated = room.mayRate.value;
  return (
    <section class="facts" aria-label="Facts">
      <dl>
        <div><dt>Triangles</dt><dd>{bred === null ? "–" : thousands(bred.triangles)}</dd></div>
        <div><dt>Height</dt><dd>{bred === null ? "–" : metres(bred.height)}</dd></div>
        <div><dt>Spread</dt><dd>{bred === null ? "–" : metres(bred.spread)}</dd></div>
        <div><dt>Genes</dt><dd>{bred === null ? "–" : thousands(bred.genes)}</dd></div>
        <div><dt>Rating</dt><dd class={one.rating === undefined ? "dim" : ""}>{rated ? (one.rating === undefined ? "neutral" : ratingWords(one.rating)) : "–"}</dd></div>
        <div><dt>Score</dt><dd>{bred?.score === undefined ? "–" : showNumber(bred.score)}</dd></div>
      </dl>
      <p class="facts-origin">
        {originSentence({ ...one, parents: [] })}
        {one.parents.map((parent, i) => (
          <span key={parent}>
            {i === 0 ? (one.origin === "kept" || one.origin === "sibling" ? " of " : " from ") : i === one.parents.length - 1 ? " and " : ", "}
            <button type="button" class="text-button" onClick={() => room.lookAtAncestor(parent)}>{parent}</button>
          </span>
        ))}
      </p>
      {bred !== null && !bred.viable && <p class="facts-bad"><Icon name="warning" /><span>Not viable: {bred.why.join("; ")}.</span></p>}
      {bred?.truncated === true && <p class="facts-bad"><Icon name="warning" /><span>Not all of it is shown: it has too many parts.</span></p>}
      {bred !== null && bred.words !== "" && <p class="hint">{bred.words}</p>}
      {one.taste !== undefined && (
        <div class="taste-own">
          <p>{one.role === undefined ? "By your taste" : kRoles[one.role].name}: <b>{ratingWords(one.taste.mean)}</b> <span class="dim">± {Math.round(one.taste.sd * 10) / 10}</span></p>
          {one.taste.why.length > 0 && <ul>{one.taste.why.map((why) => <li key={why}>{why}</li>)}</ul>}
        </div>
      )}
    </section>
  );
}
