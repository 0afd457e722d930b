// Saving and loading of the guided engine.
#include <cmath>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/growth_log.h"
#include "search/engine_state.h"
#include "search/gauges.h"
#include "search/guided.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a44'4755'5053'45ull;  // the bytes "ESPUGD\n"
constexpr std::uint64_t kStateVersion = 1;
constexpr std::uint64_t kMostEntries = 10'000'000;  // of one log

struct Entry {
  const char* name;
  std::uint64_t GuidedCounts::*member;
};
constexpr Entry kEntries[] = {
    {"sweeps", &GuidedCounts::sweeps},
    {"rounds", &GuidedCounts::rounds},
    {"rounds that improved", &GuidedCounts::improved},
    {"steps taken back", &GuidedCounts::taken_back},
    {"finished particles", &GuidedCounts::finished_particles},
};

void write_log(StateWriter& writer, const GrowthLog& log) {
  writer.u64(log.detail_seed);
  writer.u64(log.entries.size());
  for (const GrowthLog::Entry& e : log.entries) {
    writer.u64(std::uint64_t{e.above} << 32 | std::uint64_t{e.slot} << 1 | e.filled);
    if (e.filled) writer.u64(std::uint64_t{e.edge} << 16 | e.variant);
  }
  writer.u64(log.draws.size());
  for (const std::uint32_t draw : log.draws) writer.u64(draw);
  writer.u64(log.open.size());
  for (const GrowthLog::Place& place : log.open) writer.u64(std::uint64_t{place.entry} << 16 | place.slot);
}

GrowthLog read_log(StateReader& reader, const GeneratorGraph& graph) {
  GrowthLog log;
  log.detail_seed = reader.u64();
  for (std::uint64_t i = reader.u64_at_most(kMostEntries, "shoots"); i > 0; --i) {
    GrowthLog::Entry& e = log.entries.emplace_back();
    const std::uint64_t place = reader.u64();
    e.above = static_cast<std::uint32_t>(place >> 32);
    e.slot = static_cast<std::uint16_t>(place >> 1);
    e.filled = place & 1;
    if (!e.filled) continue;
    const std::uint64_t gene = reader.u64();
    if (gene >> 16 >= graph.edges.size()) throw Error("saved state: a gene must be of an edge of the grammar");
    e.edge = static_cast<EdgeId>(gene >> 16);
    e.variant = static_cast<std::uint16_t>(gene);
  }
  for (std::uint64_t i = reader.u64_at_most(kMostEntries, "draws"); i > 0; --i) {
    log.draws.push_back(static_cast<std::uint32_t>(reader.u64_at_most(0xffffffff, "a draw")));
  }
  for (std::uint64_t i = reader.u64_at_most(kMostEntries, "open slots"); i > 0; --i) {
    const std::uint64_t place = reader.u64();
    log.open.push_back({static_cast<std::uint32_t>(place >> 16), static_cast<std::uint16_t>(place)});
  }
  return log;
}

double read_finite(StateReader& reader, const char* what) {
  const double value = reader.f64();
  if (!std::isfinite(value)) throw Error(fmt::format("saved state: {} must be finite", what));
  return value;
}

}  // namespace

std::vector<NamedCount> GuidedEngine::diagnostics() const {
  std::vector<NamedCount> all;
  for (const Entry& entry : kEntries) all.push_back({entry.name, counts_.*entry.member});
  return all;
}

std::vector<NamedGauge> GuidedEngine::gauges() const {
  return {{"effective particles", effective_ > 0 ? effective_ : kNothingToTell},
          {"steps of the round", steps_ > 0 ? static_cast<double>(sweep_length_) : kNothingToTell},
          {"rounds that improve", share_of(counts_.improved, counts_.rounds)}};
}

void GuidedEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("guided", problem_, to_text(settings_)));
  for (const std::uint64_t value : {steps_, evaluations_, std::uint64_t{over_}, std::uint64_t{seeded_}, sweep_step_,
                                    sweep_length_, std::uint64_t{pinned_}, std::uint64_t{best_pooled_}})
    writer.u64(value);
  for (const double value : {effective_, mean_score_, round_began_with_, log_mean_, log_evidence_}) writer.f64(value);
  for (const Entry& entry : kEntries) writer.u64(counts_.*entry.member);
  if (steps_ == 0) return;
  write_individual(writer, best());
  if (best_pooled_) write_log(writer, log_of(pool_, best_));
  writer.u64(population_.size());
  for (const Individual& one : population_) write_individual(writer, one);
  if (over_) return;  // its particles are of no more use
  writer.u64(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    write_log(writer, log_of(pool_, particles_[i]));
    writer.f64(accounts_[i].score);
    writer.f64(accounts_[i].promise);
    writer.f64(log_weights_[i]);
  }
}

void GuidedEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, fingerprint("guided", problem_, to_text(settings_)));
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64();
  const bool over = reader.u64_at_most(1, "whether a sweep is over"), seeded = reader.u64_at_most(1, "its kind");
  const std::uint64_t sweep_step = reader.u64(), sweep_length = reader.u64();
  const auto pinned = static_cast<std::uint32_t>(reader.u64_at_most(kMostEntries, "pinned shoots"));
  const bool pooled = reader.u64_at_most(1, "where the best is");
  const double effective = reader.f64(), mean = reader.f64(), began = reader.f64(), log_mean = reader.f64();
  const double log_evidence = reader.f64();
  GuidedCounts counts;
  for (const Entry& entry : kEntries) counts.*entry.member = reader.u64();
  const GeneratorGraph& graph = *problem_.graph;
  Individual best;
  std::vector<Individual> population;
  GrowthLog best_log;
  std::vector<GrowthLog> logs;
  std::vector<Account> accounts;
  std::vector<double> log_weights;
  if (steps > 0) {
    best = read_individual(reader, graph);
    if (pooled) best_log = read_log(reader, graph);
    for (std::uint64_t i = reader.u64_at_most(1'000'000, "population"); i > 0; --i)
      population.push_back(read_individual(reader, graph));
  }
  if (steps > 0 && !over) {
    const std::uint64_t most = std::max(settings_.particles, settings_.regrow_particles);
    for (std::uint64_t i = reader.u64_at_most(most, "particles"); i > 0; --i) {
      logs.push_back(read_log(reader, graph));
      const double score = read_finite(reader, "a score");
      accounts.push_back({score, read_finite(reader, "a promise")});
      log_weights.push_back(reader.f64());
      if (std::isnan(log_weights.back()) || log_weights.back() > 1e300)
        throw Error("saved state: a log weight must be below infinity");
    }
  }

  // Shoots that particles shared are copied for each: only memory knows. A pool of its own, should one be no growth.
  GrowthPool pool(graph);
  std::vector<GrowingDerivation> particles;
  for (const GrowthLog& log : logs) particles.push_back(restore(graph, log, pool));
  GrowingDerivation pooled_best;
  if (pooled) {
    pooled_best = restore(graph, best_log, pool);
    if (pool.pack(pooled_best) != best.derivation) throw Error("saved state: the best must have grown as it says");
  }
  pool_.swap(pool);
  particles_ = std::move(particles);
  best_ = std::move(pooled_best);
  scorer_->begin(particles_.size() + 1);
  for (std::size_t i = 0; i < particles_.size(); ++i) run_genes(i, particles_[i]);
  if (pooled) run_genes(particles_.size(), best_);
  ancestors_.resize(std::max<std::size_t>(particles_.size(), 1));
  for (std::size_t i = 0; i < ancestors_.size(); ++i) ancestors_[i] = static_cast<std::uint32_t>(i);
  scorer_->follow(ancestors_);
  steps_ = steps, evaluations_ = evaluations, over_ = over, seeded_ = seeded;
  sweep_step_ = sweep_step, sweep_length_ = sweep_length, pinned_ = pinned;
  effective_ = effective, mean_score_ = mean, round_began_with_ = began;
  log_mean_ = log_mean, log_evidence_ = log_evidence;
  counts_ = counts;
  has_best_ = best_packed_ = steps > 0;
  best_pooled_ = pooled;
  best_score_ = best.score;
  best_individual_ = std::move(best);
  population_ = std::move(population);
  accounts_ = std::move(accounts);
  log_weights_ = std::move(log_weights);
  tidy_at_ = 0;
}

}  // namespace espalier
