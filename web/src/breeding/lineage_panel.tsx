// The ancestors of the selected individual.
import { useStudio } from "../shell/studio_context";
import { lineageGraph } from "./history_layout";
import { originSentence } from "./origin_words";
import { ratingWords } from "./rating";

const kLevels = 6, kWidth = 290, kRow = 64, kTop = 24;

export function LineagePanel() {
  const { room } = useStudio();
  const { lineage, selected, close } = room.state;
  const one = room.selected.value;
  if (one === null) return <p class="hint room-pad">Click a model to see its ancestors.</p>;
  if (lineage.value === null) return <p class="hint room-pad">…</p>;
  const graph = lineageGraph(lineage.value.individuals, selected.value!, kLevels);
  const looked = close.value.kind === "ancestor" ? close.value.id : null;
  const x = (across: number) => across * kWidth, y = (level: number) => kTop + level * kRow;
  const node = graph.places.find((place) => place.node.id === looked)?.node;
  return (
    <section class="lineage room-pad" aria-label={`Ancestors of ${one.id}`}>
      {graph.places.length <= 1
        ? <p class="hint">{one.id} has no ancestors: it was {originSentence({ ...one, parents: [] }).toLowerCase()}.</p>
        : <p class="hint">Parents below their child. Click one to see it beside the grid.</p>}
      <div class="lineage-graph" style={{ height: `${graph.levels * kRow + 8}px`, width: `${kWidth}px` }}>
        <svg viewBox={`0 0 ${kWidth} ${graph.levels * kRow + 8}`} width={kWidth} height={graph.levels * kRow + 8} aria-hidden="true">
          {graph.edges.map(([child, parent]) => {
            const a = graph.places[child]!, b = graph.places[parent]!;
            const [x1, y1, x2, y2] = [x(a.across), y(a.level), x(b.across), y(b.level)];
            return <path key={`${child} ${parent}`} d={`M${x1} ${y1}C${x1} ${(y1 + y2) / 2} ${x2} ${(y1 + y2) / 2} ${x2} ${y2}`} />;
          })}
        </svg>
        {graph.places.map((place) => (
          <button
            key={place.node.id} type="button" class={`lineage-node${place.node.id === looked ? " looked" : ""}${place.level === 0 ? " self" : ""}`}
            style={{ left: `${x(place.across)}px`, top: `${y(place.level)}px` }} aria-label={`${place.node.id}: ${originSentence(place.node)}, generation ${place.node.generation}, ${ratingWords(place.node.rating)}`}
            title={`${originSentence(place.node)}; generation ${place.node.generation}; ${ratingWords(place.node.rating)}`} onClick={() => room.lookAtAncestor(place.node.id)}
          >
            {place.node.id}
            {place.node.rating !== undefined && place.node.rating !== 0 && <small data-text={ratingWords(place.node.rating)} />}
          </button>
        ))}
      </div>
      {graph.more && <p class="hint">There are more before these.</p>}
      {node !== undefined && (
        <div class="room-actions">
          <button type="button" class="button" onClick={() => room.goToGeneration(node.generation)}>Go to its generation, {node.generation}</button>
        </div>
      )}
    </section>
  );
}
