import { batch } from "@preact/signals";
import type { Message } from "../api";
import type { RoomMessage } from "../breeding/apply_room";
import { addLog, forgetProject, type State } from "./state";

/** What a text message changes. `done` and `failed` are the connection's own business. */
export function applyMessage(state: State, message: Exclude<Message, RoomMessage>): void {
  batch(() => {
    switch (message.kind) {
      case "projects":
        state.version.value = message.version;
        state.projects.value = message.projects;
        state.samples.value = message.samples;
        break;
      case "document":
        if (state.confirmed.value?.project.id !== message.project.id) forgetProject(state);
        state.confirmed.value = message;
        dropLostSelection(state);
        break;
      case "checked": {
        const document = state.confirmed.value;
        state.checkedText.value = document !== null && document.revision === message.revision ? document.grammar : null;
        state.checked.value = message;
        break;
      }
      case "search_state":
        state.search.value = message;
        break;
      case "shown":
        state.shown.value = message;
        break;
      case "gene": {
        // Of another that was selected before.
        if (state.wantedPath.value !== null && state.wantedPath.value !== message.path) break;
        const other = state.gene.value?.path !== message.path;
        state.gene.value = message;
        state.selection.value = { kind: "gene", gene: message.gene };
        if (other && message.at !== undefined) state.jump.value = { at: message.at, focus: false };
        break;
      }
      case "log":
        addLog(state, message.level, message.text);
        break;
      case "done":
      case "failed":
        break;
      default:
        addLog(state, "warning", `The server sent a message that this page does not know: ${(message as { kind: string }).kind}.`);
    }
  });
}

/** A binary message, by the four letters that it begins with. */
export function applyBinary(state: State, kind: string, data: ArrayBuffer): void {
  if (kind === "ESPM") state.model.value = data;
  else if (kind === "ESPG") state.meshes.value = data;
  else if (kind === "ESPC") state.cloud.value = data;
  else addLog(state, "warning", `The server sent data that this page does not know: ${kind}.`);
}

/** Undo or another tab may have removed what is selected. */
function dropLostSelection(state: State): void {
  const selection = state.selection.value;
  const scene = state.confirmed.value!.scene;
  if (selection === null || selection.kind === "gene") return;
  const count =
    selection.kind === "curve"
      ? scene.curves?.curve.length
      : selection.kind === "mesh"
        ? scene.volume?.mesh.length
        : scene.silhouette?.length;
  if (selection.index >= (count ?? 0)) state.selection.value = null;
}
