// Saving and loading Genesis.
#include <cmath>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "search/engine_state.h"
#include "search/genesis.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a4e'4547'5345ull;  // the bytes "ESGEN\n"
constexpr std::uint64_t kStateVersion = 1;
constexpr GeneLimits kOneGene = {1, 1};

}  // namespace

void GenesisEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("genesis", problem_, to_text(settings_)));
  writer.u64(steps_);
  writer.u64(evaluations_);
  for (const NamedCount& count : diagnostics()) writer.u64(count.value);
  writer.u64(idle_);
  writer.u64(window_.remembered().size());
  for (const double worst : window_.remembered()) writer.f64(worst);
  writer.u64(population_.size());
  if (!population_.empty()) write_individual(writer, best_);
  for (const Individual& individual : population_) write_individual(writer, individual);
}

void GenesisEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, fingerprint("genesis", problem_, to_text(settings_)));
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64();
  GenesisCounts counts;
  for (std::uint64_t* count : {&counts.crossed, &counts.mutated, &counts.copied, &counts.rejected,
                               &counts.rejected_starts, &counts.populations}) {
    *count = reader.u64();
  }
  const std::uint64_t idle = reader.u64_at_most(settings_.idle, "idle generations");
  const std::uint64_t remembered = reader.u64_at_most(std::uint64_t{settings_.window} + 1, "scaling window");
  if ((remembered > 0) != (steps > 0)) throw Error("saved state: the scaling window does not fit the steps");
  ScalingWindow window(settings_.window);
  for (std::uint64_t i = 0; i < remembered; ++i) {
    const double worst = reader.f64();
    if (!std::isfinite(worst)) throw Error(fmt::format("saved state: scores must be finite, got {}", worst));
    window.add(worst);
  }
  const std::uint64_t size = reader.u64(), expected = steps > 0 ? settings_.population : 0;
  if (size != expected) throw Error(fmt::format("saved state: population must be {}, got {}", expected, size));
  const auto read_one = [&] { return read_finished_individual(reader, *problem_.graph, kOneGene); };
  Individual best;
  if (size > 0) best = read_one();
  std::vector<Individual> population;
  for (std::uint64_t i = 0; i < size; ++i) population.push_back(read_one());
  // The window reaches back to before these, and none of them is below it.
  for (const Individual& one : population) {
    if (one.score < window.worst()) throw Error("saved state: a score is below the scaling window");
  }

  steps_ = steps;
  evaluations_ = evaluations;
  counts_ = counts;
  idle_ = static_cast<std::uint32_t>(idle);
  window_ = std::move(window);
  best_ = std::move(best);
  population_ = std::move(population);
}

}  // namespace espalier
