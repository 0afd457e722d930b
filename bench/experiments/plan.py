"""What is searched: the six scenes of ShapeGenetics (2017) with all engines, and the parameter study of the 2016 paper."""
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MARKS = [1, 5, 30]

# name, scene, title, settings of the scenes' own that all variants share
SCENES = [
    ("spaceship", "scenes/spaceship-published.toml", "Spaceship volume (Figs. 3, 7)"),
    ("sketch", "scenes/published/tree-sketch1.toml", "Tree sketch (Figs. 1, 7)"),
    ("avoid", "scenes/tree-avoid.toml", "Tree avoiding a volume (Fig. 9a)"),
    ("silhouette", "scenes/published/city-filling-shoe.toml", "City silhouette, short (Fig. 9b)"),
    ("silhouette-long", "scenes/published/city-filling-shoe-long.toml", "City silhouette, long (Fig. 9c)"),
    ("city", "scenes/published/city-filling-volume.toml", "City volume (Fig. 9d)"),
]

# The published engines, and ours beside them. Samplers have their tuned settings in the scene files.
PUBLISHED = {"ga": "engine=ga", "smc": "engine=smc", "sosmc": "engine=sosmc", "rjmcmc": "engine=rjmcmc"}
OURS = {"better-ga": "engine=ga", "hybrid": "engine=hybrid"}
# Where the scene's own [engine.ga] is ours, the published one is named here, and the other way round.
GA_PUBLISHED = {"avoid": ["engine.ga.preset=ga-2017"]}
LARGE = ["engine.ga.preset=ga-large", "engine.ga.grow=1", "engine.ga.cut=0.5", "engine.ga.alter=0.2",
         "engine.ga.nudge=1", "engine.ga.mutation=0.5", "engine.ga.elitism=4"]  # scenes name some of them otherwise
GA_POPULATION = {"spaceship": 60, "sketch": 30, "avoid": 150, "silhouette": 150, "silhouette-long": 150, "city": 150}
GA_ADAPTS = {"sketch", "avoid", "city"}  # where adapting the moves' rates helped

# How engines were tuned: other seeds than those that are compared, so many seconds of one core's computing each.
TUNE_SEEDS, TUNE_SECONDS = "11,12,13", 2
TUNED = {
    "smc": {"temperature": [0.0003, 0.001, 0.003, 0.01, 0.03], "particles": [100, 500, 2000]},
    "sosmc": {"temperature": [0.0003, 0.001, 0.003, 0.01, 0.03], "particles": [100, 500, 2000]},
    "rjmcmc": {"temperature": [0.00003, 0.0001, 0.0003, 0.001, 0.003], "chains": [1, 4]},
    "ga": {"population": [30, 60, 150], "adapt": ["false", "true"]},
}
TUNE_ALSO = {"rjmcmc": ["engine.rjmcmc.temperatures=1"], "ga": LARGE}

# The 2016 study: baseline as printed there (section 4.2), one parameter at a time.
STUDY_SCENE = "scenes/spaceship-2016.toml"
STUDY_TARGETS = {"ship": "targets/ship-2016.obj", "barge": "targets/barge-2016.obj"}
STUDY = {
    "selection": "search.first=roulette,tournament,random --vary search.second=roulette,tournament,random",
    "population": "search.population=10,50,100,200,500 --set search.elitism=1",
    "mutation": "search.mutation=0,0.25,0.5,0.75,1",
    "mutation-large": "search.mutation=0,0.25,0.5,0.75,1 --set search.population=200",
    "elitism": "search.elitism=0,5,10,15,25,45",
    "length": "search.initial_length=10,25,50,100",
    "presets": "search.preset=ga-2016,ga-2016-final",
}


def variants(name):
    """Name to the words of --variant."""
    words = {}
    for variant, engine in {**PUBLISHED, **OURS}.items():
        settings = [engine]
        if variant == "ga":
            settings += GA_PUBLISHED.get(name, [])
        elif variant in OURS:
            settings += LARGE + [f"engine.ga.population={GA_POPULATION[name]}"]
            settings += ["engine.ga.adapt=true"] if name in GA_ADAPTS else []
        words[variant] = ", ".join(settings)
    return words


def espalier(*arguments):
    command = [os.environ.get("ESPALIER", os.path.join(ROOT, "build", "espalier")), *arguments]
    print("+ espalier " + " ".join(arguments), flush=True)
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + f"\nespalier ended with {done.returncode}")
    return done.stdout


def optimum(scene):
    """The most that any model could score, as the program says."""
    import json
    out = os.path.join(ROOT, "out", "experiments", "optimum")
    espalier("run", scene, "--generations", "1", "--keep", "0", "--set", "output.picture=[16,16]", "--out", out)
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        return json.load(file)["optimum"]


def tune(out, names):
    for name, scene, _ in SCENES:
        if names and name not in names:
            continue
        most = optimum(scene)
        for engine, varied in TUNED.items():
            words = []
            for key, values in varied.items():
                values = [f"{value * most:.4g}" if key == "temperature" else str(value) for value in values]
                words += ["--vary", f"engine.{engine}.{key}=" + ",".join(values)]
            for setting in TUNE_ALSO.get(engine, []):
                words += ["--set", setting]
            espalier("sweep", scene, "--engine", engine, *words, "--seeds", TUNE_SEEDS, "--time", str(TUNE_SECONDS),
                     "--threads", "1", "--clock", "computing", "--out", os.path.join(out, "tune", f"{name}-{engine}"))


def compare(out, names, seconds, seeds, threads, clock):
    for name, scene, _ in SCENES:
        if names and name not in names:
            continue
        words = []
        for variant, settings in variants(name).items():
            words += ["--variant", f"{variant}: {settings}"]
        marks = [str(mark) for mark in MARKS if mark < seconds] + [str(seconds)]
        espalier("compare", scene, *words, "--seeds", str(seeds), "--time", str(seconds), "--marks", ",".join(marks),
                 "--threads", str(threads), "--clock", clock, "--out", os.path.join(out, "compare", name))


def study(out, seeds, threads):
    for target, mesh in STUDY_TARGETS.items():
        for name, varied in STUDY.items():
            preset = [] if name == "presets" else ["--set", "search.preset=ga-2016"]
            espalier("sweep", STUDY_SCENE, "--set", f"volume.mesh.0.file={mesh}", *preset, "--vary", *varied.split(),
                     "--generations", "50", "--seeds", str(seeds), "--curves", "--threads", str(threads), "--out",
                     os.path.join(out, "study", f"{target}-{name}"))
