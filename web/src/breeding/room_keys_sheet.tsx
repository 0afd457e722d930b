// Keys of the room on the sheet that `?` shows.
import { ROOM_KEYS } from "./room_keys";

const kNames: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };
const nameOf = (key: string) => kNames[key] ?? (key.length === 1 ? key.toUpperCase() : key);

export function RoomKeys() {
  return (
    <section aria-label="Breeding room">
      <h3>Breeding room</h3>
      <dl>
        {ROOM_KEYS.filter((one) => !one.unlisted).map((one, i) => (
          <div key={i}>
            <dt>{[...(one.mod ? ["Ctrl"] : []), ...(one.shift ? ["Shift"] : []), nameOf(one.keys[0]!), ...(one.action.do === "stars" ? ["…", "5"] : [])].map((name) => <kbd key={name}>{name}</kbd>)}</dt>
            <dd>{one.words}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
