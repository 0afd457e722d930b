import { Icon } from "../controls/icons";
import { IconButton } from "../controls/fields";
import { showNumber } from "../controls/number";
import { useStudio } from "../shell/studio_context";

/** `keep`: what the button keeps, where it is not the model that is shown. */
export function FavouritesStrip({ keep }: { keep?: { words: string; disabled: boolean; run(): void } }) {
  const studio = useStudio();
  const favourites = studio.document.value?.favourites ?? [];
  const nothing = studio.state.shown.value === null;
  return (
    <section class="favourites" aria-label="Favourites">
      <button type="button" class="button" disabled={keep?.disabled ?? nothing} onClick={keep?.run ?? (() => void studio.ask({ kind: "keep_favourite" }))} title={keep?.words ?? "Keep the model that is shown (K)"}>
        <Icon name="star" />Keep
      </button>
      {favourites.length === 0 && <span class="hint">Models that you keep stand here.</span>}
      <ul>
        {favourites.map((favourite) => (
          <li key={favourite.id}>
            <button type="button" class="favourite" title={favourite.words} onClick={() => void studio.ask({ kind: "show_favourite", favourite: favourite.id })}>
              <b>{showNumber(favourite.score)}</b>
              <span>{favourite.genes} genes</span>
            </button>
            <IconButton label={`Drop favourite of score ${showNumber(favourite.score)}`} kind="small" onClick={() => void studio.ask({ kind: "drop_favourite", favourite: favourite.id })}>
              <Icon name="close" />
            </IconButton>
          </li>
        ))}
      </ul>
    </section>
  );
}
