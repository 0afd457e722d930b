// Below the models: how wildly the next generation differs, how different these are, and the button that breeds.
import { Icon } from "../controls/icons";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { dialWords, diversityWords } from "./origin_words";
import { ratedCount } from "./rating";

export function ActionBar() {
  const { room } = useStudio();
  const breeding = room.state.breeding.value;
  if (breeding === null) return null;
  const { settings } = breeding;
  const waiting = room.state.waiting.value ?? (breeding.busy === undefined ? null : `${breeding.busy} …`);
  const strength = settings.strength ?? 0.35;
  const rated = ratedCount(breeding.individuals);
  const words = breeding.problem ?? breeding.hint ?? breeding.notes?.[0] ?? (room.mayRate.value && rated === 0 ? "Rate what you like and what you do not. What is not rated counts as neutral." : "");
  return (
    <section class="action-bar" aria-label="Breeding">
      {settings.method === "classic"
        ? <p class="dial dim">Genesis: {Math.round(100 * (settings.classic?.crossover ?? 0.6))} % crossed, {(100 * (settings.classic?.mutation ?? 0.001)).toFixed(1)} % of bits drawn anew</p>
        : (
          <div class="dial">
            <Slider label="Mutation" title="From subtle to wild: how far children stray from their parents" value={strength} min={0} max={1} step={0.01} words={dialWords(strength)} onChange={(value, gesture) => room.set({ strength: value }, gesture)} />
          </div>
        )}
      <Diversity value={breeding.diversity} />
      <p class={breeding.problem === undefined ? "action-words dim" : "action-words facts-bad"} role="status" title={[words, ...(breeding.notes ?? [])].join("\n")}>{words}</p>
      <button type="button" class="button primary breed-button" disabled={waiting !== null || breeding.problem !== undefined} title="Next generation (N or Enter)" onClick={() => room.breed()}>
        {waiting === null ? <>Next generation<Icon name="right" /></> : <><span class="spinner" />{waiting}</>}
      </button>
    </section>
  );
}

/** Its place is there before it is measured. */
function Diversity({ value }: { value: number | undefined }) {
  const words = value === undefined ? "…" : diversityWords(value);
  return (
    <div class="diversity" title="How different the models of this screen are. Newcomers and a wilder mutation raise it.">
      <span>Diversity</span>
      <span class="diversity-track" role="meter" aria-label="Diversity" aria-valuemin={0} aria-valuemax={1} aria-valuenow={value ?? 0} aria-valuetext={words}>
        <span class={(value ?? 1) < 0.08 ? "low" : ""} style={{ width: `${100 * (value ?? 0)}%` }} />
      </span>
      <span class="dim">{words}</span>
    </div>
  );
}
