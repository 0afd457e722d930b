// How a session begins, and those that there are.
import { useState } from "preact/hooks";
import type { StartBreeding } from "../api";
import { ChoiceField } from "../controls/fields";
import { Icon } from "../controls/icons";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { kMethodNames, kModeNames, kModes, kPopulation, type Method, type Mode } from "./modes";
import { SessionList } from "./session_list";

type From = StartBreeding["from"];
const kFrom: readonly { from: From; name: string; words: string }[] = [
  { from: "nothing", name: "Nothing", words: "A first screen of different, sound models" },
  { from: "shown", name: "The shown model", words: "The model of the editor, and relatives of it" },
  { from: "favourites", name: "Favourites", words: "What you kept, and relatives" },
];
const kMethods: readonly { method: Method; words: string }[] = [
  { method: "free", words: "For every grammar: mutation by a dial, copies of the best, newcomers, locks and taste." },
  { method: "classic", words: "Bit strings bred by Genesis, as in 2003. For grammars whose genome is the draws of the start rule." },
];

export function StartScreen() {
  const studio = useStudio();
  const { room } = studio;
  const [method, setMethod] = useState<Method>("free");
  const [mode, setMode] = useState<Mode>("rate_and_edit");
  const [from, setFrom] = useState<From>("nothing");
  const [population, setPopulation] = useState<number | null>(null);
  const [name, setName] = useState("");
  const waiting = room.state.waiting.value;
  const offline = studio.state.status.value.kind !== "open" || studio.document.value === null;
  const possible: Record<From, boolean> = {
    nothing: true, shown: studio.state.shown.value !== null, favourites: (studio.document.value?.favourites.length ?? 0) > 0,
  };
  const start = () => void room.start({ settings: { method, mode, population: population ?? kPopulation[method] }, from, ...(name.trim() === "" ? {} : { name: name.trim() }) });
  return (
    <main class="start" aria-label="Breeding room">
      <section class="start-new" aria-labelledby="start-title">
        <h2 id="start-title">Breed what you like</h2>
        <p class="hint">You see a screen of models, say which you like, and get their children. Nobody needs to know which parameter makes what.</p>
        <fieldset>
          <legend>Begin with</legend>
          <div class="start-cards">
            {kFrom.map((one) => (
              <label key={one.from} class={from === one.from ? "start-card on" : "start-card"} data-impossible={possible[one.from] ? undefined : ""}>
                <input type="radio" name="from" checked={from === one.from} disabled={!possible[one.from]} onChange={() => setFrom(one.from)} />
                <b>{one.name}</b>
                <span>{possible[one.from] ? one.words : one.from === "shown" ? "No model is shown yet" : "None kept yet"}</span>
              </label>
            ))}
          </div>
        </fieldset>
        <fieldset>
          <legend>Method</legend>
          <div class="start-cards two">
            {kMethods.map((one) => (
              <label key={one.method} class={method === one.method ? "start-card on" : "start-card"}>
                <input type="radio" name="method" checked={method === one.method} onChange={() => setMethod(one.method)} />
                <b>{kMethodNames[one.method]}</b>
                <span>{one.words}</span>
              </label>
            ))}
          </div>
        </fieldset>
        <div class="start-rows">
          <ChoiceField label="You may" value={mode} choices={kModes} names={kModeNames} onChange={(next) => setMode(next)} />
          <Slider label="Models" value={population ?? kPopulation[method]} min={9} max={20} whole={true} onChange={(value) => setPopulation(value)} />
          <div class="row">
            <label for="start-name">Name</label>
            <span class="row-end"><input id="start-name" type="text" maxLength={200} value={name} placeholder="Found for you" onInput={(event) => setName(event.currentTarget.value)} /></span>
          </div>
        </div>
        <div class="start-go">
          <button type="button" class="button primary breed-button" disabled={offline || waiting !== null || !possible[from]} onClick={start}>
            {waiting === null ? <>Start breeding<Icon name="right" /></> : <><span class="spinner" />{waiting}</>}
          </button>
          {room.state.breeding.value !== null && <button type="button" class="button" onClick={() => (room.state.choosing.value = false)}>Back to {room.state.breeding.value.session.name}</button>}
        </div>
      </section>
      <SessionList />
    </main>
  );
}
