"""The studies of "Guiding curves" (2018), Figs. 4, 6, 7 and 8: what is searched, grown and compared, by many small calls.

Below out/experiments/curves: cost/SCENE-OFFSET and times/KIND (of `espalier compare`), models/SET/KIND/NN.derivation.json,
distances/NAME.csv and seconds.json. What is there is not made again.
"""
import csv
import json
import os
import resource
import shutil
import subprocess
import sys

from plan import ROOT

MODELS = 500  # of every distribution but those of silhouettes and of mutation
PUBLISHED_SWEEP = "engine.guided.regrow=false"

# Fig. 4: scenes, each with the offsets of the paper; equal particle-steps.
COST_SCENES = {"appendix": "scenes/guided-tree.toml", "benchmark": "bench/guided_benchmark.toml"}
OFFSETS = (0.6, 0.5)
PARTICLE_STEPS = 5800  # of a hundred steps: 58 particles at each, or falling from 100 to 15
EVEN = ["engine.guided.particles=58", "engine.guided.last_particles=58"]
RAMP = ["engine.guided.particles=100", "engine.guided.last_particles=15"]
COARSE = ["engine.guided.particles=20", "engine.guided.last_particles=8"]
COST_VARIANTS = {
    "plain": [PUBLISHED_SWEEP, *EVEN, "engine.guided.heuristic=0"],
    "ramp": [PUBLISHED_SWEEP, *RAMP, "engine.guided.heuristic=0"],
    "heuristic": [PUBLISHED_SWEEP, *RAMP, "engine.guided.heuristic=0.013"],
    "rounds": COARSE,
}

# Fig. 6: a chain of ancestors, each grown so many steps more; from each a clone grown anew up to as many steps as the last.
GRAMMAR = "grammars/guided-tree.esp"
CHAIN, STRIDE, CHAINS, CHAINS_DRAWN = 60, 5, 100, 250

# Figs. 7, 8: sets of models of one grammar. `grow`: steps of the unguided, about as many as the guided have bones.
TURNED = ["curves.curve.0.points=[[0,0,0],[0,1,0],[-1,1,-1],[-2,2,-1]]",
          "curves.curve.1.points=[[0,1,0],[-0.5,2,-1],[0,3,-1],[0,3,-2]]"]
SETS = {
    "paper": {"attributes": [], "grow": 100, "kinds": {
        "same": ("scenes/guided-tree.toml", PARTICLE_STEPS, [PUBLISHED_SWEEP], MODELS),
        "other": ("scenes/guided-tree.toml", PARTICLE_STEPS, [PUBLISHED_SWEEP, *TURNED], MODELS)}},
    "drawn": {"attributes": ["tufts=true", "shrink=0.8", "forks=18", "leaf_length=0.4"], "grow": 40, "kinds": {
        "same": ("scenes/guided-bonsai.toml", 60000, [], MODELS),
        "other": ("scenes/guided-spiral.toml", 60000, [], MODELS),
        "sosmc": ("bench/experiments/bonsai-silhouette.toml", 20000, ["search.engine=sosmc"], 100),
        "hybrid": ("bench/experiments/bonsai-silhouette.toml", 20000, ["search.engine=hybrid"], 100)}},
}
TIMED, TIMED_SEEDS = {"same": "guided", "sosmc": "sosmc", "hybrid": "hybrid"}, 10  # Fig. 8: kinds and their engines

# How models are compared: words of `espalier similarity`, pairs of models that one call may look at, and how the answer is read:
# over which voxels.
FORMS = [
    (["--range", "1.5"], 250, {"published": "all", "occupied": "occupied"}),
    (["--box", "shared", "--pairs", "300"], 1, {"one box": "occupied"}),
]
STATISTICS = ("median", "lower", "upper", "mean")


def call(*arguments):
    """What the program prints; it ends all where it fails."""
    command = [os.environ.get("ESPALIER", os.path.join(ROOT, "build", "espalier")), *arguments, "--threads", "1"]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(" ".join(command) + "\n" + done.stderr)
    return done.stdout


def settings(words):
    return [word for setting in words for word in ("--set", setting)]


def attributes(words):
    return [word for attribute in words for word in ("-D", attribute)]


def derivation(folder, index):
    return os.path.join(folder, f"{index:02d}.derivation.json")


def is_unfinished(path):
    """Some slot is open: it did not end before its steps did."""
    with open(path, encoding="utf-8") as file:
        return any("O" in gene[2] for gene in json.load(file)["genes"])


def costs(out):
    for name, scene in COST_SCENES.items():
        for offset in OFFSETS:
            folder = os.path.join(out, "cost", f"{name}-{offset:g}")
            if os.path.exists(os.path.join(folder, "compare.json")):
                continue
            words = [f"curves.curve.{curve}.offset={offset:g}" for curve in (0, 1)]
            variants = [word for variant, its in COST_VARIANTS.items()
                        for word in ("--variant", f"{variant}: engine=guided, " + ", ".join(its))]
            call("compare", scene, *settings(words), *variants, "--seeds", str(MODELS), "--evaluations", str(PARTICLE_STEPS),
                 "--marks", str(PARTICLE_STEPS), "--out", folder)


def search(scene, evaluations, words, folder, count):
    """The best of one run per seed."""
    os.makedirs(folder, exist_ok=True)
    scratch = os.path.join(folder, "run")
    for seed in range(1, count + 1):
        path = derivation(folder, seed)
        if os.path.exists(path):
            continue
        call("run", scene, *settings(words + ["output.picture=[16,16]"]), "--seed", str(seed), "--evaluations",
             str(evaluations), "--keep", "0", "--out", scratch)
        os.replace(os.path.join(scratch, "best.derivation.json"), path)
        shutil.rmtree(scratch)


def grow(folder, count, steps, seed, words):
    if not os.path.exists(folder):
        call("sample", GRAMMAR, *attributes(words), "-n", str(count), "--grow", str(steps), "--seed", str(seed),
             "--only-genes", "--out", folder)


def unguided(out, name):
    """Those that took all their steps: others are stubs, which ended in a leaf early on."""
    its = SETS[name]
    folder = os.path.join(out, "models", name, "unguided")
    grow(folder, 2 * MODELS, its["grow"], 1, its["attributes"])
    paths = [derivation(folder, index) for index in range(1, 2 * MODELS + 1)]
    return [path for path in paths if is_unfinished(path)]


def times(out):
    """How long searches of Fig. 8 compute, and how far they come."""
    for kind, engine in TIMED.items():
        folder = os.path.join(out, "times", kind)
        scene, evaluations, _, _ = SETS["drawn"]["kinds"][kind]
        if not os.path.exists(os.path.join(folder, "compare.json")):
            call("compare", scene, "--engines", engine, "--seeds", str(TIMED_SEEDS), "--evaluations", str(evaluations),
                 "--clock", "computing", "--out", folder)


def models(out):
    for name, its in SETS.items():
        for kind, (scene, evaluations, words, count) in its["kinds"].items():
            search(scene, evaluations, words, os.path.join(out, "models", name, kind), count)
        whole = len(unguided(out, name))
        with open(os.path.join(out, "models", name, "whole.json"), "w", encoding="utf-8") as file:
            json.dump({"drawn": 2 * MODELS, "whole": whole}, file)


def batches(pairs, most):
    """Up to `most` pairs at a time, of at most 250 models together."""
    batch, seen = [], set()
    for pair in pairs:
        if batch and (len(batch) == most or len(seen | set(pair[:2])) > 250):
            yield batch
            batch, seen = [], set()
        batch.append(pair)
        seen |= set(pair[:2])
    if batch:
        yield batch


def distances(pairs, words):
    """Of pairs (path, path, kind): rows (kind, reading, statistics); and the same of the first of each pair drawn anew."""
    rows, own = [], []
    for options, most, readings in FORMS:
        for batch in batches(pairs, most):
            paths = list(dict.fromkeys(path for pair in batch for path in pair[:2]))
            told = json.loads(call("similarity", *paths, "--grammar", GRAMMAR, *attributes(words), *options, "--json"))
            place = {path: index for index, path in enumerate(paths)}
            found = {(pair["first"], pair["second"]): pair for pair in told["pairs"]}
            for *pair, kind in batch:
                a, b = (place[path] for path in pair)
                for reading, voxels in readings.items():
                    rows.append((kind, reading, found[min(a, b), max(a, b)][voxels]))
                    own.append(("self", reading, told["models"][a]["anew"][voxels]))
    return rows, own


def write_distances(out, name, rows):
    """Rows: kind, reading, statistics."""
    path = os.path.join(out, "distances", name + ".csv")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path + ".tmp", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["kind", "reading", *STATISTICS])
        for kind, reading, values in rows:
            writer.writerow([kind, reading, *(f"{values[key]:.6f}" for key in STATISTICS)])
    os.replace(path + ".tmp", path)


def ring(paths):
    """Each with the next, the last with the first."""
    return list(zip(paths, paths[1:] + paths[:1]))


def likeness(out):
    for name, its in SETS.items():
        if os.path.exists(os.path.join(out, "distances", name + ".csv")):
            continue
        paths = {kind: [derivation(os.path.join(out, "models", name, kind), seed) for seed in range(1, count + 1)]
                 for kind, (_, _, _, count) in its["kinds"].items()}
        pairs = {kind: ring(paths[kind]) for kind in paths if kind != "other"}
        pairs["unguided"] = ring(unguided(out, name)[:MODELS])
        pairs["different"] = list(zip(paths["same"], paths["other"]))
        rows = []
        for kind, its_pairs in pairs.items():
            of_pairs, of_firsts = distances([(*pair, kind) for pair in its_pairs], its["attributes"])
            rows += of_pairs + (of_firsts if kind == "same" else [])
        write_distances(out, name, rows)


def clones(out, chain, ancestors):
    """By mutation distance: the clone of a chain's ancestor that was grown anew so many steps (the first of four that is no
    stub, if any)."""
    found = {}
    for steps in range(STRIDE, CHAIN + 1, STRIDE):
        folder = os.path.join(out, "models", "mutation", f"{steps:02d}", f"{chain:03d}")
        if not os.path.exists(folder):
            call("sample", GRAMMAR, "--from", derivation(ancestors[CHAIN - steps], chain), "-n", "4", "--grow", str(steps),
                 "--seed", str(1000 * chain + steps), "--only-genes", "--out", folder)
        whole = [path for path in (derivation(folder, index) for index in range(1, 5)) if is_unfinished(path)]
        if whole:
            found[steps] = whole[0]
    return found


def mutation(out):
    if os.path.exists(os.path.join(out, "distances", "mutation.csv")):
        return
    ancestors = {}
    for steps in range(0, CHAIN + 1, STRIDE):  # the same seed: what is grown further begins alike
        ancestors[steps] = os.path.join(out, "models", "mutation", "ancestors", f"{steps:02d}")
        grow(ancestors[steps], CHAINS_DRAWN, steps, 1, [])
    chains = [i for i in range(1, CHAINS_DRAWN + 1) if is_unfinished(derivation(ancestors[CHAIN], i))][:CHAINS]
    rows = []
    for chain in chains:
        target = derivation(ancestors[CHAIN], chain)
        of_pairs, of_firsts = distances([(target, path, steps) for steps, path in clones(out, chain, ancestors).items()], [])
        own = {reading: (0, reading, values) for _, reading, values in of_firsts}
        rows += [*of_pairs, *own.values()]
    write_distances(out, "mutation", rows)


def seconds_used():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def curves(out):
    """All of it; keeps and prints how long the processors computed."""
    out = os.path.abspath(out)  # the program runs in the repository's root
    os.makedirs(out, exist_ok=True)
    path = os.path.join(out, "seconds.json")
    spent = {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            spent = json.load(file)
    for part in (costs, models, times, likeness, mutation):
        before = seconds_used()
        part(out)
        spent[part.__name__] = spent.get(part.__name__, 0) + seconds_used() - before
        print(f"curves, {part.__name__}: {spent[part.__name__]:.0f} s of one core", flush=True)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(spent, file, indent=1)
