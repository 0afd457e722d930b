import { useState } from "preact/hooks";
import { CheckField, ChoiceField } from "../controls/fields";
import { Icon } from "../controls/icons";
import { readNumber, showNumber, thousands } from "../controls/number";
import { NumberField } from "../controls/number_field";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { changeEngine, changeSetting, ENGINE_NAMES, ENGINE_SETTINGS, ENGINES, engineOf, settingOf, type Setting } from "./engine_settings";
import { Panel } from "./panel";
import { Sparkline } from "./sparkline";
import { useGesture } from "../controls/gesture";

export function SearchPanel() {
  const studio = useStudio();
  const [open, setOpen] = useState(false);
  const scene = studio.scene.value;
  const search = studio.state.search.value;
  const engine = engineOf(scene);
  const settings = ENGINE_SETTINGS[engine];
  const locked = studio.state.shown.value?.locked.length ?? 0;
  const offline = studio.state.status.value.kind !== "open";
  const setSeconds = (seconds: number, gesture?: string) =>
    studio.setScene("Set time", { ...studio.scene.value, budget: { ...studio.scene.value.budget, seconds } }, gesture);
  return (
    <Panel id="search" title="Search" note={search?.running ? <span class="running">running</span> : ""}>
      <div class="search-buttons">
        {search?.running ? (
          <button type="button" class="button primary" onClick={() => studio.searching.stop()} title="Stop (Space)"><Icon name="stop" />Stop</button>
        ) : (
          <button type="button" class="button primary" disabled={offline} onClick={() => studio.searching.start("new")} title="Start (Space)"><Icon name="play" />Start</button>
        )}
        <button type="button" class="button" disabled={offline || search?.running || !search?.onward} onClick={() => studio.searching.start("onward")} title="Go on with the search that was stopped">
          <Icon name="onward" />Continue
        </button>
      </div>
      <SearchNumbers />
      {locked > 0 && <p class="hint">{locked === 1 ? "One gene is" : `${locked} genes are`} locked: the rest is searched again.</p>}
      <CheckField label="Live" value={studio.preferences.value.live} title="Search again after each change." onChange={(live) => studio.setPreferences({ live })} />
      <Slider label="Time" unit="s" logarithmic min={0.05} max={60} value={studio.searching.seconds()} title="Seconds that a search may take." onChange={setSeconds} />
      <ChoiceField
        label="Engine" value={engine} choices={ENGINES} names={ENGINE_NAMES}
        onChange={(next) => studio.setScene(`Engine ${next}`, changeEngine(studio.scene.value, next))}
      />
      {settings.filter((one) => !one.more).map((one) => <SettingRow key={engine + one.key} setting={one} />)}
      <button type="button" class="text-button" aria-expanded={open} onClick={() => setOpen(!open)}>{open ? "Fewer settings" : "More settings"}</button>
      {open && settings.filter((one) => one.more).map((one) => <SettingRow key={engine + one.key} setting={one} />)}
      {open && (
        <NumberField
          label="Seed" whole min={0} max={2 ** 52} value={scene.seed ?? 1} standard={scene.seed === undefined} title="Same seed, same results."
          onChange={(seed, gesture) => studio.setScene("Set seed", { ...studio.scene.value, seed }, gesture)}
        />
      )}
    </Panel>
  );
}

function SearchNumbers() {
  const search = useStudio().state.search.value;
  const rate = search && search.seconds > 0 ? search.evaluations / search.seconds : 0;
  return (
    <div class="search-numbers">
      <Sparkline rises={search?.rises ?? []} />
      <dl>
        <div><dt>Best</dt><dd>{search?.best === undefined ? "–" : showNumber(search.best)}</dd></div>
        <div><dt>Time</dt><dd>{search ? `${search.seconds.toFixed(1)} s` : "–"}</dd></div>
        <div><dt>Evaluations</dt><dd>{search ? thousands(search.evaluations) : "–"}</dd></div>
        <div><dt>Per second</dt><dd>{rate > 0 ? thousands(Math.round(rate)) : "–"}</dd></div>
      </dl>
    </div>
  );
}

function SettingRow({ setting }: { setting: Setting }) {
  const studio = useStudio();
  const value = settingOf(studio.scene.value, setting.key);
  const standard = value === undefined;
  const set = (next: number | boolean | string | undefined, gesture?: string) =>
    studio.setScene(`Set ${setting.label.toLowerCase()}`, changeSetting(studio.scene.value, setting.key, next), gesture);
  const common = { label: setting.label, standard, title: setting.title, onReset: () => set(undefined) };
  if (setting.kind === "bool") return <CheckField {...common} value={(value ?? setting.standard) === true} onChange={set} />;
  if (setting.kind === "choice") return <ChoiceField {...common} value={String(value ?? setting.standard)} choices={setting.choices} onChange={set} />;
  if (setting.standard === null) return <MaybeNumber setting={setting} value={typeof value === "number" ? value : undefined} onChange={set} />;
  const { title: _, ...rest } = common;
  return (
    <NumberField
      {...rest} {...(setting.title === undefined ? {} : { title: setting.title })} value={typeof value === "number" ? value : setting.standard}
      min={setting.min} max={setting.max} whole={setting.whole} step={setting.step} onChange={set}
    />
  );
}

/** A number that may be left to the engine: empty. */
function MaybeNumber({ setting, value, onChange }: {
  setting: Extract<Setting, { kind: "number" }>; value: number | undefined; onChange(value: number | undefined, gesture: string): void;
}) {
  const gesture = useGesture(setting.label);
  return (
    <div class="row" title={setting.title}>
      <span class="row-name">{setting.label}</span>
      <span class="row-end">
        <input
          class="number" type="text" inputMode="decimal" autocomplete="off" aria-label={setting.label} placeholder="auto" value={value === undefined ? "" : showNumber(value)}
          onChange={(event) => {
            const text = event.currentTarget.value;
            const next = readNumber(text);
            if (text.trim() === "") onChange(undefined, gesture.current());
            else if (next !== null) onChange(Math.min(setting.max, Math.max(setting.min, next)), gesture.current());
            else event.currentTarget.value = value === undefined ? "" : showNumber(value);
            gesture.next();
          }}
        />
      </span>
    </div>
  );
}
