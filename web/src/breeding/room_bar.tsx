// Above the models: which session and generation, how to rate, and how they are seen.
import { Choice } from "../controls/choice";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { useStudio } from "../shell/studio_context";
import { kRateBy, type RateBy } from "./rating";
import { toggleTurning } from "./run_action";

const kNames: Record<RateBy, { name: string; words: string }> = {
  points: { name: "Thumbs", words: "A point up or down for each click" },
  stars: { name: "Stars", words: "One to five; three is neither for nor against" },
  extremes: { name: "Best & worst", words: "One of each on every screen is enough" },
  pairs: { name: "A or B", words: "Two at a time, large" },
};

export function RoomBar() {
  const studio = useStudio();
  const { room } = studio;
  const breeding = room.state.breeding.value;
  if (breeding === null) return null;
  const { oneScale, turning, rateBy } = studio.preferences.value;
  const close = room.state.close.value.kind;
  const turns = turning && !room.still.value;
  const choose = (by: RateBy) => {
    studio.setPreferences({ rateBy: by });
    if (by === "pairs") room.look("pairs");
    else if (close === "pairs") room.look("none");
  };
  return (
    <header class="room-bar">
      <button type="button" class="button session-button" title="Sessions of this project" aria-label={`Sessions; this one is ${breeding.session.name}`} onClick={() => (room.state.choosing.value = true)}>
        <Icon name="tree" /><span>{breeding.session.name}</span><Icon name="down" />
      </button>
      <h2>Generation {breeding.generation}</h2>
      <span class="dim">{breeding.individuals.length} models</span>
      <span class="unseen" role="status">{`Generation ${breeding.generation}, ${breeding.individuals.length} models`}</span>
      <span class="cell-space" />
      {room.mayRate.value && (
        <Choice label="Rate by" value={close === "pairs" ? "pairs" : rateBy === "pairs" ? "points" : rateBy} choices={kRateBy.map((by) => ({ value: by, ...kNames[by] }))} onChange={choose} />
      )}
      <span class="toolbar-group" role="group" aria-label="View">
        <IconButton label="One at a time, beside the grid" keys="O" pressed={close === "one"} onClick={() => room.toggleLook("one")}><Icon name="single" /></IconButton>
        <IconButton label="All on one scale" keys="S" pressed={oneScale} onClick={() => studio.setPreferences({ oneScale: !oneScale })}><Icon name="scale" /></IconButton>
        <IconButton label={turns ? "Stand still" : "Turn"} keys="T" pressed={turns} onClick={() => toggleTurning(studio)}><Icon name="turn" /></IconButton>
      </span>
    </header>
  );
}
