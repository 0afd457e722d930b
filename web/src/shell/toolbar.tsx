import { IconButton } from "../controls/fields";
import { Icon, type IconName } from "../controls/icons";
import { ExportMenu } from "../panels/export_menu";
import type { Theme } from "../store/preferences";
import { useStudio } from "./studio_context";

const kThemes: readonly { theme: Theme; icon: IconName }[] = [
  { theme: "system", icon: "system" },
  { theme: "light", icon: "sun" },
  { theme: "dark", icon: "moon" },
];

export function Toolbar() {
  const studio = useStudio();
  const { state } = studio;
  const document = studio.document.value;
  const offline = state.status.value.kind !== "open";
  const theme = studio.preferences.value.theme;
  const at = kThemes.findIndex((one) => one.theme === theme);
  const pending = studio.edits.size.value > 0;
  const name = document?.project.name ?? "No project";
  return (
    <header class="toolbar">
      <h1 class="brand">Espalier</h1>
      <button type="button" class="button project-button" aria-haspopup="dialog" title="Projects (Ctrl-O)" onClick={() => (state.dialog.value = "projects")}>
        <Icon name="folder" /><span>{name}</span><Icon name="down" />
      </button>
      <span class="toolbar-group" role="group" aria-label="History">
        <IconButton label={document?.undo === undefined ? "Undo" : `Undo: ${document.undo}`} keys="Ctrl-Z" disabled={offline || (document?.undo === undefined && !pending)} onClick={() => studio.undo()}>
          <Icon name="undo" />
        </IconButton>
        <IconButton label={document?.redo === undefined ? "Redo" : `Redo: ${document.redo}`} keys="Ctrl-Shift-Z" disabled={offline || document?.redo === undefined} onClick={() => studio.redo()}>
          <Icon name="redo" />
        </IconButton>
      </span>
      <span class="toolbar-space" />
      <Connection />
      <SearchButton />
      <ExportMenu />
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
