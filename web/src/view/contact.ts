// How much stands near the ground, as a soft dark patch under the model: cheap enough for every model and every
// renderer.
import { kInstanceWords, type ModelMessage } from "./messages";
import { kProxy, type Extent } from "./part_picker";
import type { Box } from "./vec";

export const kContactCells = 64;
const kMostParts = 6000;

/** Where the patch lies: a square around the model, a third wider on every side. */
export function contactSquare(box: Box): { x: number; z: number; side: number } {
  const side = 1.7 * Math.max(box.max[0] - box.min[0], box.max[2] - box.min[2], 1e-3);
  return { x: (box.min[0] + box.max[0]) / 2, z: (box.min[2] + box.max[2]) / 2, side };
}

/** Fills kContactCells^2 bytes (rows along z, each along x): 0 open .. 255 covered. Of large models every so many
 *  parts count. */
export function contactPatch(
  model: ModelMessage, extents: readonly Extent[], box: Box, scratch: Float32Array, patch: Uint8Array): void {
  const n = kContactCells, { x, z, side } = contactSquare(box),
    height = Math.max(0.3 * (box.max[1] - box.min[1]), 1e-6);
  const stride = Math.max(1, Math.ceil(model.instances / kMostParts)), cell = side / n, f = model.floats;
  scratch.fill(0);
  for (let i = 0; i < model.instances; i += stride) {
    const w = i * kInstanceWords;
    if (model.words[w + 15] === kProxy) continue;
    const { middle: m, half: h } = extents[model.words[w + 14]! & 0xffff]!;
    const at = (k: number): number => f[w + 9 + k]! + f[w + k]! * m[0] + f[w + 3 + k]! * m[1] + f[w + 6 + k]! * m[2];
    const reach = (k: number): number => Math.abs(f[w + k]!) * h[0] + Math.abs(f[w + 3 + k]!) * h[1] +
      Math.abs(f[w + 6 + k]!) * h[2];
    const above = Math.max(0, at(1) - reach(1));
    const rx = Math.max(reach(0), cell / 2), rz = Math.max(reach(2), cell / 2);
    const weight = stride * Math.exp(-above / height);
    if (!(weight > 0.02)) continue;
    const low = (v: number): number => Math.min(Math.max(Math.floor(v), 0), n);
    const x0 = low((at(0) - rx - x) / cell + n / 2 + 0.5), x1 = low((at(0) + rx - x) / cell + n / 2 + 0.5);
    const z0 = low((at(2) - rz - z) / cell + n / 2 + 0.5), z1 = low((at(2) + rz - z) / cell + n / 2 + 0.5);
    const share = weight * Math.min(1, 4 * rx * rz / (cell * cell * Math.max(1, (x1 - x0) * (z1 - z0))));
    for (let iz = z0; iz < Math.max(z1, z0 + 1) && iz < n; ++iz) {
      for (let ix = x0; ix < Math.max(x1, x0 + 1) && ix < n; ++ix) scratch[iz * n + ix]! += share;
    }
  }
  for (let i = 0; i < n * n; ++i) scratch[i] = 1 - Math.exp(-scratch[i]!);
  for (let pass = 0; pass < 3; ++pass) blur(scratch, n, 2);
  for (let i = 0; i < n * n; ++i) patch[i] = Math.min(255, Math.round(255 * scratch[i]!));
}

const line = new Float32Array(kContactCells);

/** Means over 2 * radius + 1 cells, along rows and then along columns. */
function blur(cells: Float32Array, n: number, radius: number): void {
  for (const [step, next] of [[1, n], [n, 1]] as const) {
    for (let i = 0; i < n; ++i) {
      for (let k = 0; k < n; ++k) {
        let sum = 0;
        for (let d = -radius; d <= radius; ++d) if (k + d >= 0 && k + d < n) sum += cells[i * next + (k + d) * step]!;
        line[k] = sum / (2 * radius + 1);
      }
      for (let k = 0; k < n; ++k) cells[i * next + k * step] = line[k]!;
    }
  }
}
