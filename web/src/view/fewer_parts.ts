// A model of fewer parts, for small views where the processor draws: stochastic simplification (Cook, Halstead, Planck and Ryu 2007,
// "Stochastic simplification of aggregate detail"). Of small branches and leaves every so many stays, and is made larger, so that
// they cover together what all of them covered. All else stays as it is: half a building is none.
import { kInstanceWords, type MeshTable, type ModelMessage } from "./messages";
import { kProxy, type Extent } from "./part_picker";

/** Of the branches and leaves that stay, how many stay as they are: the largest. */
const kWhole = 0.4;
/** No side becomes longer than this many times what it was. */
const kMostLarger = 3;
/** A leaf is missed as much as a branch of so much of its size. */
const kLeafCounts = 0.25;
/** Parts that sizes are judged by. */
const kJudged = 2048;

/** About `most` parts, but at least a quarter of that beside all that is neither branch nor leaf; the same message where there are no more. */
export function fewerParts(model: ModelMessage, { meshes }: MeshTable, extents: readonly Extent[], most: number): ModelMessage {
  const { instances, words } = model;
  if (instances <= most) return model;
  const sizes = new Float32Array(instances), weights = meshes.map(({ grows }) => grows === null ? 0 : grows === "leaf" ? kLeafCounts : 1);
  let grown = 0;
  for (let i = 0; i < instances; ++i) {
    const w = i * kInstanceWords, mesh = words[w + 14]! & 0xffff, weight = words[w + 15] === kProxy ? 0 : weights[mesh]!;
    sizes[i] = weight > 0 ? weight * sizeOf(model.floats, w, extents[mesh]!) : -1;
    if (weight > 0) ++grown;
  }
  const room = Math.ceil(Math.max(most - (instances - grown), most / 4));
  if (grown <= room) return model;
  const large = sizeOfRank(sizes, kWhole * room / grown);
  let whole = 0;
  for (const size of sizes) if (size > large) ++whole;
  whole = Math.min(whole, Math.floor(0.8 * room));
  const stride = (grown - whole) / (room - whole);
  const floats = new Float32Array(kInstanceWords * (instances - grown + room)), bits = new Uint32Array(floats.buffer);
  let to = 0, larger = 0, smaller = 0, next = 0;
  for (let i = 0; i < instances && to < floats.length; ++i) {
    const w = i * kInstanceWords, size = sizes[i]!, stays = size < 0 || (size > large && larger < whole);
    if (stays) larger += size < 0 ? 0 : 1;
    else if (smaller++ < next) continue;
    for (let k = 0; k < kInstanceWords; ++k) bits[to + k] = words[w + k]!;
    if (!stays) {
      next += stride;
      enlarge(floats, to, extents[words[w + 14]! & 0xffff]!, stride);
    }
    to += kInstanceWords;
  }
  return { ...model, instances: to / kInstanceWords, floats: floats.subarray(0, to), words: bits.subarray(0, to) };
}

/** Of those that have a size: about this share of them is larger than the answer; less, where many are equal. */
function sizeOfRank(sizes: Float32Array, share: number): number {
  const step = Math.ceil(sizes.length / kJudged), judged: number[] = [];
  for (let i = 0; i < sizes.length; i += step) if (sizes[i]! >= 0) judged.push(sizes[i]!);
  judged.sort((a, b) => b - a);
  return judged[Math.min(Math.floor(share * judged.length), judged.length - 1)] ?? 0;
}

/** Of the two longer sides of a mesh's box as it stands in the model: what is seen of it at most, a quarter of that. */
function sizeOf(f: Float32Array, w: number, { half }: Extent): number {
  const x = half[0] * lengthOf(f, w), y = half[1] * lengthOf(f, w + 3), z = half[2] * lengthOf(f, w + 6);
  return Math.max(x * y, y * z, z * x);
}

function lengthOf(f: Float32Array, at: number): number {
  return Math.sqrt(f[at]! * f[at]! + f[at + 1]! * f[at + 1]! + f[at + 2]! * f[at + 2]!); // Math.hypot takes ten times as long
}

/** About the middle. What is long and thin becomes wider; all else grows in all directions. */
function enlarge(f: Float32Array, at: number, { middle, half }: Extent, area: number): void {
  const sides = [0, 1, 2].map((k) => half[k]! * lengthOf(f, at + 3 * k));
  const [, second, longest] = [...sides].sort((a, b) => a - b) as [number, number, number], thin = longest > 3 * second;
  for (let k = 0; k < 3; ++k) {
    const by = thin ? (sides[k] === longest ? 1 : Math.min(area, kMostLarger)) : Math.min(Math.sqrt(area), kMostLarger);
    for (let r = 0; r < 3; ++r) {
      f[at + 9 + r]! -= (by - 1) * f[at + 3 * k + r]! * middle[k]!;
      f[at + 3 * k + r]! *= by;
    }
  }
}
