// Bottom of the left side: what is wrong, what happened, which files there are.
import { useEffect, useRef, useState } from "preact/hooks";
import type { FileInfo, Problem } from "../api";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";
import { changeBetween, movedPlace } from "../editor/changes";
import { useStudio } from "../shell/studio_context";
import { addMesh, meshesOf } from "../store/scene";
import { addMeshFiles, isMeshFile, meshWords } from "../editor/drop_mesh";
import { pickFile } from "./pick_file";

const kTabs = ["Problems", "Log", "Files"] as const;

export function BottomPane() {
  const studio = useStudio();
  const [tab, setTab] = useState<(typeof kTabs)[number]>("Problems");
  const problems = studio.state.checked.value?.problems ?? [];
  const wrong = problems.some((problem) => problem.severity === "error");
  const files = studio.document.value?.files ?? [];
  const counts = { Problems: problems.length, Log: 0, Files: files.length };
  const move = (event: KeyboardEvent) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    const next = kTabs[(kTabs.indexOf(tab) + step + kTabs.length) % kTabs.length]!;
    setTab(next);
    document.getElementById(`tab-${next}`)?.focus();
  };
  return (
    <section class="bottom-pane" aria-label="Problems, log and files">
      <div role="tablist" aria-label="Problems, log and files" onKeyDown={move}>
        {kTabs.map((name) => (
          <button
            key={name} type="button" role="tab" id={`tab-${name}`} aria-selected={tab === name} aria-controls="bottom-body" tabIndex={tab === name ? 0 : -1}
            onClick={() => setTab(name)}
          >
            {name}
            {counts[name] > 0 && <span class={name !== "Problems" ? "badge quiet" : wrong ? "badge" : "badge doubtful"}>{counts[name]}</span>}
          </button>
        ))}
      </div>
      <div id="bottom-body" class="bottom-body" role="tabpanel" aria-labelledby={`tab-${tab}`} tabIndex={0}>
        {tab === "Problems" ? <Problems problems={problems} /> : tab === "Log" ? <LogLines /> : <FileList files={files} />}
      </div>
    </section>
  );
}

const kMarks = { error: "Error", warning: "Warning", note: "Note" } as const;

function Problems({ problems }: { problems: readonly Problem[] }) {
  const studio = useStudio();
  if (problems.length === 0) return <p class="hint">{studio.state.checked.value === null ? "Not checked yet." : "The grammar is sound."}</p>;
  const text = studio.grammar.value;
  const go = (problem: Problem) => {
    if (problem.at === undefined || problem.file !== undefined) return;
    const checkedText = studio.state.checkedText.value;
    const change = checkedText === null ? null : changeBetween(checkedText, text);
    studio.state.jump.value = { at: { from: movedPlace(change, problem.at.from), to: movedPlace(change, problem.at.to) }, focus: true };
  };
  return (
    <ul class="problems">
      {problems.map((problem, i) => (
        <li key={i}>
          <button type="button" class={`problem ${problem.severity}`} onClick={() => go(problem)}>
            <span class="mark" aria-label={kMarks[problem.severity]} role="img" />
            <span>
              {problem.text} {problem.help !== undefined && <span class="dim">{problem.help}</span>}
            </span>
            <span class="dim place">
              {problem.code}
              {problem.file !== undefined ? ` ${problem.file}` : problem.at !== undefined ? ` line ${lineOf(text, problem.at.from)}` : ""}
            </span>
          </button>
        </li>
      ))}
    </ul>
  );
}

function lineOf(text: string, at: number): number {
  let line = 1;
  for (let i = text.indexOf("\n"); i >= 0 && i < at; i = text.indexOf("\n", i + 1)) line += 1;
  return line;
}

function LogLines() {
  const lines = useStudio().state.log.value;
  const end = useRef<HTMLLIElement>(null);
  useEffect(() => end.current?.scrollIntoView({ block: "nearest" }), [lines.length]);
  if (lines.length === 0) return <p class="hint">Nothing has happened yet.</p>;
  return (
    <ol class="log">
      {lines.map((line, i) => (
        <li key={line.number} class={line.level} ref={i === lines.length - 1 ? end : null}>
          <time dateTime={line.at.toISOString()}>{line.at.toTimeString().slice(0, 8)}</time>
          <span>{line.level !== "info" && <b>{line.level === "error" ? "Error: " : "Warning: "}</b>}{line.text}</span>
          {line.picture !== undefined && <img src={line.picture} alt="" width={64} height={48} onError={(event) => (event.currentTarget.hidden = true)} />}
        </li>
      ))}
    </ol>
  );
}

export function showBytes(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 999_500 ? `${Math.round(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

function FileList({ files }: { files: readonly FileInfo[] }) {
  const studio = useStudio();
  const add = async () => {
    const file = await pickFile(".obj,.glb,.ply,.stl,.png,.jpg,.jpeg,.pfm,.esp");
    if (file === null) return;
    if (isMeshFile(file.name)) await addMeshFiles(studio, [file]);
    else await studio.addFile(file.name, file);
  };
  const asTarget = (path: string) => {
    studio.setScene(`Add ${path}`, addMesh(studio.scene.value, { file: path }));
    studio.select({ kind: "mesh", index: meshesOf(studio.scene.value).length - 1 });
  };
  return (
    <>
      <table class="files">
        <tbody>
          {files.map((file) => (
            <tr key={file.path}>
              <td class="file-picture"><FilePicture file={file} /></td>
              <th scope="row">{file.path}</th>
              <td>{showBytes(file.bytes)}</td>
              <td>{meshWords(file)}</td>
              <td class="file-actions">
                {isMeshFile(file.path) && <IconButton label={`Make ${file.path} a target`} kind="small" onClick={() => asTarget(file.path)}><Icon name="targets" /></IconButton>}
                <IconButton label={`Remove ${file.path}`} kind="small" onClick={() => void studio.ask({ kind: "remove_file", path: file.path })}><Icon name="trash" /></IconButton>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {files.length === 0 && <p class="hint">Drop a mesh on the grammar, or add a file.</p>}
      <button type="button" class="text-button" onClick={() => void add()}>Add a file</button>
    </>
  );
}

/** Meshes as they look, images as they are. */
function FilePicture({ file }: { file: FileInfo }) {
  const studio = useStudio();
  const [gone, setGone] = useState(false);
  const project = studio.document.value?.project.id;
  if (project === undefined || gone) return null;
  const mesh = file.triangles !== undefined;
  if (!mesh && !/\.(png|jpe?g)$/i.test(file.path)) return null;
  const url = mesh ? studio.files.previewUrl(project, file.path) : studio.files.url(project, file.path);
  return <img src={url} alt="" width={48} height={36} loading="lazy" onError={() => setGone(true)} />;
}
