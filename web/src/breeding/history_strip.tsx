// All generations of the session: a click goes there, breeding from there begins a branch.
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { GenerationInfo } from "../api";
import { useStudio } from "../shell/studio_context";
import { historyGraph } from "./history_layout";
import { lastingWords } from "./origin_words";

const kColumn = 44, kLane = 26, kLeft = 22, kTop = 17;

function wordsOf(one: GenerationInfo): string {
  const details = [
    one.label, one.rated > 0 ? `${one.rated} rated` : "", one.edited > 0 ? `${one.edited} edited` : "", one.seconds >= 1 ? lastingWords(one.seconds) : "",
    one.diversity === undefined ? "" : `diversity ${Math.round(100 * one.diversity)} %`,
  ];
  return `Generation ${one.number}: ${details.filter((part) => part !== "").join(", ")}`;
}

export function HistoryStrip() {
  const { room } = useStudio();
  const breeding = room.state.breeding.value;
  const graph = useMemo(() => historyGraph(breeding?.generations ?? []), [breeding?.generations]);
  const here = useRef<HTMLButtonElement>(null);
  useEffect(() => here.current?.scrollIntoView({ block: "nearest", inline: "nearest" }), [breeding?.generation, graph.nodes.length]);
  if (breeding === null) return null;
  const x = (column: number) => kLeft + column * kColumn, y = (lane: number) => kTop + lane * kLane;
  const width = x(graph.columns) , height = Math.max(y(graph.lanes), 2 * kLane);
  return (
    <section class="history" aria-label="Generations">
      <div class="history-scroll" tabIndex={-1}>
        <div class="history-graph" style={{ width: `${width}px`, height: `${height}px` }}>
          <svg width={width} height={height} aria-hidden="true">
            {graph.edges.map(([from, to]) => {
              const a = graph.nodes[from]!, b = graph.nodes[to]!;
              const [x1, y1, x2, y2] = [x(a.column), y(a.lane), x(b.column), y(b.lane)];
              return <path key={`${from} ${to}`} d={y1 === y2 ? `M${x1} ${y1}H${x2}` : `M${x1} ${y1}C${x1 + 26} ${y1} ${x1 + 14} ${y2} ${x2} ${y2}`} />;
            })}
          </svg>
          {graph.nodes.map(({ generation, column, lane }) => {
            const shown = generation.number === breeding.generation;
            return (
              <button
                key={generation.number} ref={shown ? here : null} type="button" class={`history-node${shown ? " here" : ""}${generation.rated > 0 ? " rated" : ""}`}
                style={{ left: `${x(column)}px`, top: `${y(lane)}px` }} aria-current={shown ? "step" : undefined} aria-label={wordsOf(generation)} title={wordsOf(generation)}
                onClick={() => room.goToGeneration(generation.number)}
              >
                {generation.number}
              </button>
            );
          })}
        </div>
      </div>
    </section>
  );
}
