// The middle of the room: the grid, and what is looked at closely beside it.
import { useEffect, useRef, useState } from "preact/hooks";
import { useStudio } from "../shell/studio_context";
import { CloseView, PairsView } from "./close_view";
import { stageLayout } from "./grid_layout";
import { kPreview } from "./individual_message";
import { ModelCell } from "./model_cell";
import type { Close } from "./room_state";
import { StageView } from "./stage_view";

/** Individuals that are large, for what is looked at. */
function largeOnes(close: Close, selected: number | null, parents: number): number[] {
  switch (close.kind) {
    case "one": return selected === null ? [] : [selected];
    case "ancestor": return [close.id];
    case "blend": return parents >= 2 ? [kPreview] : [];
    case "pairs": return close.pair === null ? [] : [...close.pair];
    case "none": return [];
  }
}

export function ModelStage() {
  const studio = useStudio();
  const { room } = studio;
  const element = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState({ width: 0, height: 0 });
  useEffect(() => {
    const stage = element.current!;
    const measure = () => setSize({ width: stage.clientWidth, height: stage.clientHeight });
    const observer = new ResizeObserver(measure);
    observer.observe(stage);
    measure();
    return () => observer.disconnect();
  }, []);
  const generation = room.state.breeding.value?.generation;
  useEffect(() => {
    // Who had the focus on a model of the generation before has it on one of this, not nowhere.
    const lost = document.activeElement === null || document.activeElement === document.body;
    const id = room.state.selected.peek();
    if (lost && id !== null) element.current?.querySelector<HTMLElement>(`[data-individual="${id}"]`)?.focus({ preventScroll: true });
  }, [generation]);
  const close = room.state.close.value;
  const individuals = room.individuals.value;
  const large = largeOnes(close, room.state.selected.value, room.state.blend.value.parents.length);
  const done = close.kind === "pairs" && close.pair === null;
  const layout = stageLayout(individuals.length, large.length as 0 | 1 | 2, size.width, size.height);
  const { grid } = layout;
  room.columns = grid.columns;
  const small = grid.cells.length === 0 ? [] : individuals.map((one) => one.id);
  const rows = Array.from({ length: grid.rows }, (_, row) => individuals.slice(row * grid.columns, (row + 1) * grid.columns));
  const by = studio.preferences.value.rateBy;
  return (
    <div class="room-stage" ref={element} data-models>
      <StageView layout={layout} large={large} small={small} width={size.width} height={size.height} />
      {large.length === 2
        ? <PairsView pair={large as [number, number]} places={layout.large} />
        : (
          <>
            {large.length === 1 && <CloseView id={large[0]!} rect={layout.large[0]!} />}
            {done && <p class="room-said" role="status">All pairs of this screen are compared. Breed the next generation, or go back to the grid with Escape.</p>}
            <div role="grid" aria-label="Models of this generation" aria-colcount={grid.columns} aria-rowcount={grid.rows} class="cells">
              {rows.map((row, r) => (
                <div key={r} role="row" aria-rowindex={r + 1}>
                  {row.map((one, c) => <ModelCell key={one.id} one={one} rect={grid.cells[r * grid.columns + c]!} column={c} by={by === "pairs" && large.length === 0 ? "points" : by} />)}
                </div>
              ))}
            </div>
          </>
        )}
    </div>
  );
}
