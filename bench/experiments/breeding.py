"""How many ratings breeding costs: runs bench/breeding_study.cpp, judges and draws. Below out/experiments/breeding: its tables."""
import csv
import os
import subprocess

from chart import chart
from markdown import save, table
from plan import ROOT

CAP, STEP = 600, 20
METHODS = [("random", "random search"), ("classic", "GenTree classic"), ("ours", "ours"), ("taste", "ours with taste model")]
NOISES = [("steady", "steady"), ("wavering", "wavering")]
GOALS = {"ours": (2, "half"), "taste": (3, "a third")}
PAPER = {1: "–", 2: "5", 3: "20", 4: "7"}  # generations in about an hour (Congdon and Mazza 2003, section 4.3)
WORDS = {1: "neither", 2: "edit", 3: "rate", 4: "edit and rate"}


def breeding(out, favourites, threads):
    build = os.path.join(ROOT, "build")
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DESPALIER_BENCH=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", "breeding_study"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([os.path.join(build, "bench", "breeding_study"), "--out", out, "--favourites", str(favourites), "--threads", str(threads)],
                   check=True)


def is_complete(out):
    return all(os.path.exists(os.path.join(out, name + ".csv")) for name in ("methods", "curves", "variants", "shapes"))


def read(out, name):
    with open(os.path.join(out, name + ".csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def quartiles(values):
    """Lower quartile, median and upper quartile, between neighbours where they fall between. Infinite ones may be among them."""
    ordered = sorted(values)

    def at(share):
        place = share * (len(ordered) - 1)
        low, high = ordered[int(place)], ordered[min(int(place) + 1, len(ordered) - 1)]
        share_of_high = place - int(place)
        return low if low == high or share_of_high == 0 else low + share_of_high * (high - low)

    return at(0.25), at(0.5), at(0.75)


def needed(rows, method, noise):
    """Ratings for each favourite; infinite where the cap was reached first."""
    return [int(r["ratings"]) or float("inf") for r in rows if r["method"] == method and r["noise"] == noise]


def shown(ratings):
    return f"> {CAP}" if ratings == float("inf") else f"{ratings:g}"


def goal(rows, method, noise):
    if method not in GOALS:
        return ""
    parts, words = GOALS[method]
    classic, own = (quartiles(needed(rows, m, noise))[1] for m in ("classic", method))
    if classic == float("inf"):
        return "no median of GenTree classic"
    return f"{'at most' if own * parts <= classic else '**more than**'} {words}: {100 * own / classic:.0f} %"


def method_rows(rows):
    result = []
    for noise, _ in NOISES:
        for method, words in METHODS:
            own = needed(rows, method, noise)
            low, middle, high = (shown(q) for q in quartiles(own))
            shape = quartiles([float(r["shape"]) for r in rows if r["method"] == method and r["noise"] == noise])
            result.append([noise, words, f"**{middle}** <small>({low} to {high})</small>",
                           f"{sum(r <= CAP for r in own)} of {len(own)}", goal(rows, method, noise),
                           f"{shape[1]:.2f} <small>({shape[0]:.2f} to {shape[2]:.2f})</small>"])
    return result


def median_curve(rows, method, noise, until=300):
    """Best distance shown after so many ratings; those who have found a close tree keep its distance."""
    of = {}
    for r in rows:
        if r["method"] == method and r["noise"] == noise:
            of.setdefault(r["favourite"], []).append(float(r["best"]))
    points = []
    for i in range(until // STEP):
        points.append(((i + 1) * STEP, quartiles([c[min(i, len(c) - 1)] for c in of.values()])[1]))
    return points


def share_curve(rows, method, noise):
    """Share of the favourites that were found after so many ratings."""
    own = sorted(needed(rows, method, noise))
    points = [(0, 0)]
    for i, ratings in enumerate(own):
        if ratings <= CAP:
            points += [(ratings, points[-1][1]), (ratings, (i + 1) / len(own))]
    return points + [(CAP, points[-1][1])]


def variant_rows(rows):
    result = []
    for variant, words in WORDS.items():
        own = [r for r in rows if int(r["variant"]) == variant]

        def cell(key, form):
            low, middle, high = (form.format(q) for q in quartiles([float(r[key]) for r in own]))
            return middle if low == high else f"{middle} <small>({low} to {high})</small>"

        result.append([f"{variant}: {words}", PAPER[variant], cell("generations", "{:g}"), cell("best", "{:.3f}"),
                       cell("mean", "{:.3f}"), cell("diversity", "{:.3f}")])
    return result


def breeding_section(out):
    methods, variants, shapes = (read(out, name) for name in ("methods", "variants", "shapes"))
    count = len({r["favourite"] for r in methods})
    close = quartiles([float(r["close"]) for r in methods])
    for noise, words in NOISES:
        save(f"breeding-{noise}.svg", chart(
            f"Favourites found, of {count}: the {words} user",
            [{"name": words_, "points": share_curve(methods, method, noise)} for method, words_ in METHODS],
            "ratings", "found", percent=True, y_range=(0, 1)))
    curves = read(out, "curves")
    save("breeding-distance.svg", chart(
        "Distance of the nearest tree shown: the wavering user, medians",
        [{"name": words, "points": median_curve(curves, method, "wavering")} for method, words in METHODS], "ratings", "distance"))
    again, other = (quartiles([float(r[key]) for r in shapes])[1] for key in ("anew", "other"))
    return (f"{TITLE}\n\n{NOTE.format(count=count, close=close[1])}" +
            table(["user", "method", "ratings, median and quartiles", "found", "of GenTree classic's", "shape"], method_rows(methods)) +
            "\n" + "\n".join(f"![Favourites found after so many ratings, the {w} user](pictures/experiments/breeding-{n}.svg)\n"
                             for n, w in NOISES) +
            "\n![Distance of the nearest tree shown](pictures/experiments/breeding-distance.svg)\n\n" + DISTANCE_NOTE +
            SHAPE_NOTE.format(again=again, other=other) + "\n### GenTree's four variants\n\n" + VARIANT_NOTE +
            table(["variant", "paper", "generations", "best distance", "mean at the end", "diversity"], variant_rows(variants)))


DISTANCE_NOTE = """A search ends where a close tree has been shown, and keeps that distance from then on: lines tell how soon they come down, and
end near what counts as close.

"""
TITLE = "## Breeding: how many ratings a tree costs"
NOTE = """A simulated user has a tree of `grammars/gentree.esp` in mind, a viable one, and rates what it is shown. The distance of two
trees is the mean absolute difference of the quantiles of their 13 genes, the random seed among them; of two random trees it is about 1/3.
Close is what is nearer to the favourite than the best 0.1 % of 100 000 random trees (here {close:.3f}, median). A rating is a number of
clicks up or down from 0, a click for each 0.02 of distance, with Gumbel noise: of scale 0.01 for the steady user, of 0.03 for the wavering
one, who prefers the worse of two trees that are 0.03 apart every fourth time. The user sees trees and nothing else: no genes, no
distances. Counted are the ratings until a close tree is shown, 600 at most; a copy is not rated again. {count} favourites; settings were
chosen with 100 others (`breeding_study --first 1000`).

*Random search* shows random trees. *GenTree classic* is Genesis with the paper's 20 trees, rates and 82 bits ([breeding.md](breeding.md)).
*Ours* and *ours with taste model* are the breeding room's defaults: 12 trees, the best six kept.

"""
SHAPE_NOTE = """*Shape* is the distance of the best tree shown to the favourite as shapes are compared (subdivided D2, 4 x 4 x 4 voxels, 30 pairs of
points, median over voxels with surface; models cut off at 50 000 parts). A favourite is {again:.2f} from itself with other random points, and
{other:.2f} from any other viable tree: as the seed decides where branches stand, trees of like genes look akin but do not fill the same
voxels, and this measure hardly tells them apart.
"""
VARIANT_NOTE = """An hour of simulated work with GenTree classic, by the paper's section 4.3: variants 2 and 4 with an editor who moves one of a
tree's three worst parameters half-way to the favourite. A rating takes 9 s and an edited tree 36 s (what the paper's generations come to
for 20 trees); variant 2 edits all 20 trees, variant 4 the better half of what was rated. The steady user; copies are not rated again, which
the paper's authors did, so there are more generations of ratings than theirs. Variant 1 asks for nothing: 20 generations. Diversity is
the mean distance of two trees at the end, of random ones 1/3.

"""
