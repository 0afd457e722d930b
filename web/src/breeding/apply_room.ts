// What messages of the breeding room change.
import { batch } from "@preact/signals";
import type { Bred, Breeding, Breedings, IndividualGenes, Lineage, Message } from "../api";
import { decodeIndividual, isRoomTable, kPreview, type IndividualMessage } from "./individual_message";
import { nextPair, pairKey } from "./rating";
import { forgetSession, type IndividualModel, type RoomState } from "./room_state";

export type RoomMessage = Breedings | Breeding | Bred | IndividualGenes | Lineage;
const kKinds: readonly string[] = ["breedings", "breeding", "bred", "individual_genes", "lineage"] satisfies RoomMessage["kind"][];

export function isRoomMessage(message: Message): message is RoomMessage {
  return kKinds.includes(message.kind);
}

export function applyRoomMessage(state: RoomState, message: RoomMessage): void {
  batch(() => {
    switch (message.kind) {
      case "breedings":
        state.sessions.value = message.sessions;
        break;
      case "breeding":
        applyBreeding(state, message);
        break;
      case "bred": {
        const model = state.models.value.get(message.individual);
        // Of another session, or of a model that a newer one has replaced meanwhile.
        if (model === undefined || model.session !== message.session || model.version !== message.version) break;
        setModel(state, { ...model, bred: message });
        break;
      }
      case "individual_genes":
        if (message.individual === state.selected.value && message.session === state.breeding.value?.session.id) state.genes.value = message;
        break;
      case "lineage":
        if (message.session === state.breeding.value?.session.id) state.lineage.value = message;
        break;
    }
  });
}

/** Throws MessageError. False where the message is none of the room's. */
export function applyRoomBinary(state: RoomState, kind: string, data: ArrayBuffer): boolean {
  if (kind === "ESPG" && isRoomTable(data)) {
    state.meshes.value = data;
    return true;
  }
  if (kind !== "ESPI") return false;
  const model: IndividualMessage = decodeIndividual(data);
  const before = state.models.value.get(model.individual);
  setModel(state, { ...model, bred: before?.session === model.session ? before.bred : null });
  return true;
}

function applyBreeding(state: RoomState, message: Breeding): void {
  const before = state.breeding.value;
  if (before !== null && before.session.id !== message.session.id) {
    // Models may have come ahead of the session that they belong to.
    const models = new Map([...state.models.value].filter(([, one]) => one.session === message.session.id));
    const meshes = state.meshes.value;
    forgetSession(state);
    state.models.value = models;
    state.meshes.value = meshes;
  }
  state.breeding.value = message;
  // What was asked before the page was loaded anew, or on another page, is asked here neither.
  const compared = (message.compared ?? []).map(({ better, worse }) => pairKey(better, worse));
  if (compared.some((key) => !state.asked.value.has(key))) state.asked.value = new Set([...state.asked.value, ...compared]);
  const here = new Set(message.individuals.map((one) => one.id));
  const moved = before?.generation !== message.generation || before.session.id !== message.session.id;
  if (moved) {
    const close = state.close.value;
    if (close.kind === "ancestor" || close.kind === "blend") state.close.value = { kind: "none" };
    if (close.kind === "pairs") state.close.value = { kind: "pairs", pair: nextPair(message.individuals, state.asked.value) };
    dropModels(state, here);
  }
  if (state.selected.value === null || !here.has(state.selected.value)) {
    state.selected.value = message.individuals[0]?.id ?? null;
    state.genes.value = null;
  }
}

/** Of generations that are not shown nothing is kept but what is looked at: the server sends them again. */
function dropModels(state: RoomState, here: ReadonlySet<number>): void {
  state.models.value = new Map([...state.models.value].filter(([id]) => here.has(id) || id === kPreview));
}

function setModel(state: RoomState, model: IndividualModel): void {
  const models = new Map(state.models.value);
  models.set(model.individual, model);
  state.models.value = models;
}
