import { useRef } from "preact/hooks";
import { uniqueName } from "../base/unique_name";

/** Names of gestures: one from pointer-down to pointer-up, and one for keys until the focus goes. */
export function useGesture(name: string): { current(): string; next(): void } {
  const gesture = useRef("");
  return {
    current: () => (gesture.current ||= uniqueName(name)),
    next: () => {
      gesture.current = "";
    },
  };
}
