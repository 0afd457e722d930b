import { base64Of } from "../base/base64";
import { currentView } from "../shell/view_access";
import type { Studio } from "../store/studio";

/** Keeps the model that is shown, with a picture of it as it is seen. */
export async function keepFavourite(studio: Studio): Promise<void> {
  if (studio.state.shown.value === null) return;
  const portrait = (await currentView.value?.picture()) ?? null;
  const picture = portrait && { model: portrait.model, picture: await base64Of(portrait.image) };
  await studio.ask({ kind: "keep_favourite", ...picture });
}
