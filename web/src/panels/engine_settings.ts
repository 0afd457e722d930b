// Settings of the engines, with the ranges and defaults of docs/engines.md and docs/scenes.md.
import type { Scene, Value } from "../api";
import { patched } from "../store/scene";

export const ENGINES = ["guided", "ga", "sosmc", "smc", "rjmcmc", "hybrid", "genesis"] as const;
export type Engine = (typeof ENGINES)[number];

export const ENGINE_NAMES: Record<Engine, string> = {
  guided: "Guided (curves)",
  ga: "Genetic algorithm",
  sosmc: "SOSMC",
  smc: "SMC",
  rjmcmc: "RJMCMC",
  hybrid: "Hybrid",
  genesis: "Genesis (bit strings)",
};

export type Setting =
  | { key: string; label: string; kind: "number"; standard: number | null; min: number; max: number; whole?: boolean; step?: number; more?: boolean; title?: string }
  | { key: string; label: string; kind: "bool"; standard: boolean; more?: boolean; title?: string }
  | { key: string; label: string; kind: "choice"; standard: string; choices: readonly string[]; more?: boolean; title?: string };

const number = (key: string, label: string, standard: number | null, min: number, max: number, rest: Partial<Extract<Setting, { kind: "number" }>> = {}): Setting =>
  ({ kind: "number", key, label, standard, min, max, ...rest });
const choice = (key: string, label: string, choices: readonly string[], more = true): Setting =>
  ({ kind: "choice", key, label, choices, standard: choices[0]!, more });
const bool = (key: string, label: string, standard: boolean, title?: string): Setting =>
  ({ kind: "bool", key, label, standard, more: true, ...(title === undefined ? {} : { title }) });

const kResampling = ["systematic", "stratified", "multinomial", "residual"];
const whole = { whole: true } as const;
const more = { more: true } as const;

const sampler: readonly Setting[] = [
  number("particles", "Particles", 500, 2, 1e6, { ...whole, title: "Of the first sweep." }),
  number("steps", "Steps", 10000, 1, 1e6, { ...whole, title: "Of growth in one sweep; then what is unfinished is closed." }),
  number("temperature", "Temperature", null, 1e-9, 1e12, { title: "The lower, the more the score counts. Empty: by the best score that there could be." }),
  number("schedule", "Growth of sweeps", 1, 0.1, 100, { ...more, title: "Each sweep has so many times the particles of the one before." }),
  number("most_particles", "Particles at most", 10000, 2, 1e6, { ...whole, ...more }),
  choice("resampling", "Resampling", kResampling),
  number("resample_below", "Resample below", 0.5, 0, 1, { ...more, step: 0.05 }),
  choice("weight", "Weight", ["exponential", "ratio"]),
];

export const ENGINE_SETTINGS: Record<Engine, readonly Setting[]> = {
  guided: [
    number("steps", "Steps", 100, 1, 100000, { ...whole, title: "As many bones as the model may have." }),
    number("particles", "Particles", 100, 2, 1e6, { ...whole, title: "Of the first step." }),
    number("temperature", "Temperature", 1, 1e-9, 1e12, { title: "How soon it settles for the better of two bones: about what one new segment is worth." }),
    number("last_particles", "Particles at last", 15, 2, 1e6, { ...whole, ...more }),
    number("heuristic", "Promises", 0.013, 0, 1e6, { ...more, step: 0.001, title: "How much what may grow counts at first." }),
    number("heuristic_steps", "Promises until step", 40, 0, 100000, { ...whole, ...more }),
    choice("resampling", "Resampling", kResampling),
    bool("regrow", "Rounds", true, "After the first sweep parts of the best are grown anew."),
    number("regrow_particles", "Particles of rounds", 16, 2, 1e6, { ...whole, ...more }),
    number("regrow_steps", "Steps of rounds", 12, 1, 100000, { ...whole, ...more }),
  ],
  ga: [
    choice("preset", "Preset", ["ga-2017", "ga-local", "ga-large", "ga-2016", "ga-2016-final", "ga-2017-city"], false),
    number("population", "Population", 150, 2, 1e6, whole),
    number("elitism", "Elite", 30, 0, 1e6, whole),
    number("mutation", "Mutation", 0.3, 0, 1, { step: 0.05 }),
    number("initial_length", "First genes", 50, 1, 1e6, { ...whole, ...more }),
    number("grow", "Grow", 0.45, 0, 1000, { ...more, step: 0.05 }),
    number("cut", "Cut", 0.45, 0, 1000, { ...more, step: 0.05 }),
    number("alter", "Alter", 0.1, 0, 1000, { ...more, step: 0.05 }),
    number("nudge", "Nudge", 0, 0, 1000, { ...more, step: 0.05 }),
    choice("crossover", "Crossover", ["edge", "symbol"]),
    bool("adapt", "Adapt", false, "Chances follow what each kind of change brought."),
    bool("unique", "No twins", false),
    bool("join", "Join changes", false, "For models of thousands of genes."),
    number("restart_after", "Restart after", 0, 0, 1e9, { ...whole, ...more, title: "Generations without a better model; 0: never." }),
  ],
  smc: sampler,
  sosmc: sampler,
  rjmcmc: [
    number("chains", "Chains", 4, 1, 1000, whole),
    number("temperatures", "Temperatures", 4, 1, 64, whole),
    number("temperature", "Temperature", null, 1e-9, 1e12, { title: "Of the coldest chain. Empty: by the best score that there could be." }),
    number("heat", "Heat", 12.91, 1, 1e6, { ...more, title: "Hottest over coldest temperature." }),
    number("swap_every", "Swap every", 10, 0, 1e6, { ...whole, ...more }),
    number("anneal", "Anneal", 1, 1, 1e6, { ...more, step: 0.1 }),
    number("draws", "Draws", 0.25, 0, 1000, { ...more, step: 0.05 }),
    number("nudges", "Nudges", 0.25, 0, 1000, { ...more, step: 0.05 }),
    number("slots", "Slots", 0.25, 0, 1000, { ...more, step: 0.05 }),
    number("jumps", "Jumps", 0.25, 0, 1000, { ...more, step: 0.05 }),
    choice("choice", "Chooses genes", ["level", "uniform"]),
    bool("delayed", "Delayed rejection", true),
    choice("weight", "Weight", ["exponential", "ratio"]),
  ],
  hybrid: [
    number("sweeps", "Sweeps", 1, 1, 1000, whole),
    number("start_evaluations", "Start", 2000, 1, 1e9, { ...whole, title: "Evaluations before the others take over." }),
    number("turn", "Turn", 3000, 1, 1e9, { ...whole, title: "Evaluations of a turn." }),
  ],
  genesis: [
    number("population", "Population", 50, 2, 100000, { ...whole, title: "Only for grammars whose genome is the draws of the start rule." }),
    number("crossover", "Crossover", 0.6, 0, 1, { step: 0.05 }),
    number("mutation", "Mutation", 0.001, 0, 1, { step: 0.001, title: "Chance of each bit to be drawn anew." }),
    number("gap", "Generation gap", 1, 0.01, 1, { ...more, step: 0.05, title: "Share of the population that is replaced." }),
    choice("selection", "Selection", ["proportional", "ranking"]),
    number("window", "Scaling window", 5, 0, 1e6, { ...whole, ...more, title: "Generations whose worst is the zero of fitness." }),
    number("rank_min", "Places of the worst", 0.75, 0, 1, { ...more, step: 0.05, title: "With ranking." }),
    bool("elitism", "Elite", true, "The best is put back where it was lost."),
    bool("gray", "Gray code", true, "Neighbouring values differ in one bit."),
    number("idle", "Begin anew after", 2, 1, 1000, { ...whole, ...more, title: "Generations with nothing new to score." }),
  ],
};

export function engineOf(scene: Scene): Engine {
  const engine = scene.search?.["engine"];
  return (ENGINES as readonly unknown[]).includes(engine) ? (engine as Engine) : "ga";
}

/** What the scene says for its engine: [engine.NAME] wins over [search]. */
export function settingOf(scene: Scene, key: string): Value | undefined {
  return scene.engine?.[engineOf(scene)]?.[key] ?? (key === "engine" ? undefined : scene.search?.[key]);
}

/** `value` undefined: the default. It is kept in [engine.NAME], and taken out of [search]. */
export function changeSetting(scene: Scene, key: string, value: Value | undefined): Scene {
  const engine = engineOf(scene);
  const own = patched(scene.engine?.[engine] ?? {}, { [key]: value });
  const engines = patched(scene.engine ?? {}, { [engine]: Object.keys(own).length === 0 ? undefined : own });
  return patched(scene, {
    engine: Object.keys(engines).length === 0 ? undefined : engines,
    search: scene.search === undefined ? undefined : patched(scene.search, { [key]: undefined }),
  });
}

export function changeEngine(scene: Scene, engine: Engine): Scene {
  // What [search] said was meant for the engine before.
  const { engine: _, ...others } = scene.search ?? {};
  const before = engineOf(scene);
  const engines = Object.keys(others).length === 0 ? scene.engine : { ...scene.engine, [before]: { ...others, ...scene.engine?.[before] } };
  return patched(scene, { search: { engine }, engine: engines });
}
