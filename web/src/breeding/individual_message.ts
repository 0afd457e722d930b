// ESPI: the model of an individual of the breeding room, around a whole ESPM message. docs/studio-protocol.md has the layout.
import { MessageError } from "../view/messages";

/** Of a blend that is not kept. */
export const kPreview = 0;
const kHead = 24, kVersion = 1;

export interface IndividualMessage {
  session: number;
  /** 0: a blend that is not kept. */
  individual: number;
  version: number;
  /** An ESPM message of its own. */
  model: ArrayBuffer;
}

/** Throws MessageError. What the model itself says is checked by `decodeModel`, when it is drawn. */
export function decodeIndividual(message: ArrayBuffer): IndividualMessage {
  if (message.byteLength < kHead + 32) throw new MessageError(`ESPI: ${message.byteLength} bytes, the least is ${kHead + 32}`);
  const data = new DataView(message);
  const letters = (at: number) => String.fromCharCode(...new Uint8Array(message, at, 4));
  if (letters(0) !== "ESPI") throw new MessageError(`message begins with ${JSON.stringify(letters(0))}, not ESPI`);
  const version = data.getUint32(4, true);
  if (version !== kVersion) throw new MessageError(`ESPI: version ${version}, this page knows ${kVersion}`);
  if (letters(kHead) !== "ESPM") throw new MessageError(`ESPI: has ${JSON.stringify(letters(kHead))} inside, not ESPM`);
  return { session: data.getUint32(8, true), individual: data.getUint32(12, true), version: data.getUint32(16, true), model: message.slice(kHead) };
}

/** Mesh tables of the room have the highest bit of their number set. */
export function isRoomTable(message: ArrayBuffer): boolean {
  return message.byteLength >= 12 && new DataView(message).getUint32(8, true) >= 0x8000_0000;
}
