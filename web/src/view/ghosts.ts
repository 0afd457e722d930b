// Targets as glass: meshes of volumes (blue where they are to be filled, vermilion and hatched where they are to be
// avoided), and thick curves as tubes. Denser towards their outlines, with their creases as lines.
import {
  BufferGeometry, DoubleSide, GLSL3, Group, LineSegments, Matrix4, Mesh, RawShaderMaterial, Vector3,
} from "three";
import type { Scene, VolumeMesh } from "../api";
import { makeForm, type Form } from "./form";
import { decodeMeshes } from "./messages";
import type { Palette, Rgb } from "./palette";
import { basisOf, place, placingOf, rayInto } from "./placing";
import { hitBox, hitChunks } from "./rays";
import { meshesOf } from "./scene_edits";
import { shapeOf, shapeTriangles } from "./shapes";
import { atOnce, inSlices } from "./slices";
import { grow, type Box, type V } from "./vec";

const kVertex = `
precision highp float;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
in vec3 position, normal;
out vec3 vWorld, vNormal;
void main() {
  vec4 p = modelMatrix * vec4(position, 1);
  vWorld = p.xyz;
  vec3 x = modelMatrix[0].xyz, y = modelMatrix[1].xyz, z = modelMatrix[2].xyz;
  vNormal = cross(y, z) * normal.x + cross(z, x) * normal.y + cross(x, y) * normal.z;
  gl_Position = projectionMatrix * viewMatrix * p;
}`;

const kFragment = `
precision highp float;
uniform vec3 cameraPosition, uColour;
uniform float uHatch, uStrength, uLine;
in vec3 vWorld, vNormal;
out vec4 outColour;
void main() {
  float l = length(vNormal);
  float facing = l > 0.0 ? abs(dot(vNormal / l, normalize(cameraPosition - vWorld))) : 1.0;
  float alpha = uStrength * (0.10 + 0.42 * pow(1.0 - facing, 2.5));
  if (uHatch > 0.0 && mod(gl_FragCoord.x - gl_FragCoord.y, 12.0) < 2.0) alpha += 0.16 * uStrength;
  if (uLine > 0.0) alpha = uLine;
  outColour = vec4(uColour, alpha);
}`;

export function glass(line = 0): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment, transparent: true, depthWrite: false,
    side: DoubleSide,
    uniforms: { uColour: { value: [1, 1, 1] as Rgb }, uHatch: { value: 0 }, uStrength: { value: 1 },
      uLine: { value: line } },
  });
}

interface Ghost {
  mesh: VolumeMesh;
  form: Form | null;
  surface: Mesh<BufferGeometry, RawShaderMaterial>;
  edges: LineSegments<BufferGeometry, RawShaderMaterial>;
}

const kMostGhosts = 64;
/** Of a mesh with more the server sends the box around it. */
const kMostTriangles = 300_000;

export class Ghosts {
  readonly group = new Group();
  private readonly forms = new Map<string, Form | "coming" | "failed">();
  private list: Ghost[] = [];
  private palette: Palette | null = null;
  private selected = -1;
  private hidden: readonly number[] = [];

  /** `changed`: a file has come; `failed`: it cannot be shown as it is, and why. */
  constructor(private readonly changed: () => void, private readonly failed: (message: string) => void) {}

  /** `meshUrl`: where a file is to be had as one mesh (ESPG). `hidden`: meshes by their places that are neither drawn nor
   *  picked. */
  setScene(scene: Scene, meshUrl: (path: string) => string, hidden: readonly number[] = []): void {
    this.hidden = hidden;
    const meshes = meshesOf(scene).slice(0, kMostGhosts);
    while (this.list.length > meshes.length) this.drop(this.list.pop()!);
    while (this.list.length < meshes.length) this.list.push(this.make());
    const urls = meshes.map(({ file }) => (shapeOf(file) ? file : meshUrl(file)));
    meshes.forEach((mesh, i) => {
      const ghost = this.list[i]!;
      ghost.mesh = mesh;
      ghost.form = this.form(mesh.file, urls[i]!);
      if (ghost.form) {
        ghost.surface.geometry = ghost.form.surface;
        ghost.edges.geometry = ghost.form.edges;
      }
      ghost.surface.visible = ghost.edges.visible = ghost.form !== null && !hidden.includes(i);
      const p = placingOf(mesh), [x, y, z] = basisOf(p);
      const matrix = new Matrix4().makeBasis(new Vector3(...x), new Vector3(...y),
        new Vector3(...z)).setPosition(...p.position as [number, number, number]);
      for (const object of [ghost.surface, ghost.edges]) {
        object.matrix.copy(matrix);
        object.matrixWorldNeedsUpdate = true;
      }
    });
    this.forget(new Set(urls));
    this.paint();
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.paint();
  }

  select(index: number): void {
    this.selected = index;
    this.paint();
  }

  /** Box of a mesh in its file's own space; the unit box while it is not there. */
  boxOf(index: number): Box {
    return this.list[index]?.form?.box ?? { min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, 0.5] };
  }

  /** The nearest ghost under a ray of length 1. */
  pick(origin: V, direction: V): { index: number; t: number } | null {
    let best: { index: number; t: number } | null = null;
    this.list.forEach(({ mesh, form }, index) => {
      const ray = form && !this.hidden.includes(index) && rayInto(placingOf(mesh), origin, direction);
      if (!ray || hitBox(ray.origin, ray.direction, form.box.min, form.box.max) === Infinity) return;
      const t = hitChunks(ray.origin, ray.direction, form.triangles, form.chunks);
      if (t < (best?.t ?? Infinity)) best = { index, t };
    });
    return best;
  }

  addTo(box: Box): void {
    this.list.forEach(({ mesh }, index) => {
      if (this.hidden.includes(index)) return;
      const { min, max } = this.boxOf(index), p = placingOf(mesh);
      for (let corner = 0; corner < 8; ++corner) {
        grow(box, place(p, [corner & 1 ? max[0] : min[0], corner & 2 ? max[1] : min[1], corner & 4 ? max[2] : min[2]]));
      }
    });
  }

  dispose(): void {
    for (const ghost of this.list) this.drop(ghost);
    for (const form of this.forms.values()) {
      if (typeof form === "string") continue;
      form.surface.dispose();
      form.edges.dispose();
    }
  }

  private make(): Ghost {
    const empty = new BufferGeometry();
    const surface = new Mesh(empty, glass()), edges = new LineSegments(empty, glass(0.55));
    for (const object of [surface, edges]) {
      object.matrixAutoUpdate = false;
      object.frustumCulled = false;
      object.renderOrder = 1;
      this.group.add(object);
    }
    return { mesh: { file: "" }, form: null, surface, edges };
  }

  private drop({ surface, edges }: Ghost): void {
    this.group.remove(surface, edges);
    surface.material.dispose();
    edges.material.dispose();
  }

  private paint(): void {
    this.list.forEach(({ mesh, surface, edges }, i) => {
      const avoid = (mesh.fill ?? 1) < 0, colour = this.palette
        ? (avoid ? this.palette.avoid : this.palette.want) : [1, 1, 1];
      surface.material.uniforms["uColour"]!.value = edges.material.uniforms["uColour"]!.value = colour;
      surface.material.uniforms["uHatch"]!.value = avoid ? 1 : 0;
      surface.material.uniforms["uStrength"]!.value = i === this.selected ? 1.5 : 1;
      edges.material.uniforms["uLine"]!.value = i === this.selected ? 0.95 : 0.5;
    });
  }

  /** By address: a file that was replaced has another one, if the page says so in it. */
  private form(file: string, url: string): Form | null {
    const known = this.forms.get(url);
    if (known) return typeof known === "string" ? null : known;
    const shape = shapeOf(file);
    if (shape) {
      const form = atOnce(makeForm(shapeTriangles(shape)));
      this.forms.set(url, form);
      return form;
    }
    this.forms.set(url, "coming");
    void this.fetch(file, url);
    return null;
  }

  /** Forgets files that no mesh names any more, so that one that failed is asked for again when it is named again. */
  private forget(used: ReadonlySet<string>): void {
    for (const [url, form] of this.forms) {
      if (used.has(url) || form === "coming") continue;
      this.forms.delete(url);
      if (form === "failed") continue;
      form.surface.dispose();
      form.edges.dispose();
    }
  }

  private async fetch(file: string, url: string): Promise<void> {
    try {
      const answer = await fetch(url);
      if (!answer.ok) throw new Error((await answer.text()).trim() || `the server answers ${answer.status}`);
      const { number, meshes: [mesh] } = decodeMeshes(await answer.arrayBuffer());
      if (!mesh || mesh.indices.length === 0) throw new Error("it has no triangles");
      this.forms.set(url, await inSlices(makeForm(mesh)));
      this.changed();
      if (number > kMostTriangles) this.failed(`${file} has ${number} triangles: the box around it is shown`);
    } catch (error) {
      this.forms.set(url, "failed");
      this.failed(`${file} cannot be shown: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
}
