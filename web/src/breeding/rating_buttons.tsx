// How a model is rated by clicks: points up and down, stars, the best and the worst.
import { Icon } from "../controls/icons";
import { useStudio } from "../shell/studio_context";
import { kStars, ratingOfStars, ratingWords, starsOf, type RateBy } from "./rating";

/** `tab`: whether the Tab key stops here; in the grid the keys of the cell do the same. */
export function RatingButtons({ id, rating, by, tab }: { id: number; rating: number | undefined; by: RateBy; tab: boolean }) {
  if (by === "stars") return <Stars id={id} rating={rating} tab={tab} />;
  if (by === "extremes") return <Extremes id={id} rating={rating} tab={tab} />;
  return <Points id={id} rating={rating} tab={tab} />;
}

interface Props {
  id: number;
  rating: number | undefined;
  tab: boolean;
}

function Points({ id, rating, tab }: Props) {
  const { room } = useStudio();
  const tabIndex = tab ? 0 : -1;
  const tone = rating === undefined ? "none" : rating > 0 ? "up" : rating < 0 ? "down" : "even";
  return (
    <span class={`rate rate-points ${tone}`} role="group" aria-label={`Rating of ${id}`}>
      <button type="button" tabIndex={tabIndex} aria-label={`${id}: a point less`} title="A point less (−)" onClick={() => room.point(id, -1)}><Icon name="thumbDown" /></button>
      <button type="button" class="rate-value" tabIndex={tabIndex} disabled={rating === undefined} aria-label={`${id}: ${ratingWords(rating)}; take it away`} title={rating === undefined ? "Not rated: counts as the mean of what is" : "Take the rating away (0)"} onClick={() => room.unrate(id)}>
        {rating === undefined ? "·" : ratingWords(rating)}
      </button>
      <button type="button" tabIndex={tabIndex} aria-label={`${id}: a point more`} title="A point more (+)" onClick={() => room.point(id, 1)}><Icon name="thumbUp" /></button>
    </span>
  );
}

function Stars({ id, rating, tab }: Props) {
  const { room } = useStudio();
  const stars = starsOf(rating);
  return (
    <span class={`rate rate-stars ${stars === null ? "none" : ""}`} role="group" aria-label={`Stars of ${id}`}>
      {Array.from({ length: kStars }, (_, i) => i + 1).map((n) => (
        <button
          key={n} type="button" tabIndex={tab ? 0 : -1} class={stars !== null && n <= stars ? "full" : ""} aria-label={`${id}: ${n} of ${kStars} stars`} aria-pressed={stars === n}
          title={n === 3 ? "3 stars: neither for nor against (3)" : `${n} stars (${n})`} onClick={() => room.stars(id, n)}
        >
          <Icon name="star" />
        </button>
      ))}
    </span>
  );
}

function Extremes({ id, rating, tab }: Props) {
  const { room } = useStudio();
  const best = rating === ratingOfStars(kStars), worst = rating === ratingOfStars(1);
  return (
    <span class="rate rate-extremes" role="group" aria-label={`Rating of ${id}`}>
      <button type="button" tabIndex={tab ? 0 : -1} class={worst ? "down" : ""} aria-pressed={worst} aria-label={`${id} is the worst`} title="The worst of this screen (W)" onClick={() => room.extreme(id, "worst")}><Icon name="thumbDown" />Worst</button>
      <button type="button" tabIndex={tab ? 0 : -1} class={best ? "up" : ""} aria-pressed={best} aria-label={`${id} is the best`} title="The best of this screen (B)" onClick={() => room.extreme(id, "best")}><Icon name="thumbUp" />Best</button>
    </span>
  );
}
