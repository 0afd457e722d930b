// ESPI: the model of an individual of the breeding room; docs/studio-protocol.md has the layout. Its parts have half the bytes that a
// model of the studio's view has: a generation is to be there at once.
import { kMaterialFloats, MessageError } from "../view/messages";

/** Of a blend that is not kept. */
export const kPreview = 0;
const kVersion = 2;
export const kHead = 64, kPartHalves = 16;

export interface IndividualMessage {
  session: number;
  /** 0: a blend that is not kept. */
  individual: number;
  version: number;
  /** The message itself, for `decodeParts` (individual_parts.ts). */
  model: ArrayBuffer;
}

/** Whose it is, and whether it is whole. Throws MessageError. */
export function decodeIndividual(message: ArrayBuffer): IndividualMessage {
  if (message.byteLength < kHead) throw new MessageError(`ESPI: ${message.byteLength} bytes, its head has ${kHead}`);
  const data = new DataView(message);
  const letters = String.fromCharCode(...new Uint8Array(message, 0, 4));
  if (letters !== "ESPI") throw new MessageError(`message begins with ${JSON.stringify(letters)}, not ESPI`);
  const version = data.getUint32(4, true);
  if (version !== kVersion) throw new MessageError(`ESPI: version ${version}; this page reads version ${kVersion}`);
  const needed = kHead + 2 * kPartHalves * data.getUint32(24, true) + 4 * kMaterialFloats * data.getUint32(28, true);
  if (message.byteLength !== needed) throw new MessageError(`ESPI: ${message.byteLength} bytes; what it announces has ${needed}`);
  return { session: data.getUint32(8, true), individual: data.getUint32(12, true), version: data.getUint32(16, true), model: message };
}

/** Mesh tables of the room have the highest bit of their number set. */
export function isRoomTable(message: ArrayBuffer): boolean {
  return message.byteLength >= 12 && new DataView(message).getUint32(8, true) >= 0x8000_0000;
}
