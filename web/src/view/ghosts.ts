// Targets as glass: meshes of volumes (blue where they are to be filled, vermilion and hatched where they are to be
// avoided), and thick curves as tubes. Denser towards their outlines, with their creases as lines.
import {
  BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Group, LineSegments, Matrix4, Mesh, RawShaderMaterial, Vector3,
} from "three";
import type { Scene, VolumeMesh } from "../api";
import { readObj } from "./obj";
import type { Palette, Rgb } from "./palette";
import { basisOf, place, placingOf, rayInto } from "./placing";
import { chunkBoxes, hitBox, hitChunks, type Triangles } from "./rays";
import { meshesOf } from "./scene_edits";
import { creases, shapeOf, shapeTriangles } from "./shapes";
import { emptyBox, grow, type Box, type V } from "./vec";

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

/** Runs a long reading in slices of a few milliseconds, so that the page does not stand still. */
async function inSlices<T>(steps: Generator<void, T>): Promise<T> {
  for (let until = performance.now() + 8;;) {
    const step = steps.next();
    if (step.done) return step.value;
    if (performance.now() < until) continue;
    await new Promise((done) => setTimeout(done));
    until = performance.now() + 8;
  }
}

interface Form {
  triangles: Triangles;
  chunks: Float32Array;
  surface: BufferGeometry;
  edges: BufferGeometry;
  box: Box;
}

export function makeForm(triangles: Triangles): Form {
  const surface = new BufferGeometry();
  surface.setAttribute("position", new BufferAttribute(triangles.positions, 3));
  surface.setIndex(new BufferAttribute(triangles.indices, 1));
  surface.computeVertexNormals();
  const edges = new BufferGeometry(), box = emptyBox();
  const lines = triangles.indices.length < kMostCreased ? creases(triangles) : new Float32Array(0);
  edges.setAttribute("position", new BufferAttribute(lines, 3));
  edges.setAttribute("normal", new BufferAttribute(new Float32Array(lines.length), 3));
  const p = triangles.positions;
  for (let i = 0; i < p.length; i += 3) grow(box, [p[i]!, p[i + 1]!, p[i + 2]!]);
  return { triangles, chunks: chunkBoxes(triangles), surface, edges, box };
}

interface Ghost {
  mesh: VolumeMesh;
  form: Form | null;
  surface: Mesh<BufferGeometry, RawShaderMaterial>;
  edges: LineSegments<BufferGeometry, RawShaderMaterial>;
}

const kMostGhosts = 64;
/** Corners of triangles: finding creases takes a second per million. */
const kMostCreased = 60_000;

export class Ghosts {
  readonly group = new Group();
  private readonly forms = new Map<string, Form | "coming" | "failed">();
  private list: Ghost[] = [];
  private palette: Palette | null = null;
  private selected = -1;
  private hidden: readonly number[] = [];

  /** `changed`: a file has come; `failed`: it cannot be shown, and why. */
  constructor(private readonly changed: () => void, private readonly failed: (message: string) => void) {}

  /** `hidden`: meshes by their places that are neither drawn nor picked. */
  setScene(scene: Scene, fileUrl: (path: string) => string, hidden: readonly number[] = []): void {
    this.hidden = hidden;
    const meshes = meshesOf(scene).slice(0, kMostGhosts);
    while (this.list.length > meshes.length) this.drop(this.list.pop()!);
    while (this.list.length < meshes.length) this.list.push(this.make());
    const urls = meshes.map(({ file }) => (shapeOf(file) ? file : fileUrl(file)));
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
      const form = makeForm(shapeTriangles(shape));
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
      if (!answer.ok) throw new Error(`the server answers ${answer.status}`);
      this.forms.set(url, makeForm(await inSlices(readObj(await answer.text()))));
      this.changed();
    } catch (error) {
      this.forms.set(url, "failed");
      this.failed(`${file} cannot be shown: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
}
