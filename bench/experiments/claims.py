"""The claims of the papers, each with what was measured. A claim is a function that returns (holds, figure)."""
import math
import statistics


def percent(share):
    return f"{100 * share:.1f} %"


def seconds(value):
    return "never" if value is None else f"{value:.3g} s"


def smc_first_sosmc_later(c):
    early = c.seconds / 100
    a, b = c.mean("smc", early), c.mean("sosmc", early)
    x, y = c.mean("smc", c.seconds), c.mean("sosmc", c.seconds)
    return a > b and y > x, (f"after {early:g} s SMC {percent(a)}, SOSMC {percent(b)}; after {c.seconds:g} s "
                             f"{percent(x)} and {percent(y)}")


def plateau(c):
    rises = {v: c.mean(v, c.seconds) - c.mean(v, c.seconds / 2) for v in ("smc", "sosmc")}
    return max(rises.values()) < 0.01, "rise in the second half: " + ", ".join(
        f"{v.upper()} {percent(r)}" for v, r in rises.items())


def rjmcmc_overtakes(c):
    passed = {v: c.reaching("rjmcmc", c.mean(v, c.seconds)) for v in ("smc", "sosmc")}
    return None not in passed.values(), "RJMCMC passes what they end with: " + ", ".join(
        f"{v.upper()} after {seconds(t)}" for v, t in passed.items())


def ga_ends_best(c):
    ends = {v: c.mean(v, c.seconds) for v in ("ga", "smc", "sosmc", "rjmcmc")}
    return max(ends, key=ends.get) == "ga", ", ".join(f"{v} {percent(s)}" for v, s in ends.items())


def ga_reaches_rjmcmc_early(c):
    end = c.mean("rjmcmc", c.seconds)
    t = c.reaching("ga", end)
    reached = "never" if t is None else "after " + seconds(t)
    return t is not None and t <= c.seconds * 3 / 20, (
        f"RJMCMC ends with {percent(end)} after {c.seconds:g} s; the GA is there {reached}, ends with "
        f"{percent(c.mean('ga', c.seconds))}")


def smc_never_there(c):
    t = [c.reaching(v, c.mean("ga", c.seconds * 3 / 20)) for v in ("smc", "sosmc")]
    return t == [None, None], f"the GA's score after {c.seconds * 3 / 20:g} s: SMC {seconds(t[0])}, SOSMC {seconds(t[1])}"


def ga_best_at_all_times(c):
    worst = {}
    for share in (0.01, 0.03, 0.1, 0.3, 1):
        t = c.seconds * share
        best = max(("smc", "sosmc", "rjmcmc"), key=lambda v: c.mean(v, t))
        if any(math.isnan(c.mean(v, t)) for v in ("ga", "smc", "sosmc", "rjmcmc")):
            return False, f"at {t:g} s some seeds are nan: no step has ended yet"
        if c.mean("ga", t) < c.mean(best, t) - 0.005:
            worst[t] = best
    return not worst, "behind by more than 0.5 %: " + (
        ", ".join(f"at {t:g} s behind {v}" for t, v in worst.items()) or "nowhere")


def stuck(c):
    rises = {v: c.mean(v, c.seconds) - c.mean(v, c.seconds / 10) for v in ("smc", "sosmc")}
    return max(rises.values()) < 0.02, "; ".join(
        f"{v.upper()} {percent(c.mean(v, c.seconds / 10))} after a tenth of the time, {percent(c.mean(v, c.seconds))} "
        f"at the end" for v in rises)


def sosmc_reaches_rjmcmc(c):
    gap = c.mean("rjmcmc", c.seconds) - c.mean("sosmc", c.seconds)
    return gap < 0.01, f"RJMCMC {percent(c.mean('rjmcmc', c.seconds))}, SOSMC {percent(c.mean('sosmc', c.seconds))}"


CLAIMS_2017 = [
    ("spaceship", "SMC is ahead of SOSMC first, SOSMC later", smc_first_sosmc_later),
    ("spaceship", "SMC and SOSMC plateau", plateau),
    ("spaceship", "RJMCMC overtakes both in the long run", rjmcmc_overtakes),
    ("spaceship", "the GA ends best of the four", ga_ends_best),
    ("sketch", "the GA reaches in 3 minutes what RJMCMC does in 20", ga_reaches_rjmcmc_early),
    ("sketch", "SMC and SOSMC never reach that", smc_never_there),
    ("avoid", "the GA is best or equal at all times", ga_best_at_all_times),
    ("silhouette", "the GA is best or equal at all times", ga_best_at_all_times),
    ("silhouette", "SOSMC finally reaches RJMCMC", sosmc_reaches_rjmcmc),
    ("silhouette-long", "the GA is best or equal at all times", ga_best_at_all_times),
    ("silhouette-long", "SOSMC finally reaches RJMCMC", sosmc_reaches_rjmcmc),
    ("city", "the GA is best or equal at all times", ga_best_at_all_times),
    ("city", "SMC and SOSMC do not improve after the first generations", stuck),
]


def best_pairing(s):
    ends = {name: statistics.fmean(s.final(name)) for name in s.curves}
    order = sorted(ends, key=ends.get, reverse=True)
    pair = {"roulette + tournament", "tournament + roulette"}
    return order[0] in pair, "; ".join(f"{name} {ends[name]:.4f}" for name in order)


def random_worst(s):
    ends = {name: statistics.fmean(s.final(name)) for name in s.curves}
    last = min(ends, key=ends.get)
    return last == "random + random", f"last: {last}, {ends[last]:.4f}"


def tournaments_fastest(s):
    early = {name: s.at(name, 5) for name in s.curves}
    first = max(early, key=early.get)
    return first == "tournament + tournament", f"after 5 generations first: {first}, {early[first]:.4f}"


def means(s):
    return {float(name): statistics.fmean(s.final(name)) for name in s.curves}


def listed(values):
    return ", ".join(f"{key:g}: {value:.4f}" for key, value in sorted(values.items()))


def larger_is_better(s):
    m = means(s)
    return all(m[a] <= m[b] for a, b in zip(sorted(m), sorted(m)[1:])), listed(m)


def little_beyond_200(s):
    m = means(s)
    return m[500] - m[200] < 0.25 * (m[200] - m[10]), f"10 to 200: {m[200] - m[10]:+.4f}, 200 to 500: {m[500] - m[200]:+.4f}"


def more_mutation_better(s):
    m = means(s)
    return m[1] > m[0] and m[0.5] >= m[0], listed(m)


def effect(s):
    m = means(s)
    return m[1] - m[0]


def elitism_in_the_middle(s):
    m = means(s)
    return max(m, key=m.get) in (10, 15), listed(m)


def large_elites_hurt(s):
    m = means(s)
    return m[45] < max(m.values()) - 0.005, listed(m)


def length_matters_early(s):
    at = lambda step: [s.at(name, step) for name in s.curves]
    early, late = max(at(1)) - min(at(1)), max(at(50)) - min(at(50))
    return late < early / 2, f"range over lengths: {early:.4f} in the first generation, {late:.4f} in the last"


def presets_alike(s):
    a, b = (s.final(name) for name in ("ga-2016", "ga-2016-final"))
    more_reliable = statistics.stdev(b) < statistics.stdev(a)
    close = abs(statistics.fmean(a) - statistics.fmean(b)) < 0.05
    return close and more_reliable, (f"baseline {statistics.fmean(a):.4f} ± {statistics.stdev(a):.4f}, final "
                                     f"{statistics.fmean(b):.4f} ± {statistics.stdev(b):.4f}")


CLAIMS_2016 = [
    ("selection", "Fig. 4: roulette and tournament together are best", best_pairing),
    ("selection", "Fig. 4: random selection of both is worst", random_worst),
    ("selection", "Fig. 4: two tournaments are fastest at first", tournaments_fastest),
    ("population", "Fig. 5: larger populations are better", larger_is_better),
    ("population", "Fig. 5: beyond 200 they bring little", little_beyond_200),
    ("mutation", "Fig. 6: more mutation is better", more_mutation_better),
    ("elitism", "Fig. 7: 10 to 15 elites of 50 are best", elitism_in_the_middle),
    ("elitism", "Fig. 7: large elites do harm", large_elites_hurt),
    ("length", "Fig. 8: the initial length matters only early", length_matters_early),
    ("presets", "Figs. 9, 10: baseline and final end alike, the final more reliably", presets_alike),
]
