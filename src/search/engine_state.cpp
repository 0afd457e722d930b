#include "search/engine_state.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/printable.h"
#include "derivation/encode.h"
#include "derivation/sample.h"

namespace espalier {

std::string fingerprint(std::string_view engine, const SearchProblem& problem, const std::string& settings) {
  std::string locks;
  for (const Lock& lock : problem.locks) {
    locks += fmt::format(" {}{}", static_cast<int>(lock.scope), format_gene_path(*problem.graph, lock.path));
  }
  // A hash for all of them: there may be thousands.
  std::uint64_t founders = 0;
  for (const Individual& founder : problem.founders) {
    founders = key_below(key_below(founders, hash(founder.derivation)), std::bit_cast<std::uint64_t>(founder.score));
  }
  return fmt::format("{} {} seed {} lane {} optimum {} locks{} founders {} {:x} {}", engine,
                     problem.graph->source_hash, problem.seed, problem.lane, problem.scorer->optimum(), locks,
                     problem.founders.size(), founders, settings);
}

void write_head(StateWriter& writer, std::uint64_t magic, std::uint64_t version, const std::string& fingerprint) {
  writer.u64(magic);
  writer.u64(version);
  writer.text(fingerprint);
}

void read_head(StateReader& reader, std::uint64_t magic, std::uint64_t version, const std::string& fingerprint) {
  if (reader.u64() != magic) throw Error("saved state: this is no saved state of a search by this engine");
  if (const std::uint64_t got = reader.u64(); got != version) {
    throw Error(fmt::format("saved state: version must be {}, got {}", version, got));
  }
  if (const std::string got = reader.text(); got != fingerprint) {
    throw Error(fmt::format("saved state: it belongs to another search\n  saved: {}\n  this:  {}", printable(got),
                            fingerprint));
  }
}

void write_individual(StateWriter& writer, const Individual& individual) {
  writer.f64(individual.score);
  writer.derivation(individual.derivation);
}

Individual read_individual(StateReader& reader, const GeneratorGraph& graph) {
  Individual individual;
  individual.score = reader.f64();
  if (!std::isfinite(individual.score)) throw Error("saved state: a score must be finite");
  individual.derivation = reader.derivation();
  if (const std::string fault = find_fault(graph, individual.derivation); !fault.empty()) {
    throw Error("saved state: a derivation does not fit the grammar: " + fault);
  }
  return individual;
}

Individual read_finished_individual(StateReader& reader, const GeneratorGraph& graph, const GeneLimits& genes) {
  Individual individual = read_individual(reader, graph);
  const std::size_t size = individual.derivation.size();
  if (!is_finished(individual.derivation)) throw Error("saved state: a derivation must have no open slots");
  if (size < genes.min || size > genes.max) {
    throw Error(fmt::format("saved state: genes must be between {} and {}, got {}", genes.min, genes.max, size));
  }
  return individual;
}

}  // namespace espalier
