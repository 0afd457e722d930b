#include "search/initial_population.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "derivation/strip.h"

namespace espalier {
namespace {

// Attempts per individual, over all rounds; each has a stream of its own.
constexpr std::uint32_t kMostStarts = 100;
static_assert(kMostStartRounds <= kMostStarts);
// Rounds with the lengths that are asked for. If models of these are not acceptable, shorter or longer ones may be.
constexpr std::uint32_t kRoundsAsAsked = 10;

class Maker {
 public:
  Maker(const SearchProblem& problem, const StartSettings& settings, std::uint32_t epoch)
      : problem_(problem), settings_(settings), epoch_(epoch), attempts_(settings.population, 0) {}

  StartResult run(std::span<const Individual> founders, std::span<const Individual> stand_ins);

 private:
  std::optional<Derivation> begin_one(std::size_t place, RandomStream& random) const;
  bool grow_one(std::size_t place);
  void score();
  void copy(std::span<const Individual> stand_ins);

  const SearchProblem& problem_;
  const StartSettings& settings_;
  const std::uint32_t epoch_;
  std::uint32_t round_ = 1;
  std::vector<std::uint32_t> attempts_;  // per place
  std::vector<std::size_t> missing_;     // places without an acceptable individual, ascending
  StartResult made_;
};

/// Nothing where the required slots could not be grown.
std::optional<Derivation> Maker::begin_one(std::size_t place, RandomStream& random) const {
  const GeneratorGraph& graph = *problem_.graph;
  if (!problem_.locks.empty() && !problem_.founders.empty()) {
    return stripped(graph, problem_.founders[place % problem_.founders.size()].derivation, problem_.locks);
  }
  Derivation start = seedling(graph, random);
  if (!close_open_slots(graph, start, random)) return std::nullopt;
  return start;
}

bool Maker::grow_one(std::size_t place) {
  const bool as_asked = round_ <= kRoundsAsAsked;
  const std::uint32_t shortest = as_asked ? settings_.length_min : 1;
  const std::uint32_t longest = settings_.length_max * (as_asked ? 1 : 2);
  const std::uint32_t low = std::max(shortest, settings_.genes.min), high = std::min(longest, settings_.genes.max);
  Derivation& start = made_.individuals[place].derivation;
  while (attempts_[place] < kMostStarts) {
    const std::uint32_t attempt = attempts_[place]++;
    const auto index = static_cast<std::uint32_t>(place);
    RandomStream random({problem_.seed, Purpose::initial, problem_.lane, index, epoch_ * kMostStarts + attempt});
    const std::uint32_t length = low + random.below(high - low + 1);
    std::optional<Derivation> begun = begin_one(place, random);
    if (!begun) continue;
    start = std::move(*begun);
    while (start.size() < length && grow(*problem_.graph, start, problem_.locks, random)) {}
    // Required slots bring several genes at once, so the limits may be overshot.
    if (start.size() < settings_.genes.min || start.size() > settings_.genes.max) continue;
    made_.short_starts += start.size() < length;
    return true;
  }
  return false;
}

void Maker::score() {
  std::vector<const Derivation*> batch;
  for (const std::size_t place : missing_) batch.push_back(&made_.individuals[place].derivation);
  std::vector<double> scores(batch.size());
  if (!batch.empty()) problem_.scorer->score(batch, scores);
  made_.evaluations += batch.size();
  std::vector<std::size_t> rejected;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] == kNotAcceptable) {
      rejected.push_back(missing_[i]);
      continue;
    }
    CHECK(std::isfinite(scores[i]));
    made_.individuals[missing_[i]].score = scores[i];
  }
  missing_ = std::move(rejected);
}

// Copies are taken in turn from what is acceptable: of this population, or if that is nothing, of the stand-ins.
void Maker::copy(std::span<const Individual> stand_ins) {
  std::vector<const Individual*> givers;
  for (std::size_t i = 0, next = 0; i < made_.individuals.size(); ++i) {
    if (next < missing_.size() && missing_[next] == i) ++next;
    else givers.push_back(&made_.individuals[i]);
  }
  if (givers.empty()) {
    for (const Individual& one : stand_ins) givers.push_back(&one);
  }
  if (givers.empty()) {
    throw Error(fmt::format("none of {} models grown from grammar {} is acceptable: {}", made_.evaluations,
                            problem_.graph->name, problem_.scorer->describe_rejections()));
  }
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    made_.individuals[missing_[i]] = *givers[i % givers.size()];
    ++made_.copied_starts;
  }
  missing_.clear();
}

StartResult Maker::run(std::span<const Individual> founders, std::span<const Individual> stand_ins) {
  made_.individuals.resize(settings_.population);
  for (std::size_t i = 0; i < made_.individuals.size(); ++i) {
    if (i < founders.size()) {
      made_.individuals[i] = founders[i];
      continue;
    }
    if (!grow_one(i)) {
      throw Error(fmt::format("grammar {} grew no derivation of {} to {} genes in {} attempts (limits.genes)",
                              problem_.graph->name, settings_.genes.min, settings_.genes.max, kMostStarts));
    }
    missing_.push_back(i);
  }
  score();
  while (!missing_.empty()) {
    made_.rejected_starts += missing_.size();
    bool redrawn = round_ < kMostStartRounds;
    ++round_;
    for (std::size_t i = 0; i < missing_.size() && redrawn; ++i) redrawn = grow_one(missing_[i]);
    if (redrawn) {
      score();
    } else {
      copy(stand_ins);
    }
  }
  return std::move(made_);
}

}  // namespace

StartResult make_initial_population(const SearchProblem& problem, const StartSettings& settings, std::uint32_t epoch,
                                    std::span<const Individual> founders, std::span<const Individual> stand_ins) {
  return Maker(problem, settings, epoch).run(founders, stand_ins);
}

}  // namespace espalier
