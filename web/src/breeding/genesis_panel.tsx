// The knobs of Genesis (Grefenstette 1990), for sessions in the manner of GenTree.
import type { GenesisKnobs } from "../api";
import { CheckField, ChoiceField } from "../controls/fields";
import { Slider } from "../controls/slider";

const kSelections = ["proportional", "rank"] as const;

export function GenesisPanel({ knobs, onChange }: { knobs: GenesisKnobs; onChange(change: GenesisKnobs, gesture: string): void }) {
  const percent = (value: number | undefined, digits = 0) => `${(100 * (value ?? 0)).toFixed(digits)} %`;
  return (
    <section aria-label="Genesis">
      <h3>Genesis</h3>
      <Slider label="Crossover" title="Share of the population that is crossed" value={knobs.crossover ?? 0.6} min={0} max={1} step={0.05} words={percent(knobs.crossover)} onChange={(crossover, gesture) => onChange({ crossover }, gesture)} />
      <Slider label="Mutation" title="Chance of each bit to be drawn anew" value={knobs.mutation ?? 0.001} min={0} max={0.05} step={0.0005} words={percent(knobs.mutation, 2)} onChange={(mutation, gesture) => onChange({ mutation }, gesture)} />
      <Slider label="Gap" title="Share of the population that is replaced" value={knobs.gap ?? 1} min={0} max={1} step={0.05} words={percent(knobs.gap)} onChange={(gap, gesture) => onChange({ gap }, gesture)} />
      <Slider label="Window" title="Generations in which the worst rating is looked for that the others are measured from" value={knobs.window ?? 5} min={0} max={20} whole={true} onChange={(window, gesture) => onChange({ window }, gesture)} />
      <ChoiceField label="Selection" value={knobs.selection ?? "proportional"} choices={kSelections} onChange={(selection) => onChange({ selection }, "selection")} />
      <CheckField label="Elitist" title="The best of before comes back where it was lost" value={knobs.elitist ?? true} onChange={(elitist) => onChange({ elitist }, "elitist")} />
      <CheckField label="Gray code" title="Neighbouring values differ in one bit" value={knobs.gray ?? true} onChange={(gray) => onChange({ gray }, "gray")} />
    </section>
  );
}
