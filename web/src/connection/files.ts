// What goes over plain HTTP: files to and from a project (docs/studio-protocol.md).

export type ExportFormat = "glb" | "lods" | "obj" | "ply" | "stl" | "png" | "zip" | "espalier";

export type IndividualFormat = Exclude<ExportFormat, "espalier">;

export class Files {
  constructor(
    private readonly base: string,
    private readonly token: string,
  ) {}

  /** Address of a file of a project. */
  url(project: number, path: string): string {
    return this.address(`projects/${project}/files/${path.split("/").map(encodeURIComponent).join("/")}`);
  }

  /** A mesh of a project as the view draws it (ESPG), whatever its format. */
  meshUrl(project: number, path: string): string {
    return this.address(`projects/${project}/meshes/${path.split("/").map(encodeURIComponent).join("/")}`);
  }

  /** A small picture of a mesh of a project. */
  previewUrl(project: number, path: string): string {
    return this.address(`projects/${project}/previews/${path.split("/").map(encodeURIComponent).join("/")}`);
  }

  favouriteUrl(project: number, favourite: number): string {
    return this.address(`projects/${project}/favourites/${favourite}`);
  }

  /** Of a path that the server named. */
  sampleUrl(path: string): string {
    return this.address(path);
  }

  exportUrl(project: number, format: ExportFormat): string {
    return this.address(`projects/${project}/export/${format}`);
  }

  /** Throws an Error with the server's own words. */
  async upload(project: number, name: string, content: Blob): Promise<void> {
    await this.post(`projects/${project}/files/${encodeURIComponent(name)}`, content);
  }

  /** Number of the new project. */
  async importProject(content: Blob): Promise<number> {
    const text = await this.post("projects/import", content);
    const number = /\d+/.exec(text);
    if (number === null) throw new Error("The server did not say which project it made.");
    return Number(number[0]);
  }

  /** A session of the breeding room as a file. */
  breedingUrl(project: number, session: number): string {
    return this.address(`projects/${project}/breeding/${session}/export`);
  }

  individualUrl(project: number, session: number, individual: number, format: IndividualFormat): string {
    return this.address(`projects/${project}/breeding/${session}/model/${individual}/${format}`);
  }

  /** A zip of `count` relatives, each of at most `triangles`. */
  speciesUrl(project: number, session: number, individual: number, count: number, triangles: number): string {
    return this.address(`projects/${project}/breeding/${session}/species/${individual}/${count}/${triangles}`);
  }

  /** Number of the new session. */
  async importBreeding(project: number, content: Blob): Promise<number> {
    const number = /\d+/.exec(await this.post(`projects/${project}/breeding/import`, content));
    if (number === null) throw new Error("The server did not say which session it made.");
    return Number(number[0]);
  }

  private address(path: string): string {
    return `${new URL(path, this.base).pathname}?${new URLSearchParams({ token: this.token })}`;
  }

  private async post(path: string, body: Blob): Promise<string> {
    let response: Response;
    try {
      response = await fetch(new URL(path, this.base).pathname, {
        method: "POST",
        body,
        headers: { "X-Espalier-Token": this.token },
      });
    } catch {
      throw new Error("The server cannot be reached.");
    }
    const text = await response.text();
    if (!response.ok) throw new Error(text.trim() || `The server answered ${response.status}.`);
    return text;
  }
}

/** A name for a file that the project does not have yet, of plain letters: `my tree.obj` -> `my-tree.obj`, `my-tree-2.obj`. */
export function freeName(name: string, taken: readonly string[]): string {
  const end = /\.[A-Za-z0-9]{1,9}$/.exec(name)?.[0].toLowerCase() ?? "";
  const stem = name
    .slice(0, name.length - end.length)
    .replace(/[^A-Za-z0-9_-]+/g, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, 60);
  const first = stem || "file";
  for (let n = 1; ; ++n) {
    const candidate = n === 1 ? first + end : `${first}-${n}${end}`;
    if (!taken.includes(candidate)) return candidate;
  }
}
