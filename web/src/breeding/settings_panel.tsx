// How the session breeds: who may do what, the next generation, what is not bred at all, taste, and Genesis.
import type { RoomSettings } from "../api";
import { CheckField, ChoiceField } from "../controls/fields";
import { NumberField } from "../controls/number_field";
import { Slider } from "../controls/slider";
import { AttributesPanel } from "../panels/attributes";
import { useStudio } from "../shell/studio_context";
import { GenesisPanel } from "./genesis_panel";
import { kModeNames, kModes } from "./modes";

export function SettingsPanel() {
  const studio = useStudio();
  const { room } = studio;
  const breeding = room.state.breeding.value;
  // What is no gene: leaves or not, how stout. All of the generation has the same.
  const attributes = studio.state.checked.value?.attributes.length ?? 0;
  if (breeding === null) return null;
  const { settings } = breeding;
  const set = (change: RoomSettings, gesture = Object.keys(change).join(" ")) => room.set(change, gesture);
  const free = settings.method !== "classic";
  return (
    <div class="room-pad room-settings">
      <section aria-label="People">
        <h3>You</h3>
        <ChoiceField label="May" value={settings.mode ?? "rate_and_edit"} choices={kModes} names={kModeNames} onChange={(mode) => set({ mode })} />
        <CheckField label="Learn my taste" value={settings.taste ?? false} title="A model of your taste chooses what is shown from a hidden pool of candidates, and says why" onChange={(taste) => set({ taste })} />
        <Taste why={breeding.taste_why} on={settings.taste ?? false} />
      </section>
      <section aria-label="Next generation">
        <h3>Next generation</h3>
        <Slider label="Models" value={settings.population ?? 12} min={9} max={20} whole={true} onChange={(population, gesture) => set({ population }, gesture)} />
        {free && <Slider label="Copies" title="The best rated are copied, so many at most" value={settings.keep ?? 0} min={0} max={8} whole={true} onChange={(keep, gesture) => set({ keep }, gesture)} />}
        {free && <Slider label="Newcomers" title="Share that is drawn anew" value={settings.newcomers ?? 0} min={0} max={1} step={0.05} words={`${Math.round(100 * (settings.newcomers ?? 0))} %`} onChange={(newcomers, gesture) => set({ newcomers }, gesture)} />}
      </section>
      <section aria-label="Limits">
        <h3>Not bred beyond</h3>
        <NumberField label="Triangles" title="0: without limit" value={settings.max_triangles ?? 0} min={0} step={500} whole={true} onChange={(value, gesture) => set({ max_triangles: value }, gesture)} />
        <NumberField label="Height" title="0: without limit" value={settings.max_height ?? 0} min={0} step={0.5} unit="m" onChange={(value, gesture) => set({ max_height: value }, gesture)} />
        <NumberField label="Spread" title="0: without limit" value={settings.max_spread ?? 0} min={0} step={0.5} unit="m" onChange={(value, gesture) => set({ max_spread: value }, gesture)} />
        <p class="hint">0 is without limit. The scene's own targets and limits count as well.</p>
      </section>
      {attributes > 0 && <AttributesPanel />}
      {!free && <GenesisPanel knobs={settings.classic ?? {}} onChange={(classic, gesture) => set({ classic }, gesture)} />}
      <p class="hint">{free ? "Free breeding, seed" : "GenTree classic, seed"} {breeding.seed}.</p>
    </div>
  );
}

function Taste({ why, on }: { why: readonly string[] | undefined; on: boolean }) {
  if (!on) return null;
  return (
    <div class="taste">
      {why === undefined || why.length === 0
        ? <p class="hint">Not learnt much yet: rate some models, for and against.</p>
        : <><p>You seem to like</p><ul>{why.map((one) => <li key={one}>{one}</li>)}</ul></>}
    </div>
  );
}
