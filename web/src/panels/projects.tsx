import { useState } from "preact/hooks";
import type { ProjectInfo } from "../api";
import { agoWords } from "../base/ago_words";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { Dialog } from "../shell/dialog";
import { useStudio } from "../shell/studio_context";
import { pickFile } from "./pick_file";

export function ProjectsDialog() {
  const studio = useStudio();
  const { state } = studio;
  const projects = [...state.projects.value].sort((a, b) => b.changed - a.changed);
  const close = () => {
    state.dialog.value = null;
  };
  const [name, setName] = useState("");
  const create = (sample?: string, title?: string) => void studio.projects.create(name.trim() || title || "Untitled", sample);
  const importFile = async () => {
    const file = await pickFile(".espalier");
    if (file !== null) await studio.projects.import(file);
  };
  return (
    <Dialog title="Projects" kind="projects" onClose={close}>
      <div class="projects-columns">
        <section aria-labelledby="projects-own">
          <h3 id="projects-own">Yours</h3>
          {projects.length === 0 && <p class="hint">None yet. Begin with a sample.</p>}
          <ul class="project-list">
            {projects.map((project) => <ProjectRow key={project.id} project={project} onOpened={close} />)}
          </ul>
          <button type="button" class="text-button" onClick={() => void importFile()}title="A project file, or the zip file of a scene folder">Import a project or a scene</button>
        </section>
        <section aria-labelledby="projects-new">
          <h3 id="projects-new">New</h3>
          <div class="row">
            <label for="new-name">Name</label>
            <span class="row-end"><input id="new-name" type="text" maxLength={200} value={name} placeholder="as the sample" onInput={(event) => setName(event.currentTarget.value)} /></span>
          </div>
          <ul class="samples">
            <li>
              <button type="button" onClick={() => create()}>
                <span class="sample-picture"><Icon name="plus" /></span>
                <b>Empty</b>
                <span>A grammar of one stem.</span>
              </button>
            </li>
            {state.samples.value.map((sample) => (
              <li key={sample.name}>
                <button type="button" onClick={() => create(sample.name, sample.title)}>
                  <span class="sample-picture">
                    {sample.picture === undefined
                      ? <Icon name="parts" />
                      : <img src={studio.files.sampleUrl(sample.picture)} alt="" width={192} height={144} loading="lazy" />}
                  </span>
                  <b>{sample.title}</b>
                  <span>{sample.words}</span>
                </button>
              </li>
            ))}
          </ul>
        </section>
      </div>
    </Dialog>
  );
}

function ProjectRow({ project, onOpened }: { project: ProjectInfo; onOpened(): void }) {
  const studio = useStudio();
  const [mode, setMode] = useState<"row" | "rename" | "delete">("row");
  const [name, setName] = useState(project.name);
  const open = studio.document.value?.project.id === project.id;
  const openIt = async () => {
    if (await studio.projects.open(project.id)) onOpened();
  };
  if (mode === "rename") {
    const rename = () => {
      setMode("row");
      if (name.trim() !== "" && name.trim() !== project.name) void studio.ask({ kind: "rename_project", project: project.id, name: name.trim() });
    };
    return (
      <li>
        <input
          type="text" aria-label="New name" maxLength={200} value={name} ref={(input) => input?.focus()} onInput={(event) => setName(event.currentTarget.value)}
          onBlur={rename}
          onKeyDown={(event) => {
            if (event.key === "Enter") rename();
            if (event.key === "Escape") {
              event.preventDefault();
              setName(project.name);
              setMode("row");
            }
          }}
        />
      </li>
    );
  }
  if (mode === "delete")
    return (
      <li>
        <div class="project-question" role="group" aria-label={`Delete ${project.name}`}>
          <span>Delete {project.name} with its history?</span>
          <button type="button" class="button bad" onClick={() => void studio.projects.delete(project.id)}>Delete</button>
          <button type="button" class="button" ref={(button) => button?.focus()} onClick={() => setMode("row")}>Keep</button>
        </div>
      </li>
    );
  return (
    <li class={open ? "selected" : ""}>
      <button type="button" class="project-name" aria-current={open ? "true" : undefined} onClick={() => void openIt()}>
        <b>{project.name}</b>
        <span class="dim">{agoWords(Date.now() / 1000 - project.changed)}</span>
      </button>
      <button type="button" class="text-button" onClick={() => setMode("rename")} aria-label={`Rename ${project.name}`}>Rename</button>
      <IconButton label={`Duplicate ${project.name}`} onClick={() => void studio.projects.duplicate(project.id)}><Icon name="copy" /></IconButton>
      <IconButton label={`Delete ${project.name}`} onClick={() => setMode("delete")}><Icon name="trash" /></IconButton>
    </li>
  );
}
