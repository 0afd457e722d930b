"""The section of docs/experiments.md about the guiding-curve paper, and its box plots."""
import statistics

from boxes import box_chart
from curves import CHAIN, CHAINS, COST_SCENES, COST_VARIANTS, OFFSETS, PARTICLE_STEPS, SETS, STRIDE, TIMED, TIMED_SEEDS
from curves_results import (COST_CLAIMS, LIKENESS_CLAIMS, READINGS, SILHOUETTE_CLAIMS, Curves, below, judged_rows,
                            spread)
from claims import percent
from markdown import save, table
from results import at_shares

SCENE_TITLES = {"appendix": "Tree of appendix A", "benchmark": "Tree of Calder's benchmark"}
SET_TITLES = {"paper": "the paper's constants", "drawn": "drawn curves"}
KIND_TITLES = {
    "self": "a model and itself", "same": "same curves", "unguided": "no curves", "different": "different curves",
    "sosmc": "same silhouette, SOSMC", "hybrid": "same silhouette, hybrid"}
# Fig. 6 by its table, and by the data of one chain in the paper's repository (calder-gl/calder 3f1ad68).
FIGURE_6 = {60: 0.53, 35: 0.20, 5: 0.10}
REPOSITORY_6 = {60: 0.533, 55: 0.233, 50: 0.267, 45: 0.367, 40: 0.300, 35: 0.200, 30: 0.133, 25: 0.200, 20: 0.167, 15: 0.133,
                10: 0.133, 5: 0.100, 0: 0.067}
FOLDER = "pictures/experiments/"
CHARTED = ("published", "one box")  # the readings with pictures: as in the paper, and where most can be told apart


def cost_text(value):
    return f"{value:,.0f}".replace(",", " ").replace("-", "−")


def stricter_row(curves, scene):
    gains = [statistics.median(curves.costs[scene, offset]["ramp"]) - statistics.median(curves.costs[scene, offset]["heuristic"])
             for offset in OFFSETS]
    strict, lenient = gains[OFFSETS.index(max(OFFSETS))], gains[OFFSETS.index(min(OFFSETS))]
    verdict = "holds" if strict > lenient else "**does not**"
    return ["the stricter the offset, the more the heuristic takes off the median of the ramp", SCENE_TITLES[scene],
            *(f"{verdict}: {cost_text(gain)}" for gain in gains)]


def cost_section(curves):
    rows = [[claim, SCENE_TITLES[scene], *(below(curves.costs[scene, offset][less], curves.costs[scene, offset][more], cost_text)
                                           for offset in OFFSETS)]
            for claim, less, more in COST_CLAIMS for scene in COST_SCENES]
    rows += [stricter_row(curves, scene) for scene in COST_SCENES]
    parts = [COST_NOTE, table(["claim", "scene", *(f"offset {offset:g}" for offset in OFFSETS)], rows)]
    rows = []
    for scene, title in SCENE_TITLES.items():
        groups = []
        for offset in OFFSETS:
            for colour, variant in enumerate(COST_VARIANTS):
                costs = curves.costs[scene, offset][variant]
                groups.append({"name": f"{variant} {offset:g}", "values": costs, "colour": colour})
                shares = [cost_text(v) for v in at_shares(costs, (0.05, 0.25, 0.5, 0.75, 0.95))]
                rows.append([title, f"{offset:g}", f"`{variant}`", len(costs), *shares, cost_text(sum(costs) / len(costs))])
        save(f"curves-cost-{scene}.svg", box_chart(f"{title}: what the best skeleton costs, by variant and offset", groups,
                                                   "cost; less is better"))
        parts.append(f"![{title}: costs]({FOLDER}curves-cost-{scene}.svg)\n")
    parts.append(table(["scene", "offset", "variant", "models", "5 %", "lower", "median", "upper", "95 %", "mean"], rows))
    return "\n".join(parts)


def mutation_section(curves):
    steps = list(range(0, CHAIN + 1, STRIDE))
    its = curves.mutation
    told = sorted(FIGURE_6)
    rows = [[f"{a} steps apart is nearer than {b}", *(below(its.distances(a, reading), its.distances(b, reading), "{:.3f}".format)
                                                     for reading in READINGS)] for a, b in zip(told, told[1:])]
    parts = [MUTATION_NOTE, table(["claim", *READINGS], rows)]
    for reading in CHARTED:
        groups = [{"name": s, "values": its.distances(s, reading), "colour": 0,
                   "mark": REPOSITORY_6[s] if reading == "published" else None} for s in steps]
        name = f"curves-mutation-{file_name(reading)}.svg"
        save(name, box_chart(f"Distance by steps since two models parted ({reading})", groups, "distance",
                             "steps of growth since they parted"))
        parts.append(f"![Distance by steps, {reading}]({FOLDER}{name})\n")
    rows = [[s, f"{FIGURE_6[s]:.2f}" if s in FIGURE_6 else "–", f"{REPOSITORY_6[s]:.3f}", len(its.distances(s, "published")),
             *(spread(its.distances(s, reading)) for reading in READINGS)] for s in reversed(steps)]
    parts.append(table(["steps", "Fig. 6", "its repository", "pairs", *READINGS], rows))
    return "\n".join(parts)


def likeness_table(curves, name, kinds):
    its = curves.likeness[name]
    rows = []
    for kind in kinds:
        cells = [cell for reading in READINGS
                 for cell in (spread(its.distances(kind, reading)), spread(its.ranges(kind, reading)))]
        rows.append([KIND_TITLES[kind], len(its.distances(kind, "published")), *cells])
    return table([SET_TITLES[name], "pairs", *(head for reading in READINGS for head in (reading, "range"))], rows)


def file_name(reading):
    return reading.replace(" ", "-")


def likeness_charts(curves, name, kinds, of, file, title, readings=CHARTED):
    parts = []
    for reading in readings:
        groups = [{"name": KIND_TITLES[kind], "values": getattr(curves.likeness[name], of)(kind, reading)} for kind in kinds]
        its_file = f"{file}-{file_name(reading)}.svg"
        save(its_file, box_chart(f"{title} ({reading})", groups, "distance" if of == "distances" else "range"))
        parts.append(f"![{title}, {reading}]({FOLDER}{its_file})\n")
    return "\n".join(parts)


def likeness_section(curves):
    kinds = ["self", "same", "unguided", "different"]
    head = ["claim", "models", *READINGS]
    whole = ", ".join(f"{its['whole']} of {its['drawn']} were whole ({SET_TITLES[name]})" for name, its in curves.whole.items())
    parts = [LIKENESS_NOTE.format(whole=whole), table(head, judged_rows(curves, LIKENESS_CLAIMS, SET_TITLES))]
    for name, title in SET_TITLES.items():
        parts.append(likeness_charts(curves, name, kinds, "distances", f"curves-likeness-{name}",
                                     f"Distance of two models: {title}"))
        parts.append(likeness_charts(curves, name, kinds, "ranges", f"curves-range-{name}",
                                     f"Interquartile range of a pair's distances: {title}", ("published",)))
    parts += [likeness_table(curves, name, kinds) for name in SETS]
    return "\n".join(parts)


def times_table(curves):
    rows = []
    for kind, engine in TIMED.items():
        its = curves.times[kind]
        shares = [percent(float(row["share"])) for row in its if row["share"]]
        rows.append([KIND_TITLES[kind], f"`{engine}`", cost_text(float(its[0]["evaluations"])),
                     f"{statistics.median(float(row['seconds']) for row in its):.2g} s",
                     f"{min(shares)} to {max(shares)}" if shares else "–"])
    return table([f"of {TIMED_SEEDS} searches", "engine", "particle-steps or models", "seconds of computing, median",
                  "share of the silhouette's optimum"], rows)


def silhouette_section(curves):
    kinds = ["self", "same", "sosmc", "hybrid"]
    return "\n".join([
        SILHOUETTE_NOTE, times_table(curves), table(["claim", "models", *READINGS], judged_rows(curves, SILHOUETTE_CLAIMS, SET_TITLES)),
        likeness_charts(curves, "drawn", kinds, "distances", "curves-silhouette", "Distance of two models: curves or a silhouette"),
        likeness_table(curves, "drawn", kinds)])


def curves_section(folder):
    curves = Curves(folder)
    cpu = curves.machine.get("cpu") or "an unnamed processor"
    return "\n".join([
        INTRODUCTION.format(minutes=f"{curves.seconds / 60:.0f}", cpu=cpu),
        "### Fig. 4: cost with and without the heuristic\n\n" + cost_section(curves),
        "### Fig. 6: distance by mutation\n\n" + mutation_section(curves),
        "### Fig. 7: who is like whom\n\n" + likeness_section(curves),
        "### Fig. 8: curves or a silhouette\n\n" + silhouette_section(curves)])


INTRODUCTION = """## Guiding curves: Figs. 4, 6, 7 and 8

The studies of *Controlling Procedural Modelling Interactively with Guiding Curves* (2018) made again, by
`python3 bench/experiments curves` ({minutes} minutes of one core; {cpu}). A claim *holds* where the medians are in its order and a
rank test (Mann and Whitney, two-sided, uncorrected) gives chance less than 5 %; where chance makes as much or the medians are equal it
is *undecided*. In boxes: quartiles and median, whiskers from 5 % to 95 %, a dot for the mean.

The distance of two models is the subdivided D2 of the paper ([tools.md](tools.md#similarity)), a set of numbers, one per voxel, read
in three ways:

- *published*: the median over all voxels, as in the paper (`--range 1.5`; each model in a box of its own, 30 pairs of points). Thin
  trees leave more than half of the voxels empty, which count 0: hence the zeros.
- *occupied*: the same, without voxels that are empty in both. Where only one of two has something the distance is 1: hence the ones.
- *one box*: both models in one box, 300 pairs of points, the mean over voxels that are occupied (`--box shared --pairs 300`).

"""
COST_NOTE = f"""{PARTICLE_STEPS} particle-steps each, one search per seed, the best skeleton ever seen: `plain` has as many particles at each
of a hundred steps, `ramp` fewer and fewer, `heuristic` also weighs promises; these are one sweep each, as in the paper. `rounds` is ours:
a coarse sweep, and what is left for taking back and growing anew. The paper gave each 200 ms and has no numbers, only a picture; in
the program that was published the directions to be expected always came to nothing and weights overflowed, so it may show something
else. On the tree of appendix A a hundred bones in line with the curves cost 100 x 400 x (offset - 1), with what utilisation adds: at 0.6
about -16 000. Most searches end near that, and variants differ in how often they fail.

"""
MUTATION_NOTE = f"""{CHAINS} trees of appendix A grown for {CHAIN} steps; from each, at some step, a clone that forgets the rest and is grown
anew until it has as many. Trees that ended before are left out, and of clones the first of four counts that did not. White diamonds:
data in the paper's repository, one pair each. How full its voxels were the paper does not say: its leaves are meshes of its own, so
hold its numbers against *published* and *occupied* both.

"""
LIKENESS_NOTE = """*same curves*: two models of different seeds; *different curves*: one each of two sets of curves; *no curves*: grown at
random, about as many steps as the guided have bones, without those that ended before: {whole}. But for different curves, each
model is in two pairs. Two series:

- *the paper's constants* on the two curves of its program (`scenes/guided-tree.toml`, turned around for *different*), by the paper's one
  sweep. Most such trees grow along one of the two curves, so two led by the same curves may have gone different ways.
- *drawn curves* that branches follow to their ends (`scenes/guided-bonsai.toml` and `guided-spiral.toml`), by our engine.

*range*: the interquartile range of a pair's distances over voxels; where nearly all are 1, since the two are nowhere in the same place,
it is 0. In one box, trees without curves are as far apart as can be, for they grow anywhere; those of different curves share the stem.

"""
SILHOUETTE_NOTE = """The bonsai by its curves, or by a silhouette of 100 x 100 pixels that was drawn along them
(`bench/experiments/bonsai-silhouette.toml`), by SOSMC as in the paper and by our hybrid. The paper took less than 200 ms for curves and
45 s for a silhouette. At the budget here silhouettes are far from filled; with more time models would be more alike from the front,
which is all that a silhouette sees.

"""
