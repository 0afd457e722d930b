#pragma once
// What the saved states of all engines have in common: a head that tells whose they are, and individuals.

#include <string>

#include "search/engine.h"
#include "search/gene_limits.h"
#include "search/state_stream.h"

namespace espalier {

/// Everything that must be equal for a continued search to be the same search; `settings` in words.
std::string fingerprint(std::string_view engine, const SearchProblem& problem, const std::string& settings);
void write_head(StateWriter& writer, std::uint64_t magic, std::uint64_t version, const std::string& fingerprint);
/// Throws Error where any of them is another.
void read_head(StateReader& reader, std::uint64_t magic, std::uint64_t version, const std::string& fingerprint);

void write_individual(StateWriter& writer, const Individual& individual);
/// Throws Error for a score that is not finite, or what is no derivation of the graph.
Individual read_individual(StateReader& reader, const GeneratorGraph& graph);
/// The same, and for what is not finished or beyond the limits.
Individual read_finished_individual(StateReader& reader, const GeneratorGraph& graph, const GeneLimits& genes);

}  // namespace espalier
