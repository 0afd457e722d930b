// espalier inspect: what a file says about where it came from.
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cmd/gene_list.h"
#include "cmd/verbs.h"
#include "io/provenance.h"
#include "run/checkpoint.h"
#include "run/find_derivation.h"

namespace espalier {
namespace {

void print_text(const std::string& file, const Provenance& p) {
  fmt::print("{}: made by espalier {} ({}", file, p.version, p.made_by);
  if (!p.engine.empty()) fmt::print(", engine {}", p.engine);
  fmt::print(")\n");
  if (!p.settings.empty()) {
    fmt::print("seed {}, {} steps, {}\n", p.seed, p.steps,
               p.index == 0 ? "the first or best" : fmt::format("number {}", p.index));
  }
  if (!p.derivation.empty()) fmt::print("derivation {}\n", p.derivation);
  if (p.score) fmt::print("score {:.10g}", *p.score);
  if (p.score && p.optimum && *p.optimum > 0) fmt::print(" of at most {:.10g}", *p.optimum);
  if (p.score) fmt::print("\n");
  for (const auto& [name, hash] : p.inputs) fmt::print("input {}  {}\n", hash, name);
  if (!p.picture.empty()) fmt::print("picture:\n{}", p.picture);
  if (!p.settings.empty()) fmt::print("settings (folder {}):\n{}", p.settings_folder, p.settings);
}

/// As much as tells what a file is; empty where it cannot be read.
std::string read_start_of(const std::string& path) {
  std::string start(64, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start;
}

void print_checkpoint(const InspectOptions& options, const Checkpoint& c) {
  if (options.json) {
    fmt::print("{}\n", nlohmann::json({{"checkpoint", 1},
                                       {"version", c.version},
                                       {"grammar", c.grammar},
                                       {"engine", c.engine},
                                       {"seed", c.seed},
                                       {"step", c.step},
                                       {"evaluations", c.evaluations},
                                       {"seconds", c.seconds},
                                       {"best", c.best},
                                       {"inputs", c.inputs},
                                       {"settings", c.settings}}).dump());
    return;
  }
  fmt::print("{}: checkpoint of a run by espalier {} ({}, engine {})\n", options.file, c.version, c.grammar, c.engine);
  fmt::print("seed {}, step {}, {} evaluations, {:.1f} s, best {:.10g}\n", c.seed, c.step, c.evaluations, c.seconds,
             c.best);
  for (const auto& [name, hash] : c.inputs) fmt::print("input {}  {}\n", hash, name);
  fmt::print("settings:\n{}", c.settings);
}

}  // namespace

int inspect_verb(const InspectOptions& options) {
  if (!options.grammar.empty() && !options.genes) throw Error("--grammar goes with --genes");
  if (options.genes) {
    const LoadedDerivation loaded = load_derivation(find_derivation(options.file), options.grammar, {});
    fmt::print("{}", options.json ? gene_list_json(loaded) : gene_list(loaded));
    return kDone;
  }
  if (const std::string start = read_start_of(options.file); is_checkpoint(start)) {
    print_checkpoint(options, read_checkpoint(options.file));
    return kDone;
  }
  const Provenance provenance = read_provenance(options.file);
  if (options.json) {
    fmt::print("{}\n", to_json(provenance));
  } else {
    print_text(options.file, provenance);
  }
  return kDone;
}

}  // namespace espalier
