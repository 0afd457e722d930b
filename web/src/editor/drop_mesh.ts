import type { Studio } from "../store/studio";
import { meshName, placeForMesh } from "./scan";

/** Larger files are refused before they are sent. */
export const kMeshBytes = 64 * 1024 * 1024;

export function isMeshFile(name: string): boolean {
  return /\.(obj|glb|ply|stl)$/i.test(name);
}

/** Adds files to the project, and for each a `mesh` line to the grammar. */
export async function addMeshFiles(
  studio: Studio, files: readonly File[], insertLine: (at: number, line: string) => void, text: () => string,
): Promise<void> {
  for (const file of files) {
    if (file.size > kMeshBytes) {
      studio.tell(`${file.name} has ${Math.round(file.size / 1048576)} MB; at most 64 MB can be added.`, true);
      continue;
    }
    const path = await studio.addFile(file.name, file);
    if (path === null) continue;
    const name = meshName(text(), path);
    insertLine(placeForMesh(text()), `mesh ${name} = "${path}"`);
    studio.tell(`${path} is in the project; the grammar calls it ${name}.`);
  }
}
