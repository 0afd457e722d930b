// espalier inspect: what a file says about where it came from.
#include <fmt/format.h>

#include "cmd/verbs.h"
#include "io/provenance.h"

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
  if (p.score && p.optimum) fmt::print(" of at most {:.10g}", *p.optimum);
  if (p.score) fmt::print("\n");
  for (const auto& [name, hash] : p.inputs) fmt::print("input {}  {}\n", hash, name);
  if (!p.picture.empty()) fmt::print("picture:\n{}", p.picture);
  if (!p.settings.empty()) fmt::print("settings (folder {}):\n{}", p.settings_folder, p.settings);
}

}  // namespace

int inspect_verb(const InspectOptions& options) {
  const Provenance provenance = read_provenance(options.file);
  if (options.json) {
    fmt::print("{}\n", to_json(provenance));
  } else {
    print_text(options.file, provenance);
  }
  return kDone;
}

}  // namespace espalier
