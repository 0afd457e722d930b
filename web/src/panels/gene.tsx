import { useEffect, useState } from "preact/hooks";
import type { Draw } from "../api";
import { Icon } from "../controls/icons";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { Panel } from "./panel";

/** The gene of the part that was clicked. */
export function GenePanel() {
  const studio = useStudio();
  const gene = studio.state.gene.value;
  if (gene === null)
    return <Panel id="gene" title="Gene" reveal=""><p class="hint">Click a part in the view to see its rule, its path and its draws.</p></Panel>;
  const stale = studio.state.selection.value?.kind !== "gene";
  const jump = () => {
    if (gene.at !== undefined) studio.state.jump.value = { at: gene.at, focus: true };
  };
  return (
    <Panel id="gene" title="Gene" note={gene.rule} reveal={gene.path}>
      <div class="gene-head">
        <button type="button" class="text-button" onClick={jump} disabled={gene.at === undefined} title="Go to its rule">
          <Icon name="rule" />{gene.rule}
        </button>
        <button type="button" class={gene.locked ? "button lock on" : "button lock"} aria-pressed={gene.locked} disabled={stale} onClick={() => void studio.genes.setLock(!gene.locked)} title="Keep it with all that stands on it (L)">
          <Icon name={gene.locked ? "lock" : "unlock"} />Lock
        </button>
      </div>
      <p class="gene-path" title={gene.path}>{gene.path}</p>
      <p class="hint">{gene.below === 0 ? "Nothing stands on it." : gene.below === 1 ? "One gene stands on it." : `${gene.below} genes stand on it.`}</p>
      {stale && <p class="hint">The model that is shown has no such part.</p>}
      {gene.draws.map((draw) => <DrawRow key={`${gene.path} ${draw.index}`} draw={draw} disabled={stale} />)}
    </Panel>
  );
}

/** While it is dragged the slider shows what the hand does, not what the server says of a moment ago. */
function DrawRow({ draw, disabled }: { draw: Draw; disabled: boolean }) {
  const studio = useStudio();
  const [held, setHeld] = useState<number | null>(null);
  useEffect(() => {
    if (held !== null && Math.abs(draw.quantile - held) < 1e-3) setHeld(null);
  }, [draw.quantile]);
  return (
    <div onFocusOut={() => setHeld(null)}>
      <Slider
        label={draw.name} min={0} max={1} step={0.005} value={held ?? draw.quantile} words={draw.value} disabled={disabled}
        title={draw.low === undefined ? draw.name : `${draw.name}: ${draw.low} to ${draw.high}`}
        onChange={(quantile, gesture) => {
          setHeld(quantile);
          studio.genes.setDraw(draw.index, quantile, gesture);
        }}
      />
    </div>
  );
}
