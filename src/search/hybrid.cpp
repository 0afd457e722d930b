#include "search/hybrid.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <unordered_set>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/sample.h"
#include "search/engine_state.h"
#include "search/ga.h"
#include "search/gauges.h"
#include "search/require.h"
#include "search/rjmcmc.h"
#include "search/smc.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a59'4850'5345ull;  // the bytes "ESPHY\n"
constexpr std::uint64_t kStateVersion = 2;
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
  require_range("patience", s.patience, std::uint64_t{1}, std::uint64_t{1'000'000'000'000});
  require_range("least_rise", s.least_rise, 0.0, 1.0);
}

HybridEngine::HybridEngine(const SearchProblem& problem, const HybridSettings& settings)
    : problem_(problem), settings_(validated(settings)), founders_(problem.founders) {
  CHECK(problem_.scorer != nullptr);
  CHECK(problem_.lane < (1u << 24) / 3);
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const std::unique_ptr<Engine> engine = make_engine(static_cast<Stage>(i), {});
    counts_[i] = engine->diagnostics();
    silent_[i] = engine->gauges();
    for (NamedGauge& gauge : silent_[i]) gauge.value = kNothingToTell;
  }
  engine_ = make_engine(stage_, founders_);
}

HybridEngine::~HybridEngine() = default;

std::uint32_t HybridEngine::lane_of(Stage stage) const { return problem_.lane * 3 + static_cast<std::uint32_t>(stage); }

std::unique_ptr<Engine> HybridEngine::make_engine(Stage stage, std::vector<Individual> founders) const {
  SearchProblem problem = problem_;
  problem.lane = lane_of(stage);
  problem.founders = std::move(founders);
  switch (stage) {
    case Stage::start: return std::make_unique<SmcEngine>(problem, settings_.start);
    case Stage::middle: return std::make_unique<GaEngine>(problem, settings_.middle);
    case Stage::end: break;
  }
  return std::make_unique<RjmcmcEngine>(problem, settings_.end);
}

const Individual& HybridEngine::best() const {
  CHECK(steps_ > 0);
  return best_;
}

void HybridEngine::step() {
  if (steps_ > 0 && is_over()) hand_over();
  engine_->step();
  if (steps_ == 0 || engine_->best().score > best_.score) best_ = engine_->best();
  const double least = settings_.least_rise * std::abs(problem_.scorer->optimum());
  if (steps_ == 0 || best_.score > risen_to_ + least) {
    risen_to_ = best_.score;
    risen_at_ = evaluations();
  }
  ++steps_;
}

bool HybridEngine::is_over() const {
  if (stage_ == Stage::start) {
    const auto& start = static_cast<const SmcEngine&>(*engine_);
    return start.sweeps() >= settings_.sweeps || start.evaluations() >= settings_.start_evaluations;
  }
  return stage_ == Stage::middle && evaluations() - risen_at_ >= settings_.patience;
}

void HybridEngine::hand_over() {
  const bool to_middle = stage_ == Stage::start;
  founders_ = heirs(to_middle ? settings_.middle.population : settings_.end.chains);
  evaluations_before_ += engine_->evaluations();
  counts_[static_cast<std::size_t>(stage_)] = engine_->diagnostics();
  stage_ = to_middle ? Stage::middle : Stage::end;
  engine_ = make_engine(stage_, founders_);
  risen_at_ = evaluations();
}

/// The best ever and the best of the population, each once, finished and within the limits. Of what is unfinished, a
/// closed copy is scored.
std::vector<Individual> HybridEngine::heirs(std::size_t most) {
  std::vector<Individual> all = {best_};
  std::unordered_set<std::uint64_t> seen = {hash(best_.derivation)};
  std::vector<std::size_t> unscored;
  const std::span<const Individual> population = engine_->population();
  for (std::size_t i = 0; i < population.size() && all.size() < most; ++i) {
    const GeneLimits& genes = settings_.middle.genes;
    Individual heir = population[i];
    const bool finished = is_finished(heir.derivation);
    if (!finished) {
      RandomStream random({problem_.seed, Purpose::close, lane_of(Stage::middle), static_cast<std::uint32_t>(i),
                           static_cast<std::uint32_t>(steps_)});
      if (!close_open_slots(*problem_.graph, heir.derivation, random, genes.max)) continue;
    }
    if (heir.derivation.size() < genes.min || heir.derivation.size() > genes.max) continue;
    if (!seen.insert(hash(heir.derivation)).second) continue;
    if (!finished) unscored.push_back(all.size());
    all.push_back(std::move(heir));
  }
  score(unscored, all);
  std::erase_if(all, [](const Individual& one) { return !std::isfinite(one.score); });
  std::stable_sort(all.begin(), all.end(), [](const Individual& a, const Individual& b) { return a.score > b.score; });
  return all;
}

void HybridEngine::score(const std::vector<std::size_t>& which, std::vector<Individual>& individuals) {
  if (which.empty()) return;
  std::vector<const Derivation*> batch;
  for (const std::size_t i : which) batch.push_back(&individuals[i].derivation);
  std::vector<double> scores(batch.size());
  problem_.scorer->score(batch, scores);
  evaluations_before_ += batch.size();
  for (std::size_t k = 0; k < which.size(); ++k) individuals[which[k]].score = scores[k];
}

std::vector<NamedCount> HybridEngine::diagnostics() const {
  std::vector<NamedCount> all;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const bool running = i == static_cast<std::size_t>(stage_);
    for (const NamedCount& count : running ? engine_->diagnostics() : counts_[i]) {
      all.push_back({fmt::format("{}: {}", kStages[i], count.name), count.value});
    }
  }
  return all;
}

std::vector<NamedGauge> HybridEngine::gauges() const {
  std::vector<NamedGauge> all = {{"stage", static_cast<double>(stage_)}};
  for (std::size_t i = 0; i < silent_.size(); ++i) {
    const bool running = i == static_cast<std::size_t>(stage_);
    for (const NamedGauge& gauge : running ? engine_->gauges() : silent_[i]) {
      all.push_back({fmt::format("{}: {}", kStages[i], gauge.name), gauge.value});
    }
  }
  return all;
}

std::string HybridEngine::own_fingerprint() const {
  return fingerprint("hybrid", problem_,
                     fmt::format("sweeps {} start {} patience {} least {}; {}; {}; {}", settings_.sweeps,
                                 settings_.start_evaluations, settings_.patience, settings_.least_rise,
                                 to_text(settings_.start), to_text(settings_.middle), to_text(settings_.end)));
}

void HybridEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, own_fingerprint());
  writer.u64(static_cast<std::uint64_t>(stage_));
  writer.u64(steps_);
  writer.u64(evaluations_before_);
  writer.f64(risen_to_);
  writer.u64(risen_at_);
  for (const auto& of_stage : counts_) {
    for (const NamedCount& count : of_stage) writer.u64(count.value);
  }
  writer.u64(founders_.size());
  for (const Individual& founder : founders_) write_individual(writer, founder);
  if (steps_ > 0) write_individual(writer, best_);
  engine_->save(out);
}

void HybridEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, own_fingerprint());
  const auto stage = static_cast<Stage>(reader.u64_at_most(2, "stage"));
  const std::uint64_t steps = reader.u64(), before = reader.u64();
  const double risen_to = reader.f64();
  const std::uint64_t risen_at = reader.u64();
  auto counts = counts_;
  for (auto& of_stage : counts) {
    for (NamedCount& count : of_stage) count.value = reader.u64();
  }
  const std::uint64_t size = reader.u64_at_most(1'000'000, "founders");
  std::vector<Individual> founders;
  const auto read_one = [&] { return read_finished_individual(reader, *problem_.graph, settings_.middle.genes); };
  for (std::uint64_t i = 0; i < size; ++i) founders.push_back(read_one());
  Individual best;
  if (steps > 0) best = read_one();
  std::unique_ptr<Engine> engine = make_engine(stage, founders);
  engine->load(in);

  stage_ = stage, steps_ = steps, evaluations_before_ = before, risen_to_ = risen_to, risen_at_ = risen_at;
  counts_ = std::move(counts);
  founders_ = std::move(founders);
  best_ = std::move(best);
  engine_ = std::move(engine);
}

}  // namespace espalier
