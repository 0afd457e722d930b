// Messages as the server would send them, for tests and the harness: meshes, and a tree of cones, boxes and leaves.
import { shapeTriangles } from "../../src/view/shapes";
import type { Triangles } from "../../src/view/rays";

export interface TestMesh extends Triangles {
  cone?: boolean;
  normals?: Float32Array;
}

function flatNormals({ positions, indices }: Triangles): Float32Array {
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [0, 1, 2].map((i) => positions[3 * indices[t + k]! + i]!));
    const u = [0, 1, 2].map((i) => b![i]! - a![i]!), v = [0, 1, 2].map((i) => c![i]! - a![i]!);
    const n = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
    for (let k = 0; k < 3; ++k) for (let i = 0; i < 3; ++i) normals[3 * indices[t + k]! + i]! += n[i]!;
  }
  for (let i = 0; i < normals.length; i += 3) {
    const l = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k]! /= l;
  }
  return normals;
}

class Writer {
  private readonly bytes: ArrayBuffer;
  private readonly data: DataView;
  private at = 0;

  constructor(size: number, letters: string) {
    this.bytes = new ArrayBuffer(size);
    this.data = new DataView(this.bytes);
    for (const letter of letters) this.data.setUint8(this.at++, letter.charCodeAt(0));
    this.u32(1);
  }

  u32(...values: number[]): this {
    for (const v of values) { this.data.setUint32(this.at, v >>> 0, true); this.at += 4; }
    return this;
  }

  f32(...values: number[]): this {
    for (const v of values) { this.data.setFloat32(this.at, v, true); this.at += 4; }
    return this;
  }

  end(): ArrayBuffer {
    if (this.at !== this.bytes.byteLength) throw new Error(`${this.at} of ${this.bytes.byteLength} bytes written`);
    return this.bytes;
  }
}

export function meshMessage(number: number, meshes: readonly TestMesh[]): ArrayBuffer {
  const size = meshes.reduce((sum, m) => sum + 12 + m.positions.length * 8 + m.indices.length * 4, 16);
  const w = new Writer(size, "ESPG").u32(number, meshes.length);
  for (const mesh of meshes) {
    w.u32(mesh.positions.length / 3, mesh.indices.length / 3, mesh.cone ? 1 : 0);
    w.f32(...mesh.positions).f32(...(mesh.normals ?? flatNormals(mesh))).u32(...mesh.indices);
  }
  return w.end();
}

export interface TestInstance {
  /** Three columns and origin. */
  frame: number[];
  top?: number;
  gene?: number;
  mesh?: number;
  material?: number;
  layer?: number;
}

export interface TestModel {
  number?: number;
  table?: number;
  instances: readonly TestInstance[];
  bones?: readonly { from: number[]; to: number[]; gene?: number; parent?: number }[];
  materials?: readonly number[][];
  /** rule, parent */
  genes?: readonly (readonly [number, number])[];
}

export function modelMessage(m: TestModel): ArrayBuffer {
  const bones = m.bones ?? [], materials = m.materials ?? [[0.5, 0.5, 0.5, 1, 0, 0, 0, 0, 0.6, 0, 0, 0]],
    genes = m.genes ?? [[0, -1]];
  const w = new Writer(32 + 64 * m.instances.length + 32 * bones.length + 48 * materials.length + 8 * genes.length,
    "ESPM");
  w.u32(m.number ?? 1, m.instances.length, bones.length, materials.length, genes.length, m.table ?? 1);
  for (const i of m.instances) w.f32(...i.frame, i.top ?? 1).u32(i.gene ?? 0, (i.mesh ?? 0) | (i.material ?? 0) << 16,
    i.layer ?? 0);
  for (const b of bones) w.f32(...b.from, ...b.to).u32(b.gene ?? 0, b.parent ?? -1);
  for (const material of materials) w.f32(...material);
  for (const [rule, parent] of genes) w.u32(rule, parent);
  return w.end();
}

export function cloudMessage(rule: string, points: readonly (readonly [number, number, number,
  number])[]): ArrayBuffer {
  const name = new TextEncoder().encode(rule), padded = Math.ceil(name.length / 4) * 4;
  const w = new Writer(16 + padded + 16 * points.length, "ESPC").u32(name.length, points.length);
  for (let i = 0; i < padded; i += 4) w.u32([0, 1, 2, 3].reduce((sum, k) => sum + ((name[i + k] ?? 0) << (8 * k)), 0));
  for (const [x, y, z, kind] of points) w.f32(x, y, z).u32(kind);
  return w.end();
}

/** Box, cone, sphere, leaf. */
export function treeMeshes(): TestMesh[] {
  const leaf: TestMesh = {
    positions: new Float32Array([-0.5, 0, 0, 0, -0.5, 0, 0.5, 0, 0, 0, 0.5, 0]),
    indices: new Uint32Array([0, 1, 2, 0, 2, 3]),
    normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]),
  };
  return [shapeTriangles("box"), { ...cone(10), cone: true }, sphere(), leaf];
}

function cone(sides: number): TestMesh {
  const positions: number[] = [], normals: number[] = [], indices: number[] = [];
  for (let i = 0; i <= sides; ++i) {
    const a = (2 * Math.PI * i) / sides, x = Math.cos(a), z = Math.sin(a);
    positions.push(x / 2, -0.5, z / 2, x / 2, 0.5, z / 2);
    normals.push(x, 0, z, x, 0, z);
    if (i < sides) indices.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3);
  }
  return { positions: new Float32Array(positions), normals: new Float32Array(normals),
    indices: new Uint32Array(indices) };
}

function sphere(): TestMesh {
  const s = shapeTriangles("sphere");
  return { ...s, normals: s.positions.map((x) => 2 * x) };
}

function mulberry(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A tree of about `parts` instances: boughs as cones, each with leaves; rules Trunk, Bough, Leaf. */
export function treeModel(parts: number, number = 1, seed = 1): ArrayBuffer {
  const random = mulberry(seed), instances: TestInstance[] = [], bones: NonNullable<TestModel["bones"]>[number][] = [];
  const genes: [number, number][] = [[0, -1]];
  const queue = [{ from: [0, 0, 0], direction: [0, 1, 0], length: 1.4, radius: 0.16, gene: 0, bone: -1, level: 0 }];
  while (queue.length > 0 && instances.length < parts) {
    const b = queue.shift()!, d = b.direction, side = norm(Math.abs(d[1]!) < 0.9
      ? cross(d, [0, 1, 0]) : cross(d, [1, 0, 0]));
    const other = cross(side, d), to = b.from.map((x, i) => x + d[i]! * b.length), wide = 2 * b.radius;
    const frame = [...side.map((x) => x * wide), ...d.map((x) => x * b.length), ...other.map((x) => x * wide),
      ...b.from.map((x, i) => (x + to[i]!) / 2)];
    instances.push({ frame, top: 0.72, gene: b.gene, mesh: 1, material: 0 });
    bones.push({ from: b.from, to, gene: b.gene, parent: b.bone });
    const bone = bones.length - 1;
    if (b.level > 3) {
      for (let i = 0; i < 3 && instances.length < parts; ++i) {
        const at = to.map((x) => x + (random() - 0.5) * 0.22),
          n = norm([random() - 0.5, random() + 0.2, random() - 0.5]);
        const u = norm(cross(n, [0.3, 1, 0.2])), v = cross(n, u), size = 0.10 + 0.08 * random();
        genes.push([2, b.gene]);
        instances.push({
          frame: [...u.map((x) => x * size), ...v.map((x) => x * size * 1.7), ...n.map((x) => x * size), ...at],
          gene: genes.length - 1, mesh: 3, material: 1 + Math.floor(random() * 3),
        });
      }
    }
    const count = b.level === 0 ? 4 : 2 + Math.floor(random() * 2);
    for (let i = 0; i < count; ++i) {
      const turn = 6.2831853 * (i + random() * 0.6) / count, lean = 0.35 + 0.4 * random();
      const out = side.map((x, k) => x * Math.cos(turn) + other[k]! * Math.sin(turn));
      genes.push([1, b.gene]);
      queue.push({
        from: to, direction: norm(d.map((x, k) => x * Math.cos(lean) + out[k]! * Math.sin(lean) +
          (k === 1 ? 0.06 : 0))),
        length: b.length * (0.68 + 0.16 * random()), radius: b.radius * 0.68, gene: genes.length - 1, bone,
        level: b.level + 1,
      });
    }
  }
  const materials = [
    [0.12, 0.07, 0.04, 1, 0, 0, 0, 0, 0.8, 0, 0, 0], [0.10, 0.26, 0.05, 1, 0, 0, 0, 0, 0.55, 0, 0, 0],
    [0.19, 0.34, 0.06, 1, 0, 0, 0, 0, 0.55, 0, 0, 0], [0.35, 0.36, 0.05, 1, 0, 0, 0, 0, 0.5, 0, 0, 0],
    [0.9, 0.6, 0.25, 1, 0, 0, 0, 0, 0.25, 1, 0, 0], [0.05, 0.1, 0.3, 1, 0, 0, 0, 0, 0.12, 0, 0, 0],
  ];
  instances.push({ frame: [0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5, 1.2, 0.25, 0.6], mesh: 0, material: 4 });
  instances.push({ frame: [0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5, -1, 0.25, 0.8], mesh: 2, material: 5 });
  return modelMessage({ number, instances, bones, materials, genes });
}

const cross = (a: number[], b: number[]): number[] =>
  [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
const norm = (a: number[]): number[] => { const l = Math.hypot(...a) || 1; return a.map((x) => x / l); };
