// The breeding room: what the page shows instead of the editor.
import { FavouritesStrip } from "../panels/favourites";
import { useStudio } from "../shell/studio_context";
import { ActionBar } from "./action_bar";
import { BlendPanel } from "./blend_panel";
import { HistoryStrip } from "./history_strip";
import { Inspector } from "./inspector";
import { LineagePanel } from "./lineage_panel";
import { ModelStage } from "./model_stage";
import { RoomBar } from "./room_bar";
import type { RoomTab } from "./room_state";
import { SettingsPanel } from "./settings_panel";
import { StartScreen } from "./start_screen";

const kTabs: readonly { tab: RoomTab; name: string }[] = [
  { tab: "individual", name: "Model" }, { tab: "blend", name: "Blend" }, { tab: "lineage", name: "Ancestors" }, { tab: "settings", name: "Settings" },
];

export function RoomPage() {
  const studio = useStudio();
  const { room } = studio;
  if (room.state.breeding.value === null || room.state.choosing.value) return <div class="room room-start"><StartScreen /></div>;
  const id = room.state.selected.value;
  return (
    <div class="room">
      <main class="room-main" aria-label="Breeding room">
        <RoomBar />
        <ModelStage />
        <ActionBar />
        <footer class="room-foot">
          <HistoryStrip />
          <FavouritesStrip keep={{ words: "Keep the selected model (K)", disabled: id === null, run: () => id !== null && void room.keep(id), shown: () => studio.tell("The editor shows this favourite now.") }} />
        </footer>
      </main>
      <aside class="room-side" aria-label="Details">
        <Tabs />
        <TabBody tab={room.state.tab.value} />
      </aside>
    </div>
  );
}

function Tabs() {
  const { room } = useStudio();
  const { tab } = room.state;
  const onKeyDown = (event: KeyboardEvent) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    const at = kTabs.findIndex((one) => one.tab === tab.value);
    tab.value = kTabs[(at + step + kTabs.length) % kTabs.length]!.tab;
    document.getElementById(`room-tab-${tab.value}`)?.focus();
  };
  return (
    <div class="room-tabs" role="tablist" aria-label="Details" onKeyDown={onKeyDown}>
      {kTabs.map((one) => (
        <button
          key={one.tab} type="button" role="tab" id={`room-tab-${one.tab}`} aria-selected={tab.value === one.tab} aria-controls="room-tab-body" tabIndex={tab.value === one.tab ? 0 : -1}
          onClick={() => (tab.value = one.tab)}
        >
          {one.tab === "individual" && room.state.selected.value !== null ? `Model ${room.state.selected.value}` : one.name}
        </button>
      ))}
    </div>
  );
}

function TabBody({ tab }: { tab: RoomTab }) {
  return (
    <div class="room-tab-body" role="tabpanel" id="room-tab-body" aria-labelledby={`room-tab-${tab}`} tabIndex={-1}>
      {tab === "individual" ? <Inspector /> : tab === "blend" ? <BlendPanel /> : tab === "lineage" ? <LineagePanel /> : <SettingsPanel />}
    </div>
  );
}
