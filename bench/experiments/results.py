"""What searches came to, read from the files of `espalier compare` and `espalier sweep`."""
import csv
import json
import os
import statistics


def read_csv(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def at_shares(values, shares):
    """What those shares of the values are below, between neighbours in proportion."""
    values = sorted(values)

    def at(share):
        rank = share * (len(values) - 1)
        below = int(rank)
        above = min(below + 1, len(values) - 1)
        return values[below] + (rank - below) * (values[above] - values[below])

    return tuple(at(share) for share in shares)


def quartiles(values):
    return at_shares(values, (0.25, 0.5, 0.75))


def rank_test(first, second):
    """How often chance alone sets two samples so far apart: Mann and Whitney's test, two-sided, by its normal limit, with ties."""
    pooled = sorted([(value, 0) for value in first] + [(value, 1) for value in second])
    n, m, total = len(first), len(second), len(pooled)
    ranks, ties, at = 0.0, 0, 0
    while at < total:
        end = at
        while end < total and pooled[end][0] == pooled[at][0]:
            end += 1
        ranks += (at + end + 1) / 2 * sum(1 for _, side in pooled[at:end] if side == 0)
        ties += (end - at) ** 3 - (end - at)
        at = end
    deviation = (n * m / 12 * (total + 1 - ties / (total * (total - 1)))) ** 0.5
    if deviation == 0:
        return 1.0
    return 2 * (1 - statistics.NormalDist().cdf(abs(ranks - n * (total + 1) / 2) / deviation))


class Comparison:
    """One scene: the share of the optimum that each variant's seeds had reached at points of time."""

    def __init__(self, folder):
        with open(os.path.join(folder, "compare.json"), encoding="utf-8") as file:
            self.about = json.load(file)
        self.seconds = self.about["budget"]["seconds"]
        self.curves = {}  # variant -> seed -> [(seconds, share)]
        for row in read_csv(os.path.join(folder, "compare.csv")):
            if row["axis"] != "seconds" or row["share"] == "":
                continue
            seeds = self.curves.setdefault(row["engine"], {})
            seeds.setdefault(int(row["seed"]), []).append((float(row["at"]), float(row["share"])))
        self.searches = read_csv(os.path.join(folder, "searches.csv"))

    def shares(self, variant, seconds):
        """Of the seeds that had made a step by then."""
        shares = []
        for curve in self.curves[variant].values():
            reached = [share for at, share in curve if at <= seconds * (1 + 1e-9)]
            if reached:
                shares.append(reached[-1])
        return shares

    def mean(self, variant, seconds):
        shares = self.shares(variant, seconds)
        return statistics.fmean(shares) if len(shares) == len(self.curves[variant]) else float("nan")

    def mean_curve(self, variant):
        """(seconds, mean, standard deviation) where every seed has a share."""
        times = sorted({at for curve in self.curves[variant].values() for at, _ in curve})
        points = []
        for t in times:
            shares = self.shares(variant, t)
            if len(shares) == len(self.curves[variant]):
                points.append((t, statistics.fmean(shares), statistics.stdev(shares) if len(shares) > 1 else 0.0))
        return points

    def reaching(self, variant, share):
        """When the mean first came up to `share`; None: it did not."""
        for t, mean, _ in self.mean_curve(variant):
            if mean >= share:
                return t
        return None

    def speed(self, variant):
        rows = [row for row in self.searches if row["engine"] == variant]
        return sum(float(r["evaluations"]) for r in rows) / sum(float(r["seconds"]) for r in rows)


class Sweep:
    """One study: mean best and population mean by step, per value."""

    def __init__(self, folder):
        with open(os.path.join(folder, "sweep.json"), encoding="utf-8") as file:
            self.about = json.load(file)
        curves = read_csv(os.path.join(folder, "curves.csv"))
        own = ("combination", "step", "seeds", "evaluations", "seconds", "best_mean", "best_deviation",
               "population_mean", "population_deviation")
        self.keys = [key for key in curves[0] if key not in own]
        self.curves = {}  # value(s) -> rows in order of steps
        for row in curves:
            self.curves.setdefault(self.name(row), []).append(row)
        self.finals = {}
        for row in read_csv(os.path.join(folder, "sweep.csv")):
            self.finals.setdefault(self.name(row), []).append(row)

    def name(self, row):
        return " + ".join(row[key] for key in self.keys)

    def curve(self, name, column="best_mean"):
        return [(int(row["step"]), float(row[column])) for row in self.curves[name]]

    def at(self, name, step, column="best_mean"):
        rows = [row for row in self.curves[name] if int(row["step"]) <= step]
        return float(rows[-1][column])

    def final(self, name):
        return [float(row["score"]) for row in self.finals[name]]
