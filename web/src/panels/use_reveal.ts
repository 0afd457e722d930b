import { useEffect, useRef } from "preact/hooks";

/** Of what shall come into sight when `key` becomes another: selected in the view, its settings are seen at once. */
export function useReveal<T extends HTMLElement>(key: unknown) {
  const element = useRef<T>(null);
  const before = useRef(key);
  useEffect(() => {
    if (before.current === key) return;
    before.current = key;
    element.current?.scrollIntoView({ block: "nearest" });
  }, [key]);
  return element;
}
