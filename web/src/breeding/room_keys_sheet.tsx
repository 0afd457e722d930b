// Keys of the room on the sheet that `?` shows.
import { ROOM_KEYS, type RoomAction } from "./room_keys";

const kNames: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };
const nameOf = (key: string) => kNames[key] ?? (key.length === 1 ? key.toUpperCase() : key);

const kGroups: readonly { name: string; actions: readonly RoomAction["do"][] }[] = [
  { name: "Rating", actions: ["stars", "point", "unrate", "best", "worst", "pick"] },
  { name: "Breeding", actions: ["breed", "more", "blend", "copy", "paste", "keep", "show", "undo", "redo"] },
  { name: "Models", actions: ["step", "one", "pairs", "turning", "scale", "back"] },
];

export function RoomKeys() {
  return kGroups.map(({ name, actions }) => (
    <section key={name} aria-label={name}>
      <h3>{name}</h3>
      <dl>
        {ROOM_KEYS.filter((one) => !one.unlisted && actions.includes(one.action.do)).map((one, i) => (
          <div key={i}>
            <dt>{[...(one.mod ? ["Ctrl"] : []), ...(one.shift ? ["Shift"] : []), nameOf(one.keys[0]!), ...(one.action.do === "stars" ? ["…", "5"] : [])].map((key) => <kbd key={key}>{key}</kbd>)}</dt>
            <dd>{one.words}</dd>
          </div>
        ))}
      </dl>
    </section>
  ));
}
