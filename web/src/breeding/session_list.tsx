// Sessions of the project: open, rename, delete, as a file and from one.
import { useState } from "preact/hooks";
import type { BreedingInfo } from "../api";
import { agoWords } from "../base/ago_words";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { pickFile } from "../panels/pick_file";
import { useStudio } from "../shell/studio_context";
import { kMethodNames } from "./modes";

export function SessionList() {
  const { room } = useStudio();
  const sessions = room.state.sessions.value;
  const importFile = async () => {
    const file = await pickFile(".breeding");
    if (file !== null) await room.import(file);
  };
  return (
    <section class="start-sessions" aria-labelledby="sessions-title">
      <h2 id="sessions-title">Sessions</h2>
      {sessions.length === 0 && <p class="hint">None yet. All that you breed is kept here, with its whole history.</p>}
      <ul class="session-list">{sessions.map((one) => <SessionRow key={one.id} one={one} />)}</ul>
      <button type="button" class="text-button" onClick={() => void importFile()}>Import a session file</button>
    </section>
  );
}

function SessionRow({ one }: { one: BreedingInfo }) {
  const studio = useStudio();
  const { room } = studio;
  const [asked, setAsked] = useState<"row" | "rename" | "delete">("row");
  const [name, setName] = useState(one.name);
  const project = studio.document.value?.project.id;
  const open = room.state.breeding.value?.session.id === one.id;
  if (asked === "rename")
    return (
      <li>
        <form class="session-rename" onSubmit={(event) => {
          event.preventDefault();
          setAsked("row");
          if (name.trim() !== "" && name.trim() !== one.name) room.rename(one.id, name.trim());
        }}>
          <input type="text" aria-label="New name" maxLength={200} value={name} ref={(input) => input?.focus()} onInput={(event) => setName(event.currentTarget.value)} onKeyDown={(event) => event.key === "Escape" && setAsked("row")} />
          <button type="submit" class="button">Rename</button>
        </form>
      </li>
    );
  if (asked === "delete")
    return (
      <li class="session-question">
        <span>Delete {one.name} with all its generations? This cannot be undone.</span>
        <button type="button" class="button bad" ref={(button) => button?.focus()} onClick={() => void room.delete(one.id)}>Delete</button>
        <button type="button" class="button" onClick={() => setAsked("row")}>Keep it</button>
      </li>
    );
  return (
    <li class={open ? "open" : ""}>
      <button type="button" class="session-name" onClick={() => (open ? (room.state.choosing.value = false) : void room.open(one.id))}>
        <b>{one.name}</b>
        <span>{kMethodNames[one.method]}, {one.generations === 1 ? "1 generation" : `${one.generations} generations`}, {agoWords(Date.now() / 1000 - one.changed)}</span>
      </button>
      <IconButton label={`Rename ${one.name}`} kind="small" onClick={() => { setName(one.name); setAsked("rename"); }}><Icon name="pencil" /></IconButton>
      {project !== undefined && <a class="icon-button small" href={studio.files.breedingUrl(project, one.id)} download aria-label={`Export ${one.name}`} title={`Export ${one.name} as a file`}><Icon name="export" /></a>}
      <IconButton label={`Delete ${one.name}`} kind="small" onClick={() => setAsked("delete")}><Icon name="trash" /></IconButton>
    </li>
  );
}
