import { Icon } from "../controls/icons";
import { IconButton } from "../controls/fields";
import { showNumber } from "../controls/number";
import { useStudio } from "../shell/studio_context";
import { keepFavourite } from "./keep_favourite";

/** `keep`: what the button keeps, where it is not the model that is shown; `shown`: after a favourite was. */
export function FavouritesStrip({ keep }: { keep?: { words: string; disabled: boolean; run(): void; shown(): void } }) {
  const studio = useStudio();
  const favourites = studio.document.value?.favourites ?? [];
  const project = studio.document.value?.project.id;
  const nothing = studio.state.shown.value === null;
  return (
    <section class="favourites" aria-label="Favourites">
      <button type="button" class="button" disabled={keep?.disabled ?? nothing} onClick={keep?.run ?? (() => void keepFavourite(studio))} title={keep?.words ?? "Keep the model that is shown (K)"}>
        <Icon name="star" />Keep
      </button>
      {favourites.length === 0 && <span class="hint">Models that you keep stand here.</span>}
      <ul>
        {favourites.map((favourite) => (
          <li key={favourite.id}>
            <button type="button" class="favourite" title={favourite.words} onClick={() => void studio.ask({ kind: "show_favourite", favourite: favourite.id }).then((done) => done && keep?.shown())}>
              {favourite.picture && project !== undefined
                ? <img src={studio.files.favouriteUrl(project, favourite.id)} alt="" width={64} height={48} loading="lazy" />
                : <span class="no-picture"><Icon name="star" /></span>}
              <span class="favourite-words">
                <b>{showNumber(favourite.score)}</b>
                <span>{favourite.genes} genes</span>
              </span>
            </button>
            <IconButton label={`Drop favourite of score ${showNumber(favourite.score)}`} kind="small" onClick={() => void studio.dropFavourite(favourite.id)}>
              <Icon name="close" />
            </IconButton>
          </li>
        ))}
      </ul>
    </section>
  );
}
