// What a key does in the room.
import type { Studio } from "../store/studio";
import { stepInGrid } from "./grid_layout";
import type { RoomAction } from "./room_keys";

export function runRoomAction(studio: Studio, action: RoomAction): void {
  const { room } = studio;
  const { state } = room;
  const id = state.selected.value;
  const all = room.individuals.value;
  switch (action.do) {
    case "undo": return room.undo();
    case "redo": return room.redo();
    case "breed": return room.breed();
    case "back": return room.look("none");
    case "one": return room.toggleLook("one");
    case "pairs": return room.toggleLook("pairs");
    case "turning": return toggleTurning(studio);
    case "scale": return studio.setPreferences({ oneScale: !studio.preferences.value.oneScale });
    case "pick": return void room.pick(action.which);
    case "copy": return room.copy();
    case "paste": return room.paste();
    case "step": {
      const next = all[stepInGrid(all.findIndex((one) => one.id === id), action.step, room.columns, all.length)];
      if (next !== undefined) selectAndFocus(studio, next.id);
      return;
    }
  }
  if (id === null) return;
  switch (action.do) {
    case "stars": return room.stars(id, action.stars);
    case "point": return room.point(id, action.by);
    case "unrate": return room.unrate(id);
    case "best":
    case "worst": return room.extreme(id, action.do);
    case "more": return room.moreLike(id);
    case "keep": return void room.keep(id);
    case "show": return void room.show(id);
    case "blend": return room.toggleParent(id);
  }
}

export function selectAndFocus(studio: Studio, id: number): void {
  studio.room.select(id);
  document.querySelector<HTMLElement>(`[data-individual="${id}"]`)?.focus();
}

/** Who asked the system for less movement may still want to see this turn. */
export function toggleTurning(studio: Studio): void {
  const { room } = studio;
  if (room.still.value) {
    room.still.value = false;
    studio.setPreferences({ turning: true });
  } else studio.setPreferences({ turning: !studio.preferences.value.turning });
}
