// How the genetic algorithm begins a population, and begins it anew.
#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/sample.h"
#include "search/ga.h"

namespace espalier {
namespace {

// Attempts per individual, over all rounds; each has a stream of its own.
constexpr std::uint32_t kMostStarts = 100;
static_assert(GaEngine::kMostStartRounds <= kMostStarts);
// Rounds with the lengths that are asked for. If models of these are not acceptable, shorter or longer ones may be.
constexpr std::uint32_t kRoundsAsAsked = 10;

}  // namespace

void GaEngine::make_initial_population() {
  start_rounds_ = 1;
  starts_.assign(settings_.population, 0);
  for (std::uint32_t i = 0; i < settings_.population; ++i) {
    if (make_start(i, newcomers_[i].derivation)) continue;
    throw Error(fmt::format("grammar {} grew no derivation of {} to {} genes in {} attempts (limits.genes)",
                            problem_.graph->name, settings_.genes.min, settings_.genes.max, kMostStarts));
  }
  if (champions_.size() < kReunion) return;
  for (std::size_t i = 0; i < champions_.size() && i < newcomers_.size(); ++i) {
    newcomers_[i] = champions_[i];
    scored_[i] = 1;
  }
  champions_.clear();
}

bool GaEngine::make_start(std::uint32_t index, Derivation& start) {
  const bool as_asked = start_rounds_ <= kRoundsAsAsked;
  const std::uint32_t shortest = as_asked ? settings_.initial_length_min : 1;
  const std::uint32_t longest = settings_.initial_length_max * (as_asked ? 1 : 2);
  const std::uint32_t low = std::max(shortest, settings_.genes.min), high = std::min(longest, settings_.genes.max);
  while (starts_[index] < kMostStarts) {
    const std::uint32_t attempt = starts_[index]++;
    RandomStream random({problem_.seed, Purpose::initial, problem_.lane, index, epoch_ * kMostStarts + attempt});
    const std::uint32_t length = low + random.below(high - low + 1);
    start = seedling(*problem_.graph, random);
    close_open_slots(*problem_.graph, start, random);
    while (start.size() < length && grow(*problem_.graph, start, problem_.locks, random)) {}
    // Required slots bring several genes at once, so the limits may be overshot.
    if (start.size() < settings_.genes.min || start.size() > settings_.genes.max) continue;
    counts_.short_starts += start.size() < length;
    return true;
  }
  return false;
}

void GaEngine::redraw_starts() {
  counts_.rejected_starts += rejected_.size();
  bool redrawn = start_rounds_ < kMostStartRounds;
  ++start_rounds_;
  for (std::size_t i = 0; i < rejected_.size() && redrawn; ++i) {
    const std::size_t place = rejected_[i];
    redrawn = make_start(static_cast<std::uint32_t>(place), newcomers_[place].derivation);
  }
  if (!redrawn) copy_starts();
}

// Copies are taken in turn from what is acceptable: of this population, or if that is nothing, of the ones before.
void GaEngine::copy_starts() {
  std::vector<const Individual*> givers;
  for (std::size_t i = 0; i < newcomers_.size(); ++i) {
    if (scored_[i]) givers.push_back(&newcomers_[i]);
  }
  if (givers.empty()) {
    for (const Individual& champion : champions_) givers.push_back(&champion);
  }
  if (givers.empty()) {
    throw Error(fmt::format("none of {} models grown from grammar {} is acceptable: {}", evaluations_,
                            problem_.graph->name, problem_.scorer->describe_rejections()));
  }
  for (std::size_t i = 0; i < rejected_.size(); ++i) {
    newcomers_[rejected_[i]] = *givers[i % givers.size()];
    scored_[rejected_[i]] = 1;
    ++counts_.copied_starts;
  }
}

bool GaEngine::restart_is_due() const { return settings_.restart_after > 0 && stalled_ >= settings_.restart_after; }

void GaEngine::restart() {
  champions_.push_back(population_.front());
  ++epoch_;
  ++counts_.restarts;
}

}  // namespace espalier
