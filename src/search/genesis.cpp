#include "search/genesis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "search/gauges.h"
#include "search/initial_population.h"
#include "search/require.h"

namespace espalier {
namespace {

void refuse_locks(const SearchProblem& problem) {
  for (const Lock& lock : problem.locks) {
    // The start gene is the only one there is, so its structure stays anyway, and other paths lead nowhere.
    if (!lock.path.empty() || lock.scope == LockScope::structure) continue;
    throw Error(fmt::format("engine genesis: a lock holds all draws of {}, the only gene there is; nothing is left to "
                            "search", problem.graph->rules[problem.graph->start()].name));
  }
}

std::vector<double> scores_of(std::span<const Individual> individuals) {
  std::vector<double> scores;
  for (const Individual& individual : individuals) scores.push_back(individual.score);
  return scores;
}

}  // namespace

GenesisEngine::GenesisEngine(const SearchProblem& problem, const GenesisSettings& settings)
    : problem_(problem),
      settings_(validated(settings)),
      encoding_(*problem_.graph, settings_.bits, settings_.gray),
      window_(settings_.window) {
  CHECK(problem_.scorer != nullptr);
  refuse_locks(problem_);
}

const Individual& GenesisEngine::best() const {
  CHECK(steps_ > 0);
  return best_;
}

void GenesisEngine::step() {
  if (steps_ == 0 || idle_ >= settings_.idle) {
    begin_population();
  } else {
    make_next_generation();
  }
  settle();
  ++steps_;
}

/// Sorts, and remembers the best and the worst.
void GenesisEngine::settle() {
  population_.swap(newcomers_);
  std::stable_sort(population_.begin(), population_.end(),
                   [](const Individual& a, const Individual& b) { return a.score > b.score; });
  window_.add(population_.back().score);
  if (steps_ == 0 || population_.front().score > best_.score) best_ = population_.front();
}

/// Scores these of the newcomers; what is not acceptable has that score.
void GenesisEngine::score_missing(std::span<const std::size_t> places) {
  std::vector<const Derivation*> batch;
  for (const std::size_t place : places) batch.push_back(&newcomers_[place].derivation);
  std::vector<double> scores(batch.size());
  if (!batch.empty()) problem_.scorer->score(batch, scores);
  evaluations_ += batch.size();
  for (std::size_t i = 0; i < places.size(); ++i) newcomers_[places[i]].score = scores[i];
}

void GenesisEngine::begin_population() {
  newcomers_.assign(settings_.population, {});
  const auto epoch = static_cast<std::uint32_t>(counts_.populations++);
  std::size_t taken = 0;
  if (epoch == 0) {
    taken = std::min(problem_.founders.size(), newcomers_.size());
    std::copy_n(problem_.founders.begin(), taken, newcomers_.begin());
  } else if (settings_.elitism) {
    newcomers_[taken++] = population_.front();
  }
  std::vector<std::size_t> missing;
  for (std::size_t i = taken; i < newcomers_.size(); ++i) missing.push_back(i);
  for (std::uint32_t round = 0; round < kMostStartRounds && !missing.empty(); ++round) {
    for (const std::size_t place : missing) {
      RandomStream random({problem_.seed, Purpose::initial, problem_.lane, static_cast<std::uint32_t>(place),
                           epoch * kMostStartRounds + round});
      BitString string(encoding_.length());
      for (std::uint8_t& bit : string) bit = random.next_u32() & 1;
      newcomers_[place].derivation = encoding_.decode(string, problem_.seed);
    }
    score_missing(missing);
    std::erase_if(missing, [&](std::size_t place) { return newcomers_[place].score != kNotAcceptable; });
    counts_.rejected_starts += missing.size();
  }
  if (missing.size() == newcomers_.size()) {
    throw Error(fmt::format("none of {} models drawn from grammar {} is acceptable: {}", evaluations_,
                            problem_.graph->name, problem_.scorer->describe_rejections()));
  }
  // What was redrawn in vain is a copy of what is acceptable.
  std::vector<Individual> good;
  for (const Individual& one : newcomers_) {
    if (one.score != kNotAcceptable) good.push_back(one);
  }
  for (std::size_t i = 0; i < missing.size(); ++i) newcomers_[missing[i]] = good[i % good.size()];
  idle_ = 0;
  window_ = ScalingWindow(settings_.window);
}

void GenesisEngine::make_next_generation() {
  std::vector<BitString> strings;
  for (const Individual& one : population_) strings.push_back(encoding_.encode(one.derivation));
  RandomStream random({problem_.seed, Purpose::vary, problem_.lane, 0, static_cast<std::uint32_t>(steps_)});
  const std::vector<GenesisChild> children =
      next_strings(strings, scores_of(population_), settings_.population, window_.worst(), settings_, {}, random);
  newcomers_.resize(children.size());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const GenesisChild& child = children[i];
    const Individual& parent = population_[child.parent];
    newcomers_[i] = parent;
    if (!child.changed) {
      ++counts_.copied;
      continue;
    }
    newcomers_[i].derivation =
        encoding_.inherit(child.string, parent.derivation, population_[child.partner].derivation);
    changed.push_back(i);
    ++(child.partner == child.parent ? counts_.mutated : counts_.crossed);
  }
  score_missing(changed);
  for (const std::size_t place : changed) {
    if (newcomers_[place].score != kNotAcceptable) continue;
    newcomers_[place] = population_[children[place].parent];
    ++counts_.rejected;
  }
  idle_ = changed.empty() ? idle_ + 1 : 0;
}

std::vector<NamedCount> GenesisEngine::diagnostics() const {
  return {{"crossed", counts_.crossed},   {"mutated", counts_.mutated},
          {"copied", counts_.copied},     {"rejected children", counts_.rejected},
          {"rejected starts", counts_.rejected_starts}, {"populations", counts_.populations}};
}

std::vector<NamedGauge> GenesisEngine::gauges() const {
  std::uint64_t lost = 0;
  if (!population_.empty()) {
    std::vector<std::size_t> ones(encoding_.length());
    for (const Individual& one : population_) {
      const BitString string = encoding_.encode(one.derivation);
      for (std::size_t i = 0; i < string.size(); ++i) ones[i] += string[i];
    }
    for (const std::size_t count : ones) lost += count == 0 || count == population_.size();
  }
  return {{"distinct", share_distinct(population_)},
          {"score deviation", score_deviation(population_)},
          {"alleles lost", population_.empty() ? kNothingToTell : share_of(lost, encoding_.length())}};
}

}  // namespace espalier
