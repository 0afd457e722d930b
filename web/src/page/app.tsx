import { useEffect, useState } from "preact/hooks";
import { RoomPage } from "../breeding/room_page";
import { GrammarPane } from "../editor/grammar_pane";
import { AttributesPanel } from "../panels/attributes";
import { FavouritesStrip } from "../panels/favourites";
import { GenePanel } from "../panels/gene";
import { DensityPanel, LimitsPanel } from "../panels/limits";
import { ObjectivePanel } from "../panels/objective";
import { BottomPane } from "../panels/problems";
import { ProjectsDialog } from "../panels/projects";
import { SearchPanel } from "../panels/search";
import { TargetsPanel } from "../panels/targets";
import { PREFERENCE_DEFAULTS } from "../store/preferences";
import type { Studio } from "../store/studio";
import { listenForShortcuts, ShortcutsDialog } from "./shortcuts";
import { Splitter } from "../shell/splitter";
import { StudioContext, useStudio } from "../shell/studio_context";
import { Toolbar } from "./toolbar";
import { ViewPane } from "./view_pane";

/** The view keeps at least this, pixels. */
const kViewLeast = 360;

export function App({ studio }: { studio: Studio }) {
  const { state } = studio;
  const [size, setSize] = useState({ width: window.innerWidth, height: window.innerHeight });
  useEffect(() => {
    const onResize = () => setSize({ width: window.innerWidth, height: window.innerHeight });
    window.addEventListener("resize", onResize);
    const stop = listenForShortcuts(studio);
    return () => {
      window.removeEventListener("resize", onResize);
      stop();
    };
  }, [studio]);
  const wanted = studio.preferences.value;
  const right = Math.max(260, Math.min(wanted.right, size.width - kViewLeast - 240));
  const left = Math.max(240, Math.min(wanted.left, size.width - kViewLeast - right));
  const bottom = Math.max(80, Math.min(wanted.bottom, size.height - 240));
  const dialog = state.dialog.value;
  const close = () => {
    state.dialog.value = null;
  };
  return (
    <StudioContext.Provider value={studio}>
      <div class={studio.room.here.value ? "studio in-room" : "studio"} style={{ "--left": `${left}px`, "--right": `${right}px`, "--bottom": `${bottom}px` }}>
        <Toolbar />
        <section class="left" aria-label="Grammar">
          <GrammarPane />
          <Splitter
            label="Height of problems and log" orientation="horizontal" size={bottom} min={80} max={size.height - 240} direction={-1}
            standard={PREFERENCE_DEFAULTS.bottom} onSize={(next) => studio.setPreferences({ bottom: next })}
          />
          <BottomPane />
        </section>
        <Splitter
          label="Width of the grammar" orientation="vertical" size={left} min={240} max={size.width - kViewLeast - right} direction={1}
          standard={PREFERENCE_DEFAULTS.left} onSize={(next) => studio.setPreferences({ left: next })}
        />
        <main class="middle" aria-label="Model">
          <ViewPane />
          <FavouritesStrip />
        </main>
        <Splitter
          label="Width of the panels" orientation="vertical" size={right} min={260} max={size.width - kViewLeast - left} direction={-1}
          standard={PREFERENCE_DEFAULTS.right} onSize={(next) => studio.setPreferences({ right: next })}
        />
        <aside class="right" aria-label="Panels">
          <ObjectivePanel />
          <div class="right-scroll" tabIndex={-1}>
            <TargetsPanel />
            <SearchPanel />
            <GenePanel />
            <AttributesPanel />
            <LimitsPanel />
            <DensityPanel />
          </div>
        </aside>
        {studio.room.here.value && <RoomPage />}
        <Notices />
      </div>
      {dialog === "projects" && <ProjectsDialog />}
      {dialog === "shortcuts" && <ShortcutsDialog onClose={close} />}
    </StudioContext.Provider>
  );
}

/** Words that go by themselves. */
function Notices() {
  const studio = useStudio();
  return (
    <div class="notices" role="status" aria-live="polite">
      {studio.state.notices.value.map(({ number, text, bad, picture, action }) => (
        <p key={number} class={bad ? "notice bad" : "notice"}>
          {picture !== undefined && <img src={picture} alt="" onError={(event) => (event.currentTarget.hidden = true)} />}
          {text}
          {action !== undefined && (
            <button
              type="button" class="text-button"
              onClick={() => {
                studio.unsay(number);
                action.run();
              }}
            >
              {action.words}
            </button>
          )}
        </p>
      ))}
    </div>
  );
}
