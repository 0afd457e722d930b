"""docs/experiments.md and its charts, from what the searches left."""
import os
import platform
import statistics

from chart import chart
from claims import CLAIMS_2016, CLAIMS_2017, effect, percent
from breeding import TITLE, breeding_section
from breeding import is_complete as has_bred
from curves_page import curves_section
from curves_results import is_complete
from markdown import save, table
from plan import MARKS, OURS, PUBLISHED, ROOT, SCENES, STUDY, STUDY_TARGETS, TUNE_SECONDS, TUNED, variants
from results import Comparison, Sweep, quartiles, read_csv


def cell(comparison, variant, mark):
    shares = comparison.shares(variant, mark)
    if not shares:
        return "–"
    low, middle, high = quartiles(shares)
    return f"{percent(middle)} <small>({100 * (high - low):.1f})</small>"


def scene_section(name, scene, title, comparison):
    marks = [mark for mark in MARKS if mark < comparison.seconds] + [comparison.seconds]
    rows = [[f"`{v}`"] + [cell(comparison, v, mark) for mark in marks] + [f"{comparison.speed(v):,.0f}".replace(",", " ")]
            for v in comparison.curves]
    lines = [{"name": v, "points": comparison.mean_curve(v)} for v in comparison.curves]
    low = min(p[1] for line in lines for p in line["points"][len(line["points"]) // 8:])
    save(f"{name}.svg", chart(title, lines, "seconds", "share of the optimum", log_x=True, percent=True,
                              y_range=(max(low, -0.05), 1.0)))
    head = ["", *[f"{mark:g} s" for mark in marks], "evaluations/s"]
    return (f"### {title}\n\n`{scene}`\n\n{table(head, rows)}\n![{title}: mean over time](pictures/experiments/{name}.svg)\n")


def number_rows(comparisons):
    """At every mark: the best of ours against the best published engine."""
    rows, met = [], True
    for name, _, title in SCENES:
        if name not in comparisons:
            continue
        c = comparisons[name]
        for mark in [m for m in MARKS if m <= c.seconds]:
            middle = {v: quartiles(c.shares(v, mark)) for v in c.curves if c.shares(v, mark)}
            ours = max((v for v in OURS if v in middle), key=lambda v: middle[v][1])
            theirs = max((v for v in PUBLISHED if v in middle), key=lambda v: middle[v][1])
            slack = middle[theirs][2] - middle[theirs][0]
            lead = middle[ours][1] - middle[theirs][1]
            hybrid = middle["hybrid"][1] - middle[theirs][1] if "hybrid" in middle else float("nan")
            holds = lead >= -slack
            met = met and holds
            rows.append([title, f"{mark:g} s", f"`{ours}` {percent(middle[ours][1])}",
                         f"`{theirs}` {percent(middle[theirs][1])}", f"{100 * lead:+.1f} %", f"{100 * hybrid:+.1f} %",
                         f"{100 * slack:.1f} %", "yes" if holds else "**no**"])
    return rows, met


def tuned_rows(out):
    rows = []
    for name, scene, title in SCENES:
        for engine in TUNED:
            folder = os.path.join(out, "tune", f"{name}-{engine}")
            if not os.path.exists(os.path.join(folder, "sweep.csv")):
                continue
            finals = {}
            searches = read_csv(os.path.join(folder, "sweep.csv"))
            keys = [key for key in searches[0] if key.startswith("engine.")]
            for row in searches:
                values = ", ".join(f"{key.split('.')[-1]} {row[key]}" for key in keys)
                finals.setdefault(values, []).append(float(row["share"]))
            best = max(finals, key=lambda v: statistics.median(finals[v]))
            worst = min(finals, key=lambda v: statistics.median(finals[v]))
            rows.append([title, f"`{engine}`", best, percent(statistics.median(finals[best])), worst,
                         percent(statistics.median(finals[worst]))])
    return rows


def study_chart(target, name, sweep):
    lines = [{"name": key, "points": sweep.curve(key)} for key in sweep.curves]
    title = f"{target}: {', '.join(key.split('.')[-1] for key in sweep.keys)}"
    save(f"2016-{target}-{name}.svg", chart(title, lines, "generation", "mean of the best"))


def study_section(sweeps, seeds):
    rows = []
    for target in STUDY_TARGETS:
        for name, claim, judge in CLAIMS_2016:
            if (target, name) in sweeps:
                holds, figure = judge(sweeps[target, name])
                rows.append([claim, target, "holds" if holds else "**does not**", figure])
        if (target, "mutation") in sweeps and (target, "mutation-large") in sweeps:
            small, large = effect(sweeps[target, "mutation"]), effect(sweeps[target, "mutation-large"])
            rows.append(["Fig. 6: the effect of mutation shrinks in a larger population", target,
                         "holds" if large < small else "**does not**",
                         f"0 to 1: {small:+.4f} of 50 individuals, {large:+.4f} of 200"])
    text = table(["claim", "target", "", "score of at most 1, mean over seeds"], rows)
    for (target, name), sweep in sweeps.items():
        study_chart(target, name, sweep)
    text += "\n" + "\n".join(f"![{target}, {name}](pictures/experiments/2016-{target}-{name}.svg)"
                             for target, name in sweeps if name != "mutation-large") + "\n"
    return text


def times_section(sweeps):
    rows = []
    for (target, name), sweep in sweeps.items():
        if name != "presets":
            continue
        for preset, paper in (("ga-2016", "0.25 s, 12.38 s"), ("ga-2016-final", "0.9 s, 45.63 s")):
            seconds = [float(row["seconds"]) for row in sweep.finals[preset]]
            rows.append([target, f"`{preset}`", paper, f"{1000 * statistics.median(seconds) / 50:.2f} ms",
                         f"{statistics.median(seconds):.3f} s"])
    return table(["target", "", "paper: evaluation per generation, in all", "here: generation, all of it", "in all"], rows)


def machine():
    model = ""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    return f"{model or platform.machine()}, {os.cpu_count()} cores"


def load(out):
    comparisons, sweeps = {}, {}
    for name, _, _ in SCENES:
        folder = os.path.join(out, "compare", name)
        if os.path.exists(os.path.join(folder, "compare.json")):
            comparisons[name] = Comparison(folder)
    for target in STUDY_TARGETS:
        for name in STUDY:
            folder = os.path.join(out, "study", f"{target}-{name}")
            if os.path.exists(os.path.join(folder, "curves.csv")):
                sweeps[target, name] = Sweep(folder)
    return comparisons, sweeps


def conditions(comparisons):
    """Of all comparisons; those that differ say so each."""
    told = {}
    for name, comparison in comparisons.items():
        about = comparison.about
        clock = "seconds of computing" if about.get("clock") == "computing" else "seconds of the clock"
        where = about.get("machine") or {}
        cpu = f"{where['cpu']}, {where['cores']} cores" if where.get("cpu") else machine()
        threads = about["threads"]
        text = (f"{cpu}; {threads} thread{'s' if threads > 1 else ''}, {comparison.seconds:g} {clock} each; "
                f"{len(about['seeds_counted'])} seeds, all variants taking turns")
        told.setdefault(text, []).append(name)
    return "; ".join(text + (f" ({', '.join(names)})" if len(told) > 1 else "") for text, names in told.items()) + "."


def judged(judge, comparison):
    holds, figure = judge(comparison)
    if "nan" in figure:
        return "undecided", figure
    return "holds" if holds else "**does not**", figure


def write_page(out):
    comparisons, sweeps = load(out)
    parts = [INTRODUCTION]
    if comparisons:
        parts.append("Measured on: " + conditions(comparisons) + "\n")
        rows = []
        for name, claim, judge in CLAIMS_2017:
            if name in comparisons:
                holds, figure = judged(judge, comparisons[name])
                title = next(t for n, _, t in SCENES if n == name)
                rows.append([title, claim, holds, figure])
        parts.append("## What ShapeGenetics (2017) says, and what we find\n\n" + CLAIM_NOTE +
                     table(["scene", "claim", "", "figure"], rows))
        rows, met = number_rows(comparisons)
        verdict = "Met at every mark." if met else "**Not met** where it says no."
        parts.append("## Ours against the best published engine\n\n" + NUMBER_NOTE + verdict + "\n\n" +
                     table(["scene", "after", "best of ours", "best published", "lead", "hybrid's lead",
                            "interquartile range", "met"], rows))
        parts.append("## Scene by scene\n\n" + SCENE_NOTE)
        parts += [scene_section(name, scene, title, comparisons[name]) for name, scene, title in SCENES
                  if name in comparisons]
    rows = tuned_rows(out)
    if rows:
        parts.append("## How engines were tuned\n\n" + TUNE_NOTE +
                     table(["scene", "engine", "best", "median", "worst", "median"], rows))
    if sweeps:
        seeds = len(next(iter(sweeps.values())).about["seeds"])
        parts.append(f"## The study of 2016\n\n{STUDY_NOTE.format(seeds=seeds)}" + study_section(sweeps, seeds))
        parts.append("### Table 1: times\n\n" + times_section(sweeps))
    if is_complete(os.path.join(out, "curves")):
        parts.append(curves_section(os.path.join(out, "curves")))
    bred = os.path.join(out, "breeding")
    if has_bred(bred):
        parts.append(breeding_section(bred))
    path = os.path.join(ROOT, "docs", "experiments.md")
    text = "\n".join(parts)
    if not comparisons and not sweeps and has_bred(bred):
        # Nothing else was measured on this machine: what others found stays.
        with open(path, encoding="utf-8") as file:
            text = with_section(file.read(), TITLE, parts[-1])
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def with_section(text, title, section):
    """The page with this section in the place of the one of the same title, or behind all others."""
    before, found, rest = text.partition(title + "\n")
    behind = rest.find("\n## ")
    return before.rstrip("\n") + "\n\n" + section + (rest[behind:] if found and behind >= 0 else "")


VARIANTS = table(["variant", "what"], [
    ["`ga`", "the published genetic algorithm, `ga-2017` with the scene's published settings"],
    ["`smc`, `sosmc`, `rjmcmc`", "the samplers ([engines.md](engines.md)) with settings tuned for the scene"],
    ["`better-ga`", "the genetic algorithm with what we added (`ga-large`: small steps from the best, what several gained is joined), its population tuned"],
    ["`hybrid`", "SOSMC for the start, then `better-ga` and `rjmcmc` in turns"],
])

INTRODUCTION = f"""# Experiments

The experiments of *ShapeGenetics* (2017) and of the study before it (Haubenwallner et al. 2016), made again: which engine is best
when, and which of the papers' claims hold. This page is written by a program, figures and verdicts too:

    python3 bench/experiments           # tunes, compares, studies: some hours on two cores
    python3 bench/experiments --page    # only writes the page anew, from out/experiments; script/setup experiments installs python3

{VARIANTS}
All engines are textbook-correct and share moves and scorer; the published program had faults that handicapped its samplers
(weights turned round, one gene per step). So where a claim does not hold here, the engine that lost there may be better here.
Our engines score tens of thousands of models a second where the papers' did hundreds: seconds here stand for their minutes.
"""

CLAIM_NOTE = """A claim about minutes is held against the same share of our budget. Figures are means over the seeds, as shares of the
optimum. The rules: *plateau* is a rise below 1 % in the second half, *stuck* one below 2 % after the first tenth, *equal* is within 0.5 %
at 1, 3, 10, 30 and 100 % of the budget, *reached* within 1 %; where some seed has no score yet, there is no verdict.

"""
NUMBER_NOTE = """The better of `better-ga` and `hybrid` shall never be below any published engine by more than the seeds' interquartile range
of that engine. Medians over the seeds.

"""
SCENE_NOTE = """Median share of the optimum over the seeds, in brackets the interquartile range in percent. Charts show the mean, and the
standard deviation as a band. Targets are our own, in the form of the published ones; weights, cameras and grids are the published ones, but
for the tree that avoids a volume, where ours is harder.

"""
TUNE_NOTE = f"""By `espalier sweep` with {TUNE_SECONDS} seconds of one core's computing and three seeds that the comparisons do not use. The best
combination, or one that is not told apart from it, is in the scene file or in the variant; the worst shows how much it matters.
What is best in {TUNE_SECONDS} seconds need not be best in thirty.

"""
STUDY_NOTE = """`scenes/spaceship-2016.toml` with the paper's baseline (50 individuals, 50 generations, one elite), one parameter at a time, on two
targets that the grammar can reach exactly (`scenes/targets/ship-2016`, `barge-2016`); {seeds} seeds where the paper had 3. The rules: *little*
is less than a quarter of the gain before, *more is better* that 0.5 and 1 are better than 0, *alike* within 0.05, *harm* more than 0.005,
*only early* a range that has halved. Where the ends differ by less than the seeds scatter, another set of seeds may say otherwise.

"""
