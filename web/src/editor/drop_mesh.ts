import { effect } from "@preact/signals";
import type { FileInfo } from "../api";
import { showNumber, thousands } from "../controls/number";
import type { Studio } from "../store/studio";
import { meshName, placeForMesh } from "./scan";

/** Larger files are refused before they are sent. */
export const kMeshBytes = 64 * 1024 * 1024;
const kArrivalMilliseconds = 5000;

export function isMeshFile(name: string): boolean {
  return /\.(obj|glb|ply|stl)$/i.test(name);
}

/** "12 triangles, 1 × 2 × 1 m" */
export function meshWords({ triangles, size }: FileInfo): string {
  const count = triangles === undefined ? "" : `${thousands(triangles)} ${triangles === 1 ? "triangle" : "triangles"}`;
  const room = size === undefined ? "" : `${size.map(showNumber).join(" × ")} m`;
  return [count, room].filter((part) => part !== "").join(", ");
}

/** What the server says of a file that was uploaded: with the next document; null where it does not come. */
function arrived(studio: Studio, path: string): Promise<FileInfo | null> {
  const find = () => studio.state.confirmed.value?.files.find((file) => file.path === path);
  return new Promise((done) => {
    let stop: (() => void) | null = null;
    const end = (facts: FileInfo | null) => {
      cancel();
      queueMicrotask(() => stop?.());
      done(facts);
    };
    const cancel = studio.later(kArrivalMilliseconds, () => end(null));
    stop = effect(() => {
      const facts = find();
      if (facts !== undefined) end(facts);
    });
  });
}

/** Adds files to the project, and for each a `mesh` line to the grammar, where the cursor goes. */
export async function addMeshFiles(studio: Studio, files: readonly File[]): Promise<void> {
  for (const file of files) {
    if (file.size > kMeshBytes) {
      studio.tell(`${file.name} has ${Math.round(file.size / 1048576)} MB; at most 64 MB can be added.`, true);
      continue;
    }
    const path = await studio.addFile(file.name, file);
    if (path === null) continue;
    const text = studio.grammar.peek();
    const name = meshName(text, path);
    const at = placeForMesh(text);
    const line = `${at > 0 && text[at - 1] !== "\n" ? "\n" : ""}mesh ${name} = "${path}"`;
    studio.setGrammar(`Add mesh ${name}`, `${text.slice(0, at)}${line}\n${text.slice(at)}`);
    studio.state.jump.value = { at: { from: at + line.length, to: at + line.length }, focus: false };
    const project = studio.document.peek()?.project.id;
    const facts = await arrived(studio, path);
    const words = facts === null ? "" : `: ${meshWords(facts)}`;
    studio.tell(`${path}${words}. The grammar calls it ${name}.`, false, project === undefined ? {} : { picture: studio.files.previewUrl(project, path) });
  }
}
