// The view that is on the page, for what is asked of it from elsewhere.
import { signal } from "@preact/signals";
import type { Camera } from "../api";
import type { StudioView } from "../view/host";

export const currentView = signal<StudioView | null>(null);

export function viewCamera(): Camera | null {
  return currentView.value?.camera() ?? null;
}
