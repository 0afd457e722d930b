#pragma once
// GrammarReport: what a grammar can make: facts of its graph, what follows from them, and what samples show.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "derivation/expectation.h"
#include "grammar/outline.h"
#include "model/mesh_source.h"
#include "run/grammar_file.h"

namespace espalier {

struct ExplainRequest {
  std::string grammar;                            // path
  std::map<std::string, std::string> attributes;  // as the language writes them
  std::uint32_t samples = 1000;                   // >= 1
  std::uint64_t seed = 1;                         // the samples are those of `espalier sample`
};

/// Of one quantity over all samples. Quantiles are samples: the smallest with at least that share at or below.
struct Spread {
  double mean = 0, least = 0, low = 0, median = 0, high = 0, most = 0;  // low, high: 5 % and 95 %
};
Spread spread_of(std::vector<double> values);

struct RuleReport {
  std::string name;
  std::size_t draws = 0;  // numbers of a gene
  std::size_t required_slots = 0, optional_slots = 0;
  std::size_t variants = 0;
  std::optional<std::uint32_t> limit;
  std::string guard;                    // as written; empty: none
  std::vector<std::string> spawned_by;  // rules; empty for the start rule
  std::optional<double> expected;       // genes per derivation, by the graph; see expected_genes
  double mean = 0;                      // genes per sample
};

struct AttributeReport {
  std::string name, written, range, label;  // as in the text; `written`: the value in effect
  double value = 0, low = 0, high = 0, step = 0;  // angles in radians
  bool ranged = false;
};

struct MeshReport {
  std::string name;  // "box", "cone of 16 sides", or the path
  std::size_t triangles = 0;
};

/// Once samples have this many parts together, no more are drawn: grammars of large models would take minutes.
inline constexpr double kMostPartsOfSamples = 5e6;

struct SampleReport {
  std::size_t count = 0;  // of the samples asked for, at least 50 if so many were
  Spread genes, levels, parts, details, triangles;  // parts: emits of rules; details: of details
  Spread log_prior;
  std::array<Spread, 3> size;   // metres; of the samples that show anything
  Bounds box;                   // around all samples; empty where none shows anything
  std::size_t open = 0;         // samples that reached the budget of genes: slots of theirs are open
  std::size_t thinned = 0;      // samples whose details reached their budget
  std::size_t dropped = 0;      // samples with parts left out because a size was negative or not finite
  std::size_t bare = 0;         // samples that show nothing
  double draw_seconds = 0, build_seconds = 0;  // per sample, on one thread
};

struct GrammarReport {
  LoadedGrammar grammar;
  std::vector<RuleReport> rules;
  std::vector<AttributeReport> attributes;
  std::vector<MeshReport> meshes;
  std::optional<double> expected;  // genes
  std::vector<DerivationCount> derivations;
  SampleReport samples;
};

/// Throws Error. All but the times is the same for any number of threads.
GrammarReport explain_grammar(const ExplainRequest& request, MeshSource& source, Executor& executor);

}  // namespace espalier
