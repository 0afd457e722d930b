// All genes of an individual with their draws: sliders that work while they are dragged, locks, copy and paste.
import { useEffect, useState } from "preact/hooks";
import type { BredGene, BredIndividual, Draw } from "../api";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";

/** Groups at first: trees have hundreds of genes. */
const kFirst = 24;

export function GeneList({ one }: { one: BredIndividual }) {
  const { room } = useStudio();
  const { genes, copied } = room.state;
  const [word, setWord] = useState("");
  const [most, setMost] = useState(kFirst);
  const all = genes.value?.individual === one.id ? genes.value.genes : null;
  const found = (all ?? []).filter((gene) => word === "" || `${gene.path} ${gene.draws.map((draw) => draw.name).join(" ")}`.toLowerCase().includes(word.toLowerCase()));
  const places = found.flatMap((gene) => gene.draws.map((draw) => ({ path: gene.path, index: draw.index })));
  const locked = found.reduce((sum, gene) => sum + gene.locked.length, 0);
  const edit = room.mayEdit.value;
  return (
    <section class="genes" aria-label="Genes">
      <header class="genes-head">
        <h2>Genes</h2>
        <span class="cell-space" />
        <IconButton label={locked === places.length && locked > 0 ? "Free all genes" : "Lock all genes"} kind="small" disabled={places.length === 0} pressed={locked > 0} onClick={() => room.lock(places, locked < places.length)}>
          <Icon name={locked > 0 ? "lock" : "unlock"} />
        </IconButton>
        <IconButton label="Copy all genes" keys="C" kind="small" disabled={all === null} onClick={() => room.copy()}><Icon name="copy" /></IconButton>
        <IconButton label={copied.value === null ? "Paste genes" : `Paste genes of ${copied.value.individual}`} keys="V" kind="small" disabled={all === null || copied.value === null || !edit} onClick={() => room.paste()}><Icon name="paste" /></IconButton>
      </header>
      {(all?.length ?? 0) > 8 && (
        <input type="text" class="genes-find" placeholder="Find a rule or a draw" aria-label="Find a gene" value={word} onInput={(event) => setWord(event.currentTarget.value)} />
      )}
      {!edit && <p class="hint">This session is bred without editing: its settings can change that.</p>}
      {all === null && one.missing === undefined && <p class="hint">…</p>}
      {all?.length === 0 && <p class="hint">None of its genes has draws.</p>}
      {found.slice(0, most).map((gene, i) => <GeneGroup key={gene.path} gene={gene} individual={one.id} open={i === 0} alone={all!.length === 1} />)}
      {found.length > most && <button type="button" class="text-button" onClick={() => setMost(most + 100)}>{found.length - most} more</button>}
      {genes.value?.truncated === true && <p class="hint">It has more draws: these are the first 2000.</p>}
    </section>
  );
}

function GeneGroup({ gene, individual, open, alone }: { gene: BredGene; individual: number; open: boolean; alone: boolean }) {
  const { room } = useStudio();
  const [shown, setShown] = useState(open);
  const { copied } = room.state;
  const all = gene.locked.length === gene.draws.length;
  const pasted = copied.value !== null && (copied.value.rule === gene.rule || copied.value.draws.some((one) => one.path === gene.path));
  const places = gene.draws.map((draw) => ({ path: gene.path, index: draw.index }));
  return (
    <div class="gene-group" role="group" aria-label={gene.path}>
      <div class="gene-group-head">
        <button type="button" class={shown ? "gene-group-name" : "gene-group-name folded"} aria-expanded={shown} title={gene.path} onClick={() => setShown(!shown)}>
          <Icon name="down" /><b>{gene.rule}</b>{!alone && <span class="dim">{gene.path.includes("/") ? gene.path.slice(0, gene.path.lastIndexOf("/")) : ""}</span>}
        </button>
        {gene.locked.length > 0 && !shown && <span class="dim">{gene.locked.length} locked</span>}
        <IconButton label={all ? `Free ${gene.rule}` : `Lock ${gene.rule}`} kind="small" pressed={gene.locked.length > 0} onClick={() => room.lock(places, !all)}><Icon name={gene.locked.length > 0 ? "lock" : "unlock"} /></IconButton>
        <IconButton label={`Copy ${gene.rule}`} kind="small" onClick={() => room.copy(gene)}><Icon name="copy" /></IconButton>
        <IconButton label={`Paste into ${gene.rule}`} kind="small" disabled={!pasted || !room.mayEdit.value} onClick={() => room.paste(gene)}><Icon name="paste" /></IconButton>
      </div>
      {shown && gene.draws.map((draw) => <GeneSlider key={draw.index} gene={gene} draw={draw} individual={individual} />)}
    </div>
  );
}

/** While it is dragged the slider shows what the hand does, not what the server says of a moment ago. */
function GeneSlider({ gene, draw, individual }: { gene: BredGene; draw: Draw; individual: number }) {
  const { room } = useStudio();
  const [held, setHeld] = useState<number | null>(null);
  useEffect(() => {
    if (held !== null && Math.abs(draw.quantile - held) < 1e-3) setHeld(null);
  }, [draw.quantile]);
  const locked = gene.locked.includes(draw.index);
  return (
    <div class={locked ? "gene-draw locked" : "gene-draw"} onFocusOut={() => setHeld(null)}>
      <Slider
        label={draw.name} min={0} max={1} step={0.005} value={held ?? draw.quantile} words={draw.value} disabled={!room.mayEdit.value}
        title={draw.low === undefined ? draw.name : `${draw.name}: ${draw.low} to ${draw.high}`}
        onChange={(quantile, gesture) => {
          setHeld(quantile);
          room.setGenes(individual, [{ gene: gene.gene, index: draw.index, quantile }], `${individual} ${gene.gene} ${gesture}`, `Set ${draw.name} of ${individual}`);
        }}
      />
      <IconButton label={locked ? `Free ${draw.name}` : `Lock ${draw.name}`} kind="small" pressed={locked} onClick={() => room.lock([{ path: gene.path, index: draw.index }], !locked)}>
        <Icon name={locked ? "lock" : "unlock"} />
      </IconButton>
    </div>
  );
}
