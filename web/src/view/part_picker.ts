// Which part lies under a ray. Balls around all parts are kept (4 floats each, made at the first question after a model
// came); those that the ray meets are tried from near to far: box, then triangles. Shared buffers, nothing is made per
// part.
import type { MeshData, ModelMessage } from "./messages";
import { kGeneWord, kInstanceWords } from "./messages";
import { hitBox, hitTriangles } from "./rays";
import { emptyBox, grow, isEmpty, type Box, type V } from "./vec";

/** Box around a mesh, and a ball around the box. */
export interface Extent {
  box: Box;
  middle: [number, number, number];
  half: [number, number, number];
}

/** Proxies stand in for details in some targets' eyes; they are not drawn and not picked. */
export const kProxy = 1;

export function extentOf(mesh: Pick<MeshData, "positions" | "cone">): Extent {
  const box = emptyBox();
  for (let i = 0; i + 2 < mesh.positions.length; i += 3) {
    grow(box, [mesh.positions[i]!, mesh.positions[i + 1]!, mesh.positions[i + 2]!]);
  }
  if (isEmpty(box)) return { box: { min: [0, 0, 0], max: [0, 0, 0] }, middle: [0, 0, 0], half: [0, 0, 0] };
  const part = (f: (i: 0 | 1 | 2) => number): [number, number, number] => [f(0), f(1), f(2)];
  return {
    box, middle: part((i) => (box.min[i] + box.max[i]) / 2), half: part((i) => (box.max[i] - box.min[i]) / 2),
  };
}

export interface Hit {
  instance: number;
  gene: number;
  /** Along the ray, in lengths of its direction. */
  t: number;
}

export class PartPicker {
  private balls = new Float32Array(0);
  private candidates = new Uint32Array(0);
  private starts = new Float64Array(0);
  private model: ModelMessage | null = null;
  private meshes: readonly MeshData[] = [];
  private extents: readonly Extent[] = [];
  private fresh = false;

  setModel(model: ModelMessage | null, meshes: readonly MeshData[], extents: readonly Extent[]): void {
    this.model = model;
    this.meshes = meshes;
    this.extents = extents;
    this.fresh = false;
  }

  /** `direction` has length 1. */
  pick(origin: V, direction: V): Hit | null {
    const model = this.model;
    if (!model) return null;
    if (!this.fresh) this.measure(model);
    const found = this.collect(model, origin, direction);
    let best: Hit | null = null;
    for (let i = 0; i < found; ++i) {
      const instance = this.candidates[i]!;
      if (best && this.starts[instance]! >= best.t) break;
      const t = this.hitPart(model, instance, origin, direction, best ? best.t : Infinity);
      if (t < (best ? best.t : Infinity)) best = { instance, gene: model.words[instance * kInstanceWords + kGeneWord]!, t };
    }
    return best;
  }

  private measure(model: ModelMessage): void {
    const n = model.instances, f = model.floats;
    if (this.balls.length < 4 * n) {
      const room = Math.ceil(n * 1.25);
      this.balls = new Float32Array(4 * room);
      this.candidates = new Uint32Array(room);
      this.starts = new Float64Array(room);
    }
    for (let i = 0, w = 0; i < n; ++i, w += kInstanceWords) {
      const e = this.extents[model.words[w + 14]! & 0xffff]!;
      const mx = e.middle[0], my = e.middle[1], mz = e.middle[2], hx = e.half[0], hy = e.half[1], hz = e.half[2],
        wide = Math.max(1, f[w + 12]!);
      let square = 0;
      for (let k = 0; k < 3; ++k) {
        const x = f[w + k]!, y = f[w + 3 + k]!, z = f[w + 6 + k]!;
        this.balls[4 * i + k] = f[w + 9 + k]! + x * mx + y * my + z * mz;
        const reach = wide * (Math.abs(x) * hx + Math.abs(z) * hz) + Math.abs(y) * hy;
        square += reach * reach;
      }
      const shown = model.words[w + 15] !== kProxy && Number.isFinite(square);
      this.balls[4 * i + 3] = shown ? square * 1.0001 : -1;
    }
    this.fresh = true;
  }

  /** Parts whose balls the ray meets, sorted by where it enters them. */
  private collect(model: ModelMessage, origin: V, direction: V): number {
    const [ox, oy, oz] = origin, [dx, dy, dz] = direction;
    let found = 0;
    for (let i = 0, b = 0; i < model.instances; ++i, b += 4) {
      const x = this.balls[b]! - ox, y = this.balls[b + 1]! - oy, z = this.balls[b + 2]! - oz;
      const middle = x * dx + y * dy + z * dz, square = this.balls[b + 3]!;
      const aside = x * x + y * y + z * z - middle * middle;
      if (!(aside <= square) || square < 0) continue;
      const half = Math.sqrt(square - aside);
      if (middle + half < 0) continue;
      this.starts[i] = Math.max(middle - half, 0);
      this.candidates[found++] = i;
    }
    this.candidates.subarray(0, found).sort((a, b) => this.starts[a]! - this.starts[b]!);
    return found;
  }

  private hitPart(model: ModelMessage, instance: number, origin: V, direction: V, limit: number): number {
    const w = instance * kInstanceWords, f = model.floats;
    const [a, b, c, d, e, g, h, i, j] = f.subarray(w, w + 9) as unknown as number[] & { length: 9 };
    const determinant = a! * (e! * j! - g! * i!) - d! * (b! * j! - c! * i!) + h! * (b! * g! - c! * e!);
    if (!(Math.abs(determinant) > 0)) return this.hitFlat(model, instance, origin, direction);
    const into = (x: number, y: number, z: number): [number, number, number] => [
      ((e! * j! - g! * i!) * x + (g! * h! - d! * j!) * y + (d! * i! - e! * h!) * z) / determinant,
      ((c! * i! - b! * j!) * x + (a! * j! - c! * h!) * y + (b! * h! - a! * i!) * z) / determinant,
      ((b! * g! - c! * e!) * x + (c! * d! - a! * g!) * y + (a! * e! - b! * d!) * z) / determinant,
    ];
    const o = into(origin[0] - f[w + 9]!, origin[1] - f[w + 10]!, origin[2] - f[w + 11]!),
      ray = into(...direction as [number, number, number]);
    const number = model.words[w + 14]! & 0xffff, mesh = this.meshes[number]!, { box } = this.extents[number]!;
    const top = mesh.cone ? f[w + 12]! : 1, wide = Math.max(1, top);
    const enter = hitBox(o, ray, [box.min[0] * wide, box.min[1], box.min[2] * wide],
      [box.max[0] * wide, box.max[1], box.max[2] * wide]);
    return enter < limit ? hitTriangles(o, ray, mesh, top) : Infinity;
  }

  /** A part without volume (a leaf of thickness 0): its triangles are brought to the model's space instead. */
  private hitFlat(model: ModelMessage, instance: number, origin: V, direction: V): number {
    const w = instance * kInstanceWords, f = model.floats, mesh = this.meshes[model.words[w + 14]! & 0xffff]!;
    const positions = new Float32Array(mesh.positions.length);
    for (let i = 0; i < positions.length; i += 3) {
      for (let k = 0; k < 3; ++k) {
        positions[i + k] = f[w + 9 + k]! + f[w + k]! * mesh.positions[i]! + f[w + 3 + k]! * mesh.positions[i + 1]! +
          f[w + 6 + k]! * mesh.positions[i + 2]!;
      }
    }
    return hitTriangles(origin, direction, { positions, indices: mesh.indices });
  }
}
