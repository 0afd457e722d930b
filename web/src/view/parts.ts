// The model's parts: one instanced draw call per mesh of the table. A message's records are copied once, sorted by
// mesh, into a texture that only ever grows; materials and marks of genes are small textures. Nothing is made per part.
import {
  DataTexture, DoubleSide, DynamicDrawUsage, FloatType, GLSL3, Group, InstancedBufferAttribute, InstancedBufferGeometry,
  Mesh, NearestFilter, RawShaderMaterial, RedFormat, RGBAFormat, UnsignedByteType,
  Vector2, Vector3, Matrix4, type Texture,
} from "three";
import type { Coarseness } from "./coarse_mesh";
import { packsOf, type MeshPack } from "./mesh_packs";
import { kInstanceWords, kMaterialFloats, type MeshTable, type ModelMessage } from "./messages";
import { PartBox } from "./part_box";
import { extentOf, kProxy, type Extent } from "./part_picker";
import { kPartsFragment, kPartsVertex, kShadowFragment, kShadowVertex } from "./parts_shader";
import type { Box } from "./vec";

const kMarkWidth = 1024, kMaterialRow = 64;
/** Of the texture of instances: 4 texels each. */
const kInstanceRow = 256;
/** What every WebGL 2 has. */
const kMostRows = 2048;
/** Shorter runs are copied word by word: a view into the message for each would cost more than it saves. */
const kRun = 32;

/** Instances of one mesh. */
interface Batch {
  pack: MeshPack;
  mesh: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  /** Per pack: number of its first instance, and of that after the last of the batch. */
  range: InstancedBufferAttribute;
  count: number;
}

export class Parts {
  readonly group = new Group();
  readonly material: RawShaderMaterial;
  readonly shadowMaterial: RawShaderMaterial;
  readonly marks: { value: DataTexture };
  readonly markWidth = { value: kMarkWidth };
  extents: Extent[] = [];
  private batches: Batch[] = [];
  private quick = false;
  private readonly instances: { value: DataTexture };
  private floats!: Float32Array;
  private words!: Uint32Array;
  private materials: DataTexture;

  constructor(shadows: boolean, private readonly coarseness: Coarseness) {
    this.marks = { value: texture(new Uint8Array(kMarkWidth), kMarkWidth, 1, false) };
    this.instances = { value: this.newInstances(1) };
    this.materials = texture(new Float32Array(12 * kMaterialRow), 3 * kMaterialRow, 1, true);
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kPartsVertex, fragmentShader: kPartsFragment, side: DoubleSide,
      defines: shadows ? { SHADOWS: 1 } : {},
      uniforms: {
        uInstances: this.instances, uMaterials: { value: this.materials }, uMarks: this.marks, uMarkWidth: this.markWidth, uDim: { value: 0 },
        uLight: { value: 1 },
        uKey: { value: new Vector3(0.45, 0.8, 0.4).normalize() }, uAccent: { value: [1, 0.6, 0.1] },
        uLocked: { value: [0.1, 0.4, 0.9] },
        uShadow: { value: null as Texture | null }, uShadowMatrix: { value: new Matrix4() },
        uShadowSize: { value: new Vector2(1, 1) },
      },
    });
    this.shadowMaterial = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kShadowVertex, fragmentShader: kShadowFragment, side: DoubleSide,
      uniforms: { uInstances: this.instances },
      polygonOffset: true,
      polygonOffsetFactor: 2, polygonOffsetUnits: 4,
    });
  }

  /** New meshes; the parts are gone until a model comes. */
  setMeshes(table: MeshTable): void {
    this.clear();
    this.extents = table.meshes.map(extentOf);
    this.batches = packsOf(table, this.coarseness).map((pack) => {
      const batch = { pack, count: 0 } as Batch;
      this.reserve(batch, 1);
      return batch;
    });
  }

  /** Whether frames must be quick from here on, at the price of shape. */
  setQuick(quick: boolean): void {
    if (quick === this.quick) return;
    this.quick = quick;
    for (const batch of this.batches) this.setIndex(batch);
  }

  /** Copies the model's instances and materials; returns the box around the parts. */
  setModel(model: ModelMessage, table: MeshTable): Box {
    const { words, floats, instances } = model, batches = this.batches;
    const counts = new Uint32Array(batches.length), next = new Uint32Array(batches.length);
    for (let i = 0, w = 14; i < instances; ++i, w += kInstanceWords) ++counts[words[w]! & 0xffff]!;
    let first = 0;
    batches.forEach((batch, i) => {
      this.setRange(batch, next[i] = first, counts[i]!);
      first += counts[i]!;
    });
    this.reserveInstances(instances);
    const box = new PartBox();
    // Runs of one mesh are copied at once: servers tend to send them so.
    for (let i = 0; i < instances;) {
      const number = words[i * kInstanceWords + 14]! & 0xffff, first = i;
      while (++i < instances && (words[i * kInstanceWords + 14]! & 0xffff) === number);
      const from = first * kInstanceWords, length = (i - first) * kInstanceWords, at = next[number]! * kInstanceWords;
      if (i - first > kRun) this.words.set(words.subarray(from, from + length), at);
      else for (let k = 0, target = this.words; k < length; ++k) target[at + k] = words[from + k]!;
      const cone = table.meshes[number]!.cone, extent = this.extents[number]!, into = this.floats;
      for (let w = from, to = at; w < from + length; w += kInstanceWords, to += kInstanceWords) {
        // Numbers below 2^24 go as floats: a shader may take the bits of small integers for 0.
        const top = cone ? Math.max(floats[w + 12]!, 0) : 1, layer = words[w + 15]!;
        into[to + 12] = top;
        into[to + 13] = words[w + 13]!;
        into[to + 14] = words[w + 14]! >>> 16;
        into[to + 15] = layer;
        if (layer !== kProxy) box.add(floats, w, extent, top > 1 ? top : 1);
      }
      next[number]! += i - first;
    }
    this.instances.value.needsUpdate = true;
    this.setMaterials(model);
    this.reserveMarks(model.genes);
    return box.box();
  }

  /** One byte per gene; call `marksChanged` after writing. */
  get markBytes(): Uint8Array {
    return this.marks.value.image.data as Uint8Array;
  }

  marksChanged(): void {
    this.marks.value.needsUpdate = true;
  }

  uniform(name: string, value: unknown): void {
    this.material.uniforms[name]!.value = value;
  }

  dispose(): void {
    this.clear();
    this.marks.value.dispose();
    this.instances.value.dispose();
    this.materials.dispose();
    this.material.dispose();
    this.shadowMaterial.dispose();
  }

  private setMaterials(model: ModelMessage): void {
    const rows = Math.max(1, Math.ceil(model.materials / kMaterialRow));
    if (this.materials.image.height < rows) {
      this.materials.dispose();
      this.materials = texture(new Float32Array(12 * kMaterialRow * rows), 3 * kMaterialRow, rows, true);
      this.uniform("uMaterials", this.materials);
    }
    (this.materials.image.data as Float32Array).set(model.materialFloats.subarray(0,
      model.materials * kMaterialFloats));
    this.materials.needsUpdate = true;
  }

  private reserveMarks(genes: number): void {
    const rows = Math.max(1, Math.ceil(genes / kMarkWidth));
    if (this.marks.value.image.height >= rows) return;
    this.marks.value.dispose();
    this.marks.value = texture(new Uint8Array(kMarkWidth * rows * 2), kMarkWidth, rows * 2, false);
  }

  private newInstances(rows: number): DataTexture {
    this.floats = new Float32Array(kInstanceWords * kInstanceRow * rows);
    this.words = new Uint32Array(this.floats.buffer);
    return texture(this.floats as Float32Array<ArrayBuffer>, 4 * kInstanceRow, rows, true);
  }

  private reserveInstances(count: number): void {
    if (count * kInstanceWords <= this.floats.length) return;
    this.instances.value.dispose();
    const rows = Math.ceil(count / kInstanceRow);
    this.instances.value = this.newInstances(Math.max(rows, Math.min(Math.ceil(1.2 * rows), kMostRows)));
  }

  private setRange(batch: Batch, first: number, count: number): void {
    const { copies } = batch.pack, packs = Math.ceil(count / copies);
    if (packs > batch.range.count) this.reserve(batch, Math.ceil(1.3 * packs));
    batch.count = count;
    batch.mesh.visible = count > 0;
    batch.mesh.geometry.instanceCount = packs;
    for (let i = 0; i < packs; ++i) batch.range.setXY(i, first + i * copies, first + count);
    batch.range.needsUpdate = true;
    this.setIndex(batch);
  }

  /** Of a pack that is not full, copies that there are. */
  private setIndex({ pack, mesh, count }: Batch): void {
    const index = this.quick ? pack.coarse : pack.index, { geometry } = mesh;
    geometry.setIndex(index);
    geometry.setDrawRange(0, count < pack.copies ? index.count / pack.copies * count : Infinity);
  }

  /** Room for more packs, and a geometry that reads them. */
  private reserve(batch: Batch, packs: number): void {
    const { pack } = batch, geometry = new InstancedBufferGeometry();
    batch.range = new InstancedBufferAttribute(new Float32Array(2 * packs), 2);
    batch.range.setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", pack.position);
    geometry.setAttribute("normal", pack.normal);
    geometry.setAttribute("copy", pack.copy);
    geometry.setAttribute("range", batch.range);
    geometry.instanceCount = 0;
    if (batch.mesh) {
      forget(batch.mesh.geometry);
      batch.mesh.geometry = geometry;
      return;
    }
    batch.mesh = new Mesh(geometry, this.material);
    batch.mesh.frustumCulled = false;
    batch.mesh.matrixAutoUpdate = false;
    this.group.add(batch.mesh);
  }

  private clear(): void {
    for (const { mesh } of this.batches) {
      forget(mesh.geometry);
      this.group.remove(mesh);
    }
    this.batches = [];
  }
}

/** But for what others share. */
function forget(geometry: InstancedBufferGeometry): void {
  for (const shared of ["position", "normal", "copy"]) geometry.deleteAttribute(shared);
  geometry.setIndex(null);
  geometry.dispose();
}

function texture(data: Uint8Array<ArrayBuffer> | Float32Array<ArrayBuffer>, width: number, height: number,
  floats: boolean): DataTexture {
  const result = new DataTexture(data, width, height, floats ? RGBAFormat : RedFormat, floats
    ? FloatType : UnsignedByteType);
  result.magFilter = result.minFilter = NearestFilter;
  result.unpackAlignment = 1;
  result.needsUpdate = true;
  return result;
}
