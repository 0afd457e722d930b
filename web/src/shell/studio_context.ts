import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Studio } from "../store/studio";

export const StudioContext = createContext<Studio | null>(null);

export function useStudio(): Studio {
  const studio = useContext(StudioContext);
  if (studio === null) throw new Error("no studio around this component");
  return studio;
}
