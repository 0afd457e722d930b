// Binary messages of the server: ESPG (meshes), ESPM (a model), ESPC (a cloud); docs/studio-protocol.md has the layout.
// Arrays are views into the message, nothing is copied. Whatever does not fit is a MessageError that says what.

/** What is wrong with a message: for the person who looks at the page. */
export class MessageError extends Error {
  override name = "MessageError";
}

export interface MeshData {
  cone: boolean;
  /** Whether some of them may stand for many, and as what. */
  grows: "branch" | "leaf" | null;
  positions: Float32Array;
  normals: Float32Array;
  indices: Uint32Array;
}

export interface MeshTable {
  number: number;
  meshes: MeshData[];
}

export interface ModelMessage {
  number: number;
  table: number;
  /** Instances: 16 words each, as floats and as bits. */
  instances: number;
  floats: Float32Array;
  words: Uint32Array;
  /** Bones: 8 words each, as floats and as bits. */
  bones: number;
  boneFloats: Float32Array;
  boneWords: Uint32Array;
  /** 12 floats each. */
  materials: number;
  materialFloats: Float32Array;
  /** rule, parent (-1: none) of each gene. */
  genes: number;
  geneWords: Int32Array;
}

export interface CloudMessage {
  rule: string;
  count: number;
  /** 4 words each: place, and kind as bits. */
  floats: Float32Array;
  words: Uint32Array;
}

/** Of an instance: which of its words is the gene that it belongs to. */
export const kGeneWord = 13;
export const kInstanceWords = 16, kBoneWords = 8, kMaterialFloats = 12;
const kVersion = 1;
const kGrows = [null, "branch", "leaf", "branch"] as const;
const kMostMeshes = 4096, kMostGenes = 2 ** 24;

/** Checks letters, version and that `head` bytes are there. */
function open(message: ArrayBuffer, letters: string, head: number): DataView {
  const size = message.byteLength;
  if (size < head) throw new MessageError(`${letters}: ${size} bytes, its head has ${head}`);
  if (size % 4 !== 0) throw new MessageError(`${letters}: ${size} bytes are no whole words`);
  const data = new DataView(message);
  const found = String.fromCharCode(...new Uint8Array(message, 0, 4));
  if (found !== letters) throw new MessageError(`message begins with ${JSON.stringify(found)}, not ${letters}`);
  const version = data.getUint32(4, true);
  if (version !== kVersion) {
    throw new MessageError(`${letters}: version ${version}; this page reads version ${kVersion}`);
  }
  return data;
}

function requireBytes(message: ArrayBuffer, letters: string, needed: number): void {
  if (message.byteLength !== needed) {
    throw new MessageError(`${letters}: ${message.byteLength} bytes; what it announces has ${needed}`);
  }
}

export function decodeMeshes(message: ArrayBuffer): MeshTable {
  const data = open(message, "ESPG", 16);
  const number = data.getUint32(8, true), count = data.getUint32(12, true);
  if (count > kMostMeshes) throw new MessageError(`ESPG: ${count} meshes, at most ${kMostMeshes} are drawn`);
  const meshes: MeshData[] = [];
  let at = 16;
  for (let i = 0; i < count; ++i) {
    if (at + 12 > message.byteLength) throw new MessageError(`ESPG: ends before mesh ${i} of ${count}`);
    const vertices = data.getUint32(at, true), triangles = data.getUint32(at + 4, true),
      kind = data.getUint32(at + 8, true);
    if (kind > 3) throw new MessageError(`ESPG: mesh ${i} is of kind ${kind}, not 0 to 3`);
    at += 12;
    if (at + vertices * 24 + triangles * 12 > message.byteLength) {
      throw new MessageError(`ESPG: ends within mesh ${i}, of ${vertices} vertices and ${triangles} triangles`);
    }
    const positions = new Float32Array(message, at, vertices * 3);
    const normals = new Float32Array(message, at + vertices * 12, vertices * 3);
    const indices = new Uint32Array(message, at + vertices * 24, triangles * 3);
    at += vertices * 24 + triangles * 12;
    for (const index of indices) {
      if (index >= vertices) {
        throw new MessageError(`ESPG: mesh ${i} has ${vertices} vertices, a triangle names ${index}`);
      }
    }
    meshes.push({ cone: kind === 1, grows: kGrows[kind]!, positions, normals, indices });
  }
  requireBytes(message, "ESPG", at);
  return { number, meshes };
}

/** Indices within are checked against the message's own counts and against `meshes`, the length of the mesh table. */
export function decodeModel(message: ArrayBuffer, meshes: number): ModelMessage {
  const data = open(message, "ESPM", 32);
  const [number, n, b, m, g, table] = [8, 12, 16, 20, 24, 28].map((at) => data.getUint32(at, true)) as
    [number, number, number, number, number, number];
  requireBytes(message, "ESPM", 32 + n * 64 + b * 32 + m * 48 + g * 8);
  if (g > kMostGenes) throw new MessageError(`ESPM: ${g} genes, at most ${kMostGenes} are drawn`);
  let at = 32;
  const floats = new Float32Array(message, at, n * kInstanceWords),
    words = new Uint32Array(message, at, n * kInstanceWords);
  at += n * 64;
  const boneFloats = new Float32Array(message, at, b * kBoneWords),
    boneWords = new Uint32Array(message, at, b * kBoneWords);
  at += b * 32;
  const materialFloats = new Float32Array(message, at, m * kMaterialFloats);
  at += m * 48;
  const geneWords = new Int32Array(message, at, g * 2);
  for (let i = 0, w = 13; i < n; ++i, w += kInstanceWords) {
    const kinds = words[w + 1]!;
    if (words[w]! >= g || (kinds & 0xffff) >= meshes || kinds >>> 16 >= m || words[w + 2]! > 2) {
      throw new MessageError(
        `ESPM: instance ${i} names gene ${words[w]} of ${g}, mesh ${kinds & 0xffff} of ${meshes}, ` +
        `material ${kinds >>> 16} of ${m}, layer ${words[w + 2]}`);
    }
  }
  for (let i = 0, w = 6; i < b; ++i, w += kBoneWords) {
    const parent = boneWords[w + 1]! | 0;
    if (boneWords[w]! >= g || parent < -1 || parent >= b) {
      throw new MessageError(`ESPM: bone ${i} names gene ${boneWords[w]} of ${g}, bone ${parent} of ${b}`);
    }
  }
  for (let i = 0; i < g; ++i) {
    const parent = geneWords[2 * i + 1]!;
    if (parent < -1 || parent >= g) throw new MessageError(`ESPM: gene ${i} stands on gene ${parent} of ${g}`);
  }
  return {
    number, table, instances: n, floats, words, bones: b, boneFloats, boneWords,
    materials: m, materialFloats, genes: g, geneWords,
  };
}

export function decodeCloud(message: ArrayBuffer): CloudMessage {
  const data = open(message, "ESPC", 16);
  const bytes = data.getUint32(8, true), count = data.getUint32(12, true);
  const start = 16 + Math.ceil(bytes / 4) * 4;
  requireBytes(message, "ESPC", start + count * 16);
  const rule = new TextDecoder().decode(new Uint8Array(message, 16, bytes));
  const floats = new Float32Array(message, start, count * 4), words = new Uint32Array(message, start, count * 4);
  for (let i = 0; i < count; ++i) {
    if (words[4 * i + 3]! > 2) throw new MessageError(`ESPC: point ${i} is of kind ${words[4 * i + 3]}, not 0, 1 or 2`);
  }
  return { rule, count, floats, words };
}
