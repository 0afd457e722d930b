// Saving and loading the genetic algorithm.
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "search/engine_state.h"
#include "search/ga.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a41'4750'5345ull;  // the bytes "ESPGA\n"
constexpr std::uint64_t kStateVersion = 6;

}  // namespace

void GaEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("ga", problem_, to_text(settings_)));
  writer.u64(steps_);
  writer.u64(evaluations_);
  const std::vector<NamedCount> counts = named(counts_);
  for (const NamedCount& count : counts) writer.u64(count.value);
  gains_.save(writer);
  writer.u64(epoch_);
  writer.u64(stalled_);
  writer.u64(champions_.size());
  for (const Individual& champion : champions_) write_individual(writer, champion);
  writer.u64(population_.size());
  if (!population_.empty()) write_individual(writer, best_);
  for (const Individual& individual : population_) write_individual(writer, individual);
}

void GaEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, fingerprint("ga", problem_, to_text(settings_)));
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64();
  std::vector<std::uint64_t> counts(named(counts_).size());
  for (std::uint64_t& count : counts) count = reader.u64();
  GaGains gains = GaGains::load(reader);
  const std::uint64_t epoch = reader.u64(), stalled = reader.u64(), champion_count = reader.u64();
  if (champion_count > kReunion) {
    throw Error(fmt::format("saved state: champions must be at most {}, got {}", kReunion, champion_count));
  }
  std::vector<Individual> champions;
  const auto read_one = [&] { return read_finished_individual(reader, *problem_.graph, settings_.genes); };
  for (std::uint64_t i = 0; i < champion_count; ++i) champions.push_back(read_one());
  const std::uint64_t size = reader.u64();
  if (size != (steps > 0 ? settings_.population : 0)) {
    throw Error(fmt::format("saved state: population must be {}, got {}", steps > 0 ? settings_.population : 0, size));
  }
  Individual best;
  if (size > 0) best = read_one();
  std::vector<Individual> population;
  for (std::uint64_t i = 0; i < size; ++i) population.push_back(read_one());

  steps_ = steps;
  epoch_ = static_cast<std::uint32_t>(epoch);
  stalled_ = stalled;
  champions_ = std::move(champions);
  evaluations_ = evaluations;
  counts_ = counts_from(counts);
  gains_ = std::move(gains);
  best_ = std::move(best);
  population_ = std::move(population);
}

}  // namespace espalier
