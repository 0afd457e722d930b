#include "search/hybrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/sample.h"
#include "search/ga.h"
#include "search/gauges.h"
#include "search/require.h"
#include "search/rjmcmc.h"
#include "search/smc.h"

namespace espalier {
namespace {

constexpr const char* kStages[] = {"sosmc", "ga", "rjmcmc"};

}  // namespace

void validate(const HybridSettings& s) {
  validate(s.start);
  validate(s.middle);
  validate(s.end);
  if (s.start.genes != s.middle.genes || s.end.genes != s.middle.genes) {
    throw Error("the engines of a hybrid must have the same gene limits");
  }
  require_range("sweeps", s.sweeps, 1u, 1000u);
  require_range("start_evaluations", s.start_evaluations, std::uint64_t{1}, std::uint64_t{1'000'000'000'000});
  require_range("turn", s.turn, std::uint64_t{1}, std::uint64_t{1'000'000'000'000});
}

HybridEngine::HybridEngine(const SearchProblem& problem, const HybridSettings& settings)
    : problem_(problem), settings_(validated(settings)), founders_(problem.founders) {
  CHECK(problem_.scorer != nullptr);
  CHECK(problem_.lane < (1u << 24) / (kMostHandovers + 1));
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const std::unique_ptr<Engine> engine = make_engine(static_cast<Stage>(i), {});
    counts_[i] = engine->diagnostics();
    silent_[i] = engine->gauges();
    for (NamedGauge& gauge : silent_[i]) gauge.value = kNothingToTell;
  }
  engine_ = make_engine(course_.stage, founders_);
}

HybridEngine::~HybridEngine() = default;

// Every engine that takes over draws from streams that none before it had.
std::uint32_t HybridEngine::lane() const {
  return static_cast<std::uint32_t>(problem_.lane * (kMostHandovers + 1) + course_.handovers);
}

std::unique_ptr<Engine> HybridEngine::make_engine(Stage stage, std::vector<Individual> founders) const {
  SearchProblem problem = problem_;
  problem.lane = lane();
  problem.founders = std::move(founders);
  switch (stage) {
    case Stage::start: return std::make_unique<SmcEngine>(problem, settings_.start);
    case Stage::middle: return std::make_unique<GaEngine>(problem, settings_.middle);
    case Stage::end: break;
  }
  return std::make_unique<RjmcmcEngine>(problem, settings_.end);
}

const Individual& HybridEngine::best() const {
  CHECK(course_.steps > 0);
  return best_;
}

void HybridEngine::step() {
  if (course_.steps > 0 && turn_is_over()) {
    end_turn();
    begin_turn();
  }
  engine_->step();
  if (course_.steps == 0 || engine_->best().score > best_.score) best_ = engine_->best();
  ++course_.steps;
}

bool HybridEngine::turn_is_over() const {
  if (course_.stage != Stage::start) {
    // Steps too: where all is locked or known, nothing is evaluated.
    return std::max(evaluations() - course_.turn_begun, course_.steps - course_.turn_first_step) >= settings_.turn;
  }
  const auto& start = static_cast<const SmcEngine&>(*engine_);
  return start.sweeps() >= settings_.sweeps || start.evaluations() >= settings_.start_evaluations;
}

void HybridEngine::end_turn() {
  if (course_.afresh && !has_settled()) return;
  const Stage next = course_.afresh ? Stage::middle : next_stage();
  course_.afresh = false;
  if (course_.stalled >= kStalledTurns && course_.handovers < kMostHandovers) return begin_afresh();
  if (next == course_.stage) return;
  hand_over(next, heirs(next == Stage::middle ? settings_.middle.population : settings_.end.chains));
}

/// Whether RJMCMC, begun anew, no longer finds anything better than it has itself.
bool HybridEngine::has_settled() {
  const double best = engine_->best().score;
  course_.settled = best > course_.fresh_best ? 0 : course_.settled + 1;
  course_.fresh_best = best;
  return course_.settled >= kSettledTurns;
}

void HybridEngine::begin_afresh() {
  hand_over(Stage::end, problem_.locks.empty() ? std::vector<Individual>() : problem_.founders);
  course_.afresh = true;
  course_.stalled = course_.settled = 0;
  course_.fresh_best = -std::numeric_limits<double>::infinity();
  ++course_.fresh_starts;
}

/// Who goes on. A gain of long ago is a hope, not a fact: whoever was tried on it and did worse waits twice as long.
HybridEngine::Stage HybridEngine::next_stage() {
  if (course_.stage == Stage::start) return Stage::middle;
  const Stage rival = course_.stage == Stage::middle ? Stage::end : Stage::middle;
  Standing &mine = standing(course_.stage), &other = standing(rival);
  mine.ran = true;
  const std::uint64_t spent = std::max<std::uint64_t>(evaluations() - course_.turn_begun, 1);
  mine.gain = (best_.score - course_.turn_best) / static_cast<double>(spent);
  course_.stalled = mine.gain > 0 ? 0 : course_.stalled + 1;
  if (course_.on_trial) mine.wait = mine.gain < other.gain ? std::min(2 * mine.wait, kLongestWait) : 1;
  ++other.rests;
  if (course_.handovers == kMostHandovers) return course_.stage;
  if (!other.ran) return rival;
  const bool stalled = mine.gain == 0 && other.gain == 0;
  if (mine.gain < other.gain || stalled) return rival;
  return other.rests >= other.wait ? rival : course_.stage;
}

void HybridEngine::begin_turn() {
  course_.turn_best = best_.score;
  course_.turn_begun = evaluations();
  course_.turn_first_step = course_.steps;
}

void HybridEngine::hand_over(Stage to, std::vector<Individual> founders) {
  const std::span<const Individual> population = engine_->population();
  if (course_.stage == Stage::middle) bred_.assign(population.begin(), population.end());
  founders_ = std::move(founders);
  counts_[static_cast<std::size_t>(course_.stage)] = counts_of(course_.stage);
  course_.evaluations_before += engine_->evaluations();
  course_.on_trial = course_.stage != Stage::start && standing(to).gain < standing(course_.stage).gain;
  standing(to).rests = 0;
  ++course_.handovers;
  course_.stage = to;
  engine_ = make_engine(course_.stage, founders_);
}

/// The best ever, the population, and what the genetic algorithm had, each once, finished and within the limits. Of what
/// is unfinished, a closed copy is scored.
std::vector<Individual> HybridEngine::heirs(std::size_t most) {
  std::vector<Individual> all = {best_};
  std::unordered_set<std::uint64_t> seen = {hash(best_.derivation)};
  std::vector<std::size_t> unscored;
  const std::span<const Individual> population = engine_->population();
  for (std::size_t i = 0; i < population.size() + bred_.size() && all.size() < most; ++i) {
    Individual heir = i < population.size() ? population[i] : bred_[i - population.size()];
    const bool finished = is_finished(heir.derivation);
    if (!make_heir(heir, i) || !seen.insert(hash(heir.derivation)).second) continue;
    if (!finished) unscored.push_back(all.size());
    all.push_back(std::move(heir));
  }
  score(unscored, all);
  std::erase_if(all, [](const Individual& one) { return !std::isfinite(one.score); });
  std::stable_sort(all.begin(), all.end(), [](const Individual& a, const Individual& b) { return a.score > b.score; });
  return all;
}

/// Finishes it; false where it cannot be, or is beyond the limits.
bool HybridEngine::make_heir(Individual& heir, std::size_t place) const {
  const GeneLimits& genes = settings_.middle.genes;
  if (!is_finished(heir.derivation)) {
    RandomStream random({problem_.seed, Purpose::close, lane() + 1, static_cast<std::uint32_t>(place),
                         static_cast<std::uint32_t>(course_.steps)});
    if (!close_open_slots(*problem_.graph, heir.derivation, random, genes.max)) return false;
  }
  return heir.derivation.size() >= genes.min && heir.derivation.size() <= genes.max;
}

void HybridEngine::score(const std::vector<std::size_t>& which, std::vector<Individual>& individuals) {
  if (which.empty()) return;
  std::vector<const Derivation*> batch;
  for (const std::size_t i : which) batch.push_back(&individuals[i].derivation);
  std::vector<double> scores(batch.size());
  problem_.scorer->score(batch, scores);
  course_.evaluations_before += batch.size();
  for (std::size_t k = 0; k < which.size(); ++k) individuals[which[k]].score = scores[k];
}

/// Of all its turns.
std::vector<NamedCount> HybridEngine::counts_of(Stage stage) const {
  std::vector<NamedCount> counts = counts_[static_cast<std::size_t>(stage)];
  if (stage != course_.stage) return counts;
  const std::vector<NamedCount> running = engine_->diagnostics();
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i].value += running[i].value;
  return counts;
}

std::vector<NamedCount> HybridEngine::diagnostics() const {
  std::vector<NamedCount> all = {{"handovers", course_.handovers}, {"fresh starts", course_.fresh_starts}};
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    for (const NamedCount& count : counts_of(static_cast<Stage>(i))) {
      all.push_back({fmt::format("{}: {}", kStages[i], count.name), count.value});
    }
  }
  return all;
}

std::vector<NamedGauge> HybridEngine::gauges() const {
  std::vector<NamedGauge> all = {{"stage", static_cast<double>(course_.stage)}};
  for (std::size_t i = 0; i < silent_.size(); ++i) {
    const bool running = i == static_cast<std::size_t>(course_.stage);
    for (const NamedGauge& gauge : running ? engine_->gauges() : silent_[i]) {
      all.push_back({fmt::format("{}: {}", kStages[i], gauge.name), gauge.value});
    }
  }
  return all;
}

}  // namespace espalier
