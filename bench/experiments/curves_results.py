"""What the studies of the guiding-curve paper came to, and its claims."""
import json
import os
import statistics

from curves import COST_SCENES, OFFSETS, SETS, TIMED
from results import quartiles, rank_test, read_csv

# What stands for the set of a pair's distances, one a voxel. Where most voxels are occupied by one of two only, medians are 1
# and say no more; means go on to tell.
READINGS = {"published": "median", "occupied": "median", "one box": "mean"}
CHANCE = 0.05


def is_complete(folder):
    """All parts were made: the last one was."""
    return os.path.exists(os.path.join(folder, "distances", "mutation.csv"))


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class Likeness:
    """Of every pair of models of a kind, by a reading: the distance, and the interquartile range of its set over the voxels."""

    def __init__(self, path):
        self.rows = {}
        for row in read_csv(path):
            self.rows.setdefault((row["kind"], row["reading"]), []).append(row)

    def distances(self, kind, reading):
        return [float(row[READINGS[reading]]) for row in self.rows[str(kind), reading]]

    def ranges(self, kind, reading):
        return [float(row["upper"]) - float(row["lower"]) for row in self.rows[str(kind), reading]]


class Curves:
    def __init__(self, folder):
        self.costs = {}  # (scene, offset) -> variant -> costs
        for scene in COST_SCENES:
            for offset in OFFSETS:
                path = os.path.join(folder, "cost", f"{scene}-{offset:g}")
                its = self.costs.setdefault((scene, offset), {})
                for row in read_csv(os.path.join(path, "searches.csv")):
                    its.setdefault(row["engine"], []).append(-float(row["score"]))
                self.machine = read_json(os.path.join(path, "compare.json")).get("machine") or {}
        distances = os.path.join(folder, "distances")
        self.likeness = {name: Likeness(os.path.join(distances, name + ".csv")) for name in SETS}
        self.mutation = Likeness(os.path.join(distances, "mutation.csv"))
        self.times = {kind: read_csv(os.path.join(folder, "times", kind, "searches.csv")) for kind in TIMED}
        self.seconds = sum(read_json(os.path.join(folder, "seconds.json")).values())
        self.whole = {name: read_json(os.path.join(folder, "models", name, "whole.json")) for name in SETS}


def probability(p):
    return "p < 0.001" if p < 0.001 else f"p = {p:.2g}"


def below(first, second, written):
    """Whether the median of `first` is below that of `second`, and chance alone would hardly make it so; with both medians."""
    a, b, p = statistics.median(first), statistics.median(second), rank_test(first, second)
    verdict = "undecided" if p >= CHANCE or a == b else "holds" if a < b else "**does not**"
    return f"{verdict}: {written(a)}, {written(b)} ({probability(p)})"


# Fig. 4: (claim, variant that costs less, variant that costs more)
COST_CLAIMS = [
    ("heuristic and ramp cost less than the ramp alone", "heuristic", "ramp"),
    ("the ramp costs less than as many particles at each step", "ramp", "plain"),
    ("heuristic and ramp cost less than neither", "heuristic", "plain"),
    ("ours: rounds cost less than the paper's sweep", "rounds", "heuristic"),
]

# Figs. 7, 8: (claim, sets, less, more, of distances or of ranges)
LIKENESS_CLAIMS = [
    ("a model and itself are more alike than two led by the same curves", ("paper", "drawn"), "self", "same", "distances"),
    ("two led by the same curves are more alike than two without", ("paper", "drawn"), "same", "unguided", "distances"),
    ("two without are more alike than two led by different curves", ("paper", "drawn"), "unguided", "different", "distances"),
    ("the range is less for the same curves than for none", ("paper", "drawn"), "same", "unguided", "ranges"),
    ("the range is less for different curves than for none", ("paper", "drawn"), "different", "unguided", "ranges"),
]
SILHOUETTE_CLAIMS = [
    ("two led by the same curves are more alike than two that fill the same silhouette (SOSMC)", ("drawn",), "same", "sosmc",
     "distances"),
    ("the same, silhouettes filled by the hybrid", ("drawn",), "same", "hybrid", "distances"),
]


def judged_rows(curves, claims, names):
    rows = []
    for claim, sets, less, more, of in claims:
        for name in sets:
            its = curves.likeness[name]
            values = [(getattr(its, of)(less, reading), getattr(its, of)(more, reading)) for reading in READINGS]
            rows.append([claim, names[name], *(below(a, b, "{:.3f}".format) for a, b in values)])
    return rows


def spread(values, written="{:.3f}"):
    """Median, and in small the quartiles."""
    lower, middle, upper = (written.format(v).replace(",", " ") for v in quartiles(values))
    return f"{middle} <small>({lower} to {upper})</small>"
