// The box around instances, in plain numbers: a hundred thousand of them take a millisecond or two.
import { kInstanceWords, type MeshTable, type ModelMessage } from "./messages";
import { kProxy, type Extent } from "./part_picker";
import type { Box } from "./vec";

export class PartBox {
  private x0 = Infinity;
  private y0 = Infinity;
  private z0 = Infinity;
  private x1 = -Infinity;
  private y1 = -Infinity;
  private z1 = -Infinity;

  /** The instance whose frame is at `w`; `wide` is how much wider than its mesh a cone may be. */
  add(f: Float32Array, w: number, { middle, half }: Extent, wide: number): void {
    const mx = middle[0], my = middle[1], mz = middle[2], hx = half[0], hy = half[1], hz = half[2];
    const ax = f[w]!, ay = f[w + 1]!, az = f[w + 2]!, bx = f[w + 3]!, by = f[w + 4]!, bz = f[w + 5]!;
    const cx = f[w + 6]!, cy = f[w + 7]!, cz = f[w + 8]!, kx = wide * hx, kz = wide * hz;
    const x = f[w + 9]! + ax * mx + bx * my + cx * mz, rx = Math.abs(ax) * kx + Math.abs(bx) * hy + Math.abs(cx) * kz;
    const y = f[w + 10]! + ay * mx + by * my + cy * mz, ry = Math.abs(ay) * kx + Math.abs(by) * hy + Math.abs(cy) * kz;
    const z = f[w + 11]! + az * mx + bz * my + cz * mz, rz = Math.abs(az) * kx + Math.abs(bz) * hy + Math.abs(cz) * kz;
    if (!(Math.abs(x) + Math.abs(y) + Math.abs(z) + rx + ry + rz < Infinity)) return;
    if (x - rx < this.x0) this.x0 = x - rx;
    if (y - ry < this.y0) this.y0 = y - ry;
    if (z - rz < this.z0) this.z0 = z - rz;
    if (x + rx > this.x1) this.x1 = x + rx;
    if (y + ry > this.y1) this.y1 = y + ry;
    if (z + rz > this.z1) this.z1 = z + rz;
  }

  box(): Box {
    return { min: [this.x0, this.y0, this.z0], max: [this.x1, this.y1, this.z1] };
  }
}

/** Around all that is drawn of a model. */
export function boxOfModel({ floats, words, instances }: ModelMessage, { meshes }: MeshTable, extents: readonly Extent[]): Box {
  const box = new PartBox();
  for (let i = 0, w = 0; i < instances; ++i, w += kInstanceWords) {
    const mesh = words[w + 14]! & 0xffff;
    if (words[w + 15] !== kProxy) box.add(floats, w, extents[mesh]!, meshes[mesh]!.cone ? Math.max(floats[w + 12]!, 1) : 1);
  }
  return box.box();
}
