// Saving and loading the genetic algorithm.
#include <cmath>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/ga.h"
#include "search/state_stream.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a41'4750'5345ull;  // the bytes "ESPGA\n"
constexpr std::uint64_t kStateVersion = 4;

// Everything that must be equal for a continued search to be the same search.
std::string fingerprint(const SearchProblem& problem, const GaSettings& s) {
  return fmt::format("ga {} seed {} lane {} P {} E {} L {}..{} mutation {} {} {} {} select {} {} {} cross {} {} {} "
                     "genes {}..{} reuse {} nudge {} unique {} join {} restart {} locks {}",
                     problem.graph->source_hash, problem.seed, problem.lane, s.population, s.elitism,
                     s.initial_length_min, s.initial_length_max, s.mutation, s.grow, s.cut, s.alter, name_of(s.first),
                     name_of(s.second), s.tournament_size, static_cast<int>(s.crossover), s.retries,
                     s.replace_probability, s.genes.min, s.genes.max, s.reuse_scores,
                     s.nudge, s.unique, s.join, s.restart_after, problem.locks.size());
}

void write(StateWriter& writer, const Individual& individual) {
  writer.f64(individual.score);
  writer.derivation(individual.derivation);
}

Individual read(StateReader& reader, const GeneratorGraph& graph) {
  Individual individual;
  individual.score = reader.f64();
  if (!std::isfinite(individual.score)) throw Error("saved state: a score must be finite");
  individual.derivation = reader.derivation();
  if (const std::string fault = find_fault(graph, individual.derivation); !fault.empty()) {
    throw Error("saved state: a derivation does not fit the grammar: " + fault);
  }
  return individual;
}

}  // namespace

void GaEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  writer.u64(kMagic);
  writer.u64(kStateVersion);
  writer.text(fingerprint(problem_, settings_));
  writer.u64(steps_);
  writer.u64(evaluations_);
  const std::vector<NamedCount> counts = named(counts_);
  for (const NamedCount& count : counts) writer.u64(count.value);
  writer.u64(epoch_);
  writer.u64(stalled_);
  writer.u64(champions_.size());
  for (const Individual& champion : champions_) write(writer, champion);
  writer.u64(population_.size());
  if (!population_.empty()) write(writer, best_);
  for (const Individual& individual : population_) write(writer, individual);
}

void GaEngine::load(std::istream& in) {
  StateReader reader(in);
  if (reader.u64() != kMagic) throw Error("saved state: this is no saved state of a search");
  if (const std::uint64_t version = reader.u64(); version != kStateVersion) {
    throw Error(fmt::format("saved state: version must be {}, got {}", kStateVersion, version));
  }
  const std::string expected = fingerprint(problem_, settings_);
  if (const std::string got = reader.text(); got != expected) {
    throw Error(fmt::format("saved state: it belongs to another search\n  saved: {}\n  this:  {}", got, expected));
  }
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64();
  std::vector<std::uint64_t> counts(named(counts_).size());
  for (std::uint64_t& count : counts) count = reader.u64();
  const std::uint64_t epoch = reader.u64(), stalled = reader.u64(), champion_count = reader.u64();
  if (champion_count > kReunion) {
    throw Error(fmt::format("saved state: champions must be at most {}, got {}", kReunion, champion_count));
  }
  std::vector<Individual> champions;
  for (std::uint64_t i = 0; i < champion_count; ++i) champions.push_back(read(reader, *problem_.graph));
  const std::uint64_t size = reader.u64();
  if (size != (steps > 0 ? settings_.population : 0)) {
    throw Error(fmt::format("saved state: population must be {}, got {}", steps > 0 ? settings_.population : 0, size));
  }
  Individual best;
  if (size > 0) best = read(reader, *problem_.graph);
  std::vector<Individual> population;
  for (std::uint64_t i = 0; i < size; ++i) population.push_back(read(reader, *problem_.graph));

  steps_ = steps;
  epoch_ = static_cast<std::uint32_t>(epoch);
  stalled_ = stalled;
  champions_ = std::move(champions);
  evaluations_ = evaluations;
  counts_ = counts_from(counts);
  best_ = std::move(best);
  population_ = std::move(population);
}

}  // namespace espalier
