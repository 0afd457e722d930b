#include "cmd/declare.h"

#include <CLI/CLI.hpp>

#include "cmd/verbs.h"

namespace espalier {
namespace {

/// What compare and sweep share.
void declare_contest(CLI::App* verb, ContestOptions& o) {
  verb->add_option("scene", o.scene, "Scene file (.toml)")->required();
  verb->add_option("--seeds", o.seeds, "How many, from the scene's on (" + o.seeds + "); or which: 3,7,9");
  verb->add_option("--seed", o.seed, "The first of them")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  verb->add_option("--time", o.seconds, "Seconds for each search (replaces the scene's budget)");
  verb->add_option("--evaluations", o.evaluations, "Evaluations for each search (replaces the scene's budget)");
  verb->add_option("--clock", o.clock, "What seconds are: wall, or computing of all threads together (wall)");
  declare_threads(verb, o.threads);
  declare_settings(verb, o.settings);
  declare_attributes(verb, o.attributes);
  verb->add_flag("--json", o.json, "Events as JSON lines");
}

}  // namespace

void declare_attributes(CLI::App* verb, std::vector<std::string>& attributes) {
  verb->add_option("-D", attributes, "Set an attribute of the grammar: -D name=value (repeatable)")->expected(1)
      ->take_all();
}

void declare_grammar(CLI::App* verb, std::string& grammar) {
  verb->add_option("--grammar", grammar, "Grammar of a derivation, if it lies neither in a run's folder nor near it");
}

void declare_detail(CLI::App* verb, DetailOptions& detail) {
  verb->add_option("--joints", detail.joints, "smooth: what touches end to end becomes one tube; separate: as it is");
  verb->add_option("--lod", detail.lod, "Level of detail, 0 (finest) to 3, with one mesh per material");
}

void declare_settings(CLI::App* verb, std::vector<std::string>& settings) {
  verb->add_option("--set", settings, "Change a setting of the scene: --set volume.cells=500000 (repeatable)")
      ->expected(1)->take_all();
}

void declare_threads(CLI::App* verb, int& threads) {
  verb->add_option("--threads", threads, "Threads to use; 0 = one per core. Results do not depend on it")
      ->check(CLI::Range(0, 1024));
}

void refuse_empty_values(const CLI::App* verb) {
  for (const CLI::Option* option : verb->get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty()) throw CLI::ValidationError(option->get_name(), "must not be empty, got \"\"");
    }
  }
}

void declare_compare(CLI::App& app, CompareOptions& o, std::function<int()>& chosen) {
  CLI::App* verb = app.add_subcommand("compare", "Search a scene with several engines or settings, side by side");
  declare_contest(verb, o);
  verb->add_option("--engines", o.engines, "Engines, with commas between (all)");
  verb->add_option("--variant", o.variants,
                   "Another that takes part: --variant \"NAME: engine=ga, search.preset=ga-2017\" (repeatable)")
      ->expected(1)->take_all();
  verb->add_option("--marks", o.marks, "Seconds, or evaluations, at which scores are told: 1,5,30 (a few)");
  verb->add_option("--out", o.out, "Folder to write (out/NAME-compare); an earlier comparison there is replaced");
  verb->callback([verb, &o, &chosen] {
    refuse_empty_values(verb);
    chosen = [&o] { return compare_verb(o); };
  });
}

void declare_sweep(CLI::App& app, SweepOptions& o, std::function<int()>& chosen) {
  CLI::App* verb = app.add_subcommand("sweep", "Search a scene with every combination of some settings");
  o.seeds = "3";
  declare_contest(verb, o);
  verb->add_option("--vary", o.varied, "A setting and its values: --vary search.population=10,50,200 (repeatable)")
      ->expected(1)->take_all()->required();
  verb->add_option("--engine", o.engine, "ga, smc, sosmc, rjmcmc, hybrid, guided or genesis (the scene's)");
  verb->add_option("--generations", o.generations, "Steps for each search (replaces the scene's budget)");
  verb->add_option("--random", o.random, "Only so many of the combinations, drawn by the first seed")
      ->check(CLI::Range(1, 1000));
  verb->add_flag("--curves", o.curves, "Write curves.csv: best and mean of the population, step by step");
  verb->add_option("--out", o.out, "Folder to write (out/NAME-sweep); an earlier sweep there is replaced");
  verb->callback([verb, &o, &chosen] {
    refuse_empty_values(verb);
    chosen = [&o] { return sweep_verb(o); };
  });
}

void declare_similarity(CLI::App& app, SimilarityOptions& o, std::function<int()>& chosen) {
  CLI::App* verb = app.add_subcommand("similarity", "Say how far apart the shapes of models are");
  verb->add_option("models", o.models, "Two or more: .derivation.json, folders of runs (their best), pictures made of "
                                       "derivations, or mesh files")
      ->required();
  declare_grammar(verb, o.grammar);
  declare_attributes(verb, o.attributes);
  verb->add_option("--pairs", o.pairs, "Pairs of points per voxel; more make less noise (30)");
  verb->add_option("--grid", o.grid, "Voxels along each axis, 1 to 16 (4)");
  verb->add_option("--bins", o.bins, "Bins of a histogram, 2 to 100 (10)");
  verb->add_option("--range", o.range, "Where the bins end, metres; published: 1.5 (the diagonal of a voxel)");
  verb->add_option("--box", o.box, "own: each model in its own box; shared: all in one, place and size count (own)");
  verb->add_option("--over", o.over, "Matrices are of all voxels, or of those occupied by either of the two (all)");
  verb->add_option("--seed", o.seed, "Seed (1)")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  verb->add_option("--csv", o.csv, "File to write: the matrix of medians");
  declare_threads(verb, o.threads);
  verb->add_flag("--json", o.json, "As JSON");
  verb->callback([verb, &o, &chosen] {
    refuse_empty_values(verb);
    chosen = [&o] { return similarity_verb(o); };
  });
}

}  // namespace espalier
