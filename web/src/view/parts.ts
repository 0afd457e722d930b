// The model's parts: one instanced draw call per mesh of the table. A message's records are copied once, sorted by mesh, into
// buffers that only ever grow; materials and marks of genes are small textures. Nothing is made per part.
import {
  BufferAttribute, DataTexture, DoubleSide, DynamicDrawUsage, FloatType, GLSL3, Group, InstancedBufferGeometry,
  InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, NearestFilter, RawShaderMaterial, RedFormat, RGBAFormat, UnsignedByteType,
  Vector2, Vector3, Matrix4, type Texture,
} from "three";
import { kInstanceWords, kMaterialFloats, type MeshTable, type ModelMessage } from "./messages";
import { extentOf, kProxy, type Extent } from "./part_picker";
import { kPartsFragment, kPartsVertex, kShadowFragment, kShadowVertex } from "./parts_shader";
import { emptyBox, type Box } from "./vec";

const kMarkWidth = 1024, kMaterialRow = 64;

/** Instances of one mesh. */
interface Batch {
  position: BufferAttribute;
  normal: BufferAttribute;
  index: BufferAttribute;
  mesh: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  buffer: InstancedInterleavedBuffer;
  words: Uint32Array;
  floats: Float32Array;
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
  private materials: DataTexture;

  constructor(shadows: boolean) {
    this.marks = { value: texture(new Uint8Array(kMarkWidth), kMarkWidth, 1, false) };
    this.materials = texture(new Float32Array(12 * kMaterialRow), 3 * kMaterialRow, 1, true);
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kPartsVertex, fragmentShader: kPartsFragment, side: DoubleSide, defines: shadows ? { SHADOWS: 1 } : {},
      uniforms: {
        uMaterials: { value: this.materials }, uMarks: this.marks, uMarkWidth: this.markWidth, uDim: { value: 0 }, uLight: { value: 1 },
        uKey: { value: new Vector3(0.45, 0.8, 0.4).normalize() }, uAccent: { value: [1, 0.6, 0.1] }, uLocked: { value: [0.1, 0.4, 0.9] },
        uShadow: { value: null as Texture | null }, uShadowMatrix: { value: new Matrix4() }, uShadowSize: { value: new Vector2(1, 1) },
      },
    });
    this.shadowMaterial = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kShadowVertex, fragmentShader: kShadowFragment, side: DoubleSide, polygonOffset: true,
      polygonOffsetFactor: 2, polygonOffsetUnits: 4,
    });
  }

  /** New meshes; the parts are gone until a model comes. */
  setMeshes(table: MeshTable): void {
    this.clear();
    this.extents = table.meshes.map(extentOf);
    this.batches = table.meshes.map((mesh) => {
      const position = new BufferAttribute(mesh.positions, 3), normal = new BufferAttribute(mesh.normals, 3);
      const index = new BufferAttribute(mesh.indices, 1);
      const batch = { position, normal, index, count: 0 } as Batch;
      this.reserve(batch, 16);
      return batch;
    });
  }

  /** Copies the model's instances and materials; returns the box around the parts. */
  setModel(model: ModelMessage, table: MeshTable): Box {
    const { words, floats, instances } = model, batches = this.batches;
    const counts = new Uint32Array(batches.length);
    for (let i = 0, w = 14; i < instances; ++i, w += kInstanceWords) ++counts[words[w]! & 0xffff]!;
    batches.forEach((batch, i) => {
      if (batch.floats.length < counts[i]! * kInstanceWords) this.reserve(batch, Math.ceil(counts[i]! * 1.3));
      batch.count = 0;
    });
    const box = emptyBox(), { min, max } = box;
    for (let i = 0, w = 0; i < instances; ++i, w += kInstanceWords) {
      const kinds = words[w + 14]!, number = kinds & 0xffff, batch = batches[number]!;
      const to = batch.count++ * kInstanceWords, target = batch.words, into = batch.floats;
      for (let k = 0; k < 12; ++k) target[to + k] = words[w + k]!;
      // Numbers below 2^24 go as floats: a shader may take the bits of small integers for 0.
      into[to + 12] = table.meshes[number]!.cone ? Math.max(floats[w + 12]!, 0) : 1;
      into[to + 13] = words[w + 13]!;
      into[to + 14] = kinds >>> 16;
      into[to + 15] = words[w + 15]!;
      if (words[w + 15] === kProxy) continue;
      const { middle: m, half: h } = this.extents[number]!, wide = Math.max(1, into[to + 12]!);
      for (let k = 0; k < 3; ++k) {
        const x = floats[w + k]!, y = floats[w + 3 + k]!, z = floats[w + 6 + k]!;
        const at = floats[w + 9 + k]! + x * m[0] + y * m[1] + z * m[2];
        const reach = wide * (Math.abs(x) * h[0] + Math.abs(z) * h[2]) + Math.abs(y) * h[1];
        if (at - reach < min[k]!) min[k] = at - reach;
        if (at + reach > max[k]! && at + reach < Infinity) max[k] = at + reach;
      }
    }
    for (const batch of batches) {
      batch.mesh.geometry.instanceCount = batch.count;
      batch.mesh.visible = batch.count > 0;
      if (batch.count === 0) continue;
      batch.buffer.clearUpdateRanges();
      batch.buffer.addUpdateRange(0, batch.count * kInstanceWords);
      batch.buffer.needsUpdate = true;
    }
    this.setMaterials(model);
    this.reserveMarks(model.genes);
    return box;
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
    (this.materials.image.data as Float32Array).set(model.materialFloats.subarray(0, model.materials * kMaterialFloats));
    this.materials.needsUpdate = true;
  }

  private reserveMarks(genes: number): void {
    const rows = Math.max(1, Math.ceil(genes / kMarkWidth));
    if (this.marks.value.image.height >= rows) return;
    this.marks.value.dispose();
    this.marks.value = texture(new Uint8Array(kMarkWidth * rows * 2), kMarkWidth, rows * 2, false);
  }

  /** A larger buffer, and a geometry that reads it. */
  private reserve(batch: Batch, count: number): void {
    batch.floats = new Float32Array(count * kInstanceWords);
    batch.words = new Uint32Array(batch.floats.buffer);
    batch.buffer = new InstancedInterleavedBuffer(batch.floats, kInstanceWords);
    batch.buffer.setUsage(DynamicDrawUsage);
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", batch.position);
    geometry.setAttribute("normal", batch.normal);
    geometry.setIndex(batch.index);
    ["frameX", "frameY", "frameZ", "origin"].forEach((name, i) =>
      geometry.setAttribute(name, new InterleavedBufferAttribute(batch.buffer, 3, 3 * i)));
    geometry.setAttribute("extra", new InterleavedBufferAttribute(batch.buffer, 4, 12));
    geometry.instanceCount = 0;
    if (batch.mesh) {
      batch.mesh.geometry.dispose();
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
      mesh.geometry.dispose();
      this.group.remove(mesh);
    }
    this.batches = [];
  }
}

function texture(data: Uint8Array<ArrayBuffer> | Float32Array<ArrayBuffer>, width: number, height: number, floats: boolean): DataTexture {
  const result = new DataTexture(data, width, height, floats ? RGBAFormat : RedFormat, floats ? FloatType : UnsignedByteType);
  result.magFilter = result.minFilter = NearestFilter;
  result.unpackAlignment = 1;
  result.needsUpdate = true;
  return result;
}
