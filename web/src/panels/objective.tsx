import { useRef } from "preact/hooks";
import type { Term } from "../api";
import { showNumber } from "../controls/number";
import { useStudio } from "../shell/studio_context";

/** Where a term's bar begins and how long it is, in percent: bars go left and right of a common zero. */
export function barsOf(terms: readonly Term[]): { left: number; width: number }[] {
  const least = Math.min(0, ...terms.map((term) => term.value));
  const most = Math.max(0, ...terms.map((term) => term.value));
  const span = most - least || 1;
  return terms.map(({ value }) => ({
    left: ((Math.min(0, value) - least) / span) * 100,
    width: (Math.abs(value) / span) * 100,
  }));
}

/** Pixels of a term, and how many are seen at once; the rest is scrolled. */
const kRow = 25, kMostRows = 7;

/** What the score is made of: always there. */
export function ObjectivePanel() {
  const { state, document } = useStudio();
  const shown = state.shown.value;
  const terms = shown?.terms ?? [];
  const bars = barsOf(terms);
  // A search may show models with fewer terms than others: what stands below keeps its place.
  const most = useRef({ project: -1, rows: 0 });
  const project = document.value?.project.id ?? -1;
  if (most.current.project !== project || shown?.score === undefined) most.current = { project, rows: 0 };
  const rows = (most.current.rows = Math.max(most.current.rows, Math.min(terms.length, kMostRows)));
  return (
    <section class="objective" aria-labelledby="objective-title">
      <header>
        <h2 id="objective-title">Objective</h2>
        <output class="score" aria-label="Score">{shown?.score === undefined ? "–" : showNumber(shown.score)}</output>
      </header>
      <p class="hint objective-words" title={shown?.words}>{shown === null ? "No model yet" : shown.score === undefined ? "No targets" : shown.words}</p>
      {rows > 0 && (
        <ul style={{ minHeight: `${rows * kRow}px` }}>
          {terms.map((term, i) => (
            <li key={`${term.target} ${term.name}`} title={`${term.target}: ${term.name}, ${showNumber(term.count)}${term.of > 0 ? ` of ${showNumber(term.of)}` : ""} ${term.unit}`}>
              <span class="term-name"><span class="dim">{term.target}</span> {term.name}</span>
              <span class="term-value">{term.value > 0 ? "+" : ""}{showNumber(term.value)}</span>
              <span class="term-track" aria-hidden="true">
                <span class={term.value < 0 ? "term-bar cost" : "term-bar"} style={{ left: `${bars[i]!.left}%`, width: `${bars[i]!.width}%` }} />
              </span>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}
