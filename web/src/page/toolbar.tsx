import { Choice } from "../controls/choice";
import { IconButton } from "../controls/fields";
import { Icon, type IconName } from "../controls/icons";
import { ExportMenu } from "../panels/export_menu";
import type { Theme } from "../store/preferences";
import { useStudio } from "../shell/studio_context";

const kThemes: readonly { theme: Theme; icon: IconName }[] = [
  { theme: "system", icon: "system" },
  { theme: "light", icon: "sun" },
  { theme: "dark", icon: "moon" },
];

const kRooms = [
  { value: "model", name: "Model", words: "The editor (Ctrl-B)" },
  { value: "breed", name: "Breed", words: "The breeding room (Ctrl-B)" },
] as const;

export function Toolbar() {
  const studio = useStudio();
  const { state } = studio;
  const document = studio.document.value;
  const offline = state.status.value.kind !== "open";
  const theme = studio.preferences.value.theme;
  const at = kThemes.findIndex((one) => one.theme === theme);
  const here = studio.room.here.value;
  // The room has steps of its own to take back.
  const line = here ? studio.room.state.breeding.value : document;
  const pending = !here && studio.edits.size.value > 0;
  const name = document?.project.name ?? "No project";
  return (
    <header class="toolbar">
      <h1 class="brand">Espalier</h1>
      <button type="button" class="button project-button" aria-haspopup="dialog" title="Projects (Ctrl-O)" onClick={() => (state.dialog.value = "projects")}>
        <Icon name="folder" /><span>{name}</span><Icon name="down" />
      </button>
      <Choice label="Room" value={here ? "breed" : "model"} choices={kRooms} onChange={(room) => studio.room.go(room === "breed")} />
      <span class="toolbar-group" role="group" aria-label="History">
        <IconButton label={line?.undo === undefined ? "Undo" : `Undo: ${line.undo}`} keys="Ctrl-Z" disabled={offline || (line?.undo === undefined && !pending)} onClick={() => (here ? studio.room : studio).undo()}>
          <Icon name="undo" />
        </IconButton>
        <IconButton label={line?.redo === undefined ? "Redo" : `Redo: ${line.redo}`} keys="Ctrl-Shift-Z" disabled={offline || line?.redo === undefined} onClick={() => (here ? studio.room : studio).redo()}>
          <Icon name="redo" />
        </IconButton>
      </span>
      <span class="toolbar-space" />
      <Connection />
      {!here && <SearchButton />}
      {!here && <ExportMenu />}
      <IconButton label={`Theme: ${theme}`} onClick={() => studio.setPreferences({ theme: kThemes[(at + 1) % kThemes.length]!.theme })}>
        <Icon name={kThemes[at]!.icon} />
      </IconButton>
      <IconButton label="Keys" keys="?" onClick={() => (state.dialog.value = "shortcuts")}><Icon name="help" /></IconButton>
    </header>
  );
}

/** The search can be started and stopped whatever the panels show. */
function SearchButton() {
  const studio = useStudio();
  const running = studio.state.search.value?.running ?? false;
  const offline = studio.state.status.value.kind !== "open" || studio.document.value === null;
  return (
    <button
      type="button" class={running ? "button search-button on" : "button search-button"} disabled={offline} title={running ? "Stop the search (Space)" : "Search (Space)"}
      onClick={() => studio.searching.toggle()}
    >
      <Icon name={running ? "stop" : "play"} />{running ? "Stop" : "Search"}
    </button>
  );
}

/** Says nothing while all is well. */
function Connection() {
  const studio = useStudio();
  const status = studio.state.status.value;
  const waiting = studio.edits.size.value;
  if (status.kind === "open") return null;
  const words =
    status.kind === "connecting" ? "Connecting …" : status.kind === "closed" ? "Disconnected" : "Connection lost. Trying again …";
  return (
    <span class="connection" role="status">
      <span class="connection-mark" />
      {words}
      {waiting > 0 && ` ${waiting === 1 ? "One change waits." : `${waiting} changes wait.`}`}
      {status.kind === "waiting" && status.attempt > 3 && " Is the server running? A new start has a new link."}
    </span>
  );
}
