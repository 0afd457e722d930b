// The four modes of section 4.3 of GenTree's paper.
import type { RoomSettings } from "../api";

export type Mode = NonNullable<RoomSettings["mode"]>;
export type Method = NonNullable<RoomSettings["method"]>;
export const kModes: readonly Mode[] = ["rate_and_edit", "rate", "edit", "neither"];
export const kModeNames: Record<Mode, string> = { rate_and_edit: "Rate and edit", rate: "Rate only", edit: "Edit only", neither: "Neither: watch it drift" };
export const kMethodNames: Record<Method, string> = { free: "Free", classic: "GenTree classic" };
/** Of a first generation, where nobody said. */
export const kPopulation: Record<Method, number> = { free: 12, classic: 20 };
