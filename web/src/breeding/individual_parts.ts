// The parts of an ESPI message, of uint16s and float16s, as the view draws them.
import { DataUtils } from "three";
import { kInstanceWords, kMaterialFloats, MessageError, type ModelMessage } from "../view/messages";
import { kHead, kPartHalves } from "./individual_message";

/** As the view draws models; all parts are of one gene. `message` is one that `decodeIndividual` took; `meshes`
 *  is the length of the mesh table. Throws MessageError where a part names what there is not. */
export function decodeParts(message: ArrayBuffer, meshes: number): ModelMessage {
  const data = new DataView(message), head = new Float32Array(message, 32, 7);
  const [number, table, n, m] = [16, 20, 24, 28].map((at) => data.getUint32(at, true)) as [number, number, number, number];
  const parts = new Uint16Array(message, kHead, n * kPartHalves), halves = halfFloats();
  const floats = new Float32Array(n * kInstanceWords), words = new Uint32Array(floats.buffer);
  const [x0, y0, z0, dx, dy, dz, unit] = [0, 1, 2, 3, 4, 5, 6].map((i) => i > 2 && i < 6 ? head[i]! / 65535 : head[i]!) as
    [number, number, number, number, number, number, number];
  for (let i = 0, h = 0, w = 0; i < n; ++i, h += kPartHalves, w += kInstanceWords) {
    for (let k = 0; k < 9; ++k) floats[w + k] = unit * halves[parts[h + 3 + k]!]!;
    floats[w + 9] = x0 + dx * parts[h]!;
    floats[w + 10] = y0 + dy * parts[h + 1]!;
    floats[w + 11] = z0 + dz * parts[h + 2]!;
    floats[w + 12] = halves[parts[h + 12]!]!;
    const mesh = parts[h + 13]!, material = parts[h + 14]!;
    if (mesh >= meshes || material >= m) {
      throw new MessageError(`ESPI: part ${i} names mesh ${mesh} of ${meshes}, material ${material} of ${m}`);
    }
    words[w + 14] = mesh | material << 16;
  }
  return {
    number, table, instances: n, floats, words, bones: 0, boneFloats: floats.subarray(0, 0), boneWords: words.subarray(0, 0),
    materials: m, materialFloats: new Float32Array(message, kHead + 2 * kPartHalves * n, m * kMaterialFloats), genes: 1, geneWords: kOneGene,
  };
}

const kOneGene = new Int32Array([0, -1]);
let halfTable: Float32Array | null = null;

/** The value of every float16, by its bits. */
function halfFloats(): Float32Array {
  if (halfTable === null) {
    halfTable = new Float32Array(65536);
    for (let bits = 0; bits < 65536; ++bits) halfTable[bits] = DataUtils.fromHalfFloat(bits);
  }
  return halfTable;
}
