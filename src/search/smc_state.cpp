// Saving and loading sequential Monte Carlo.
#include <cmath>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "search/engine_state.h"
#include "search/smc.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a43'4d53'5053'45ull;  // the bytes "ESPSMC\n"
constexpr std::uint64_t kStateVersion = 2;

struct Entry {
  const char* name;
  std::uint64_t SmcCounts::*member;
};
constexpr Entry kEntries[] = {
    {"sweeps", &SmcCounts::sweeps},
    {"failed sweeps", &SmcCounts::failed_sweeps},
    {"resamplings", &SmcCounts::resamplings},
    {"finished particles", &SmcCounts::finished_particles},
    {"closed particles", &SmcCounts::closed_particles},
    {"stuck particles", &SmcCounts::stuck_particles},
    {"oversized particles", &SmcCounts::oversized_particles},
    {"undersized particles", &SmcCounts::undersized_particles},
    {"rejected particles", &SmcCounts::rejected_particles},
    {"rejected starts", &SmcCounts::rejected_starts},
};

}  // namespace

std::vector<NamedCount> SmcEngine::diagnostics() const {
  std::vector<NamedCount> all;
  for (const Entry& entry : kEntries) all.push_back({entry.name, counts_.*entry.member});
  return all;
}

std::vector<NamedGauge> SmcEngine::gauges() const {
  return {{"effective particles", effective_ > 0 ? effective_ : kNothingToTell},
          {"living particles", steps_ > 0 ? static_cast<double>(living_) : kNothingToTell},
          {"log evidence", last_log_evidence_},
          {"distinct", share_distinct(std::span(particles_).first(living_))}};
}

void SmcEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("smc", problem_, to_text(settings_)));
  for (const std::uint64_t value : {steps_, evaluations_, sweep_step_, std::uint64_t{particle_count_}})
    writer.u64(value);
  for (const double value : {log_evidence_, log_mean_, effective_, last_log_evidence_}) writer.f64(value);
  for (const Entry& entry : kEntries) writer.u64(counts_.*entry.member);
  writer.u64(living_);
  if (steps_ == 0) return;
  write_individual(writer, best_);
  for (std::size_t i = 0; i < living_; ++i) {
    writer.f64(log_weights_[i]);
    write_individual(writer, particles_[i]);
  }
}

void SmcEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, fingerprint("smc", problem_, to_text(settings_)));
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64(), sweep_step = reader.u64();
  const std::uint64_t particles = reader.u64_at_most(settings_.most_particles, "particles");
  if (particles < settings_.particles) {
    throw Error(fmt::format("saved state: particles must be at least {}, got {}", settings_.particles, particles));
  }
  const double log_evidence = reader.f64(), log_mean = reader.f64(), effective = reader.f64();
  const double last_log_evidence = reader.f64();
  if (std::isinf(last_log_evidence)) throw Error("saved state: the log evidence of a sweep must not be infinite");
  SmcCounts counts;
  for (const Entry& entry : kEntries) counts.*entry.member = reader.u64();
  const std::uint64_t most_living = sweep_step > 0 ? particles : settings_.most_particles;
  const std::uint64_t living = reader.u64_at_most(most_living, "living particles");
  Individual best;
  std::vector<Individual> individuals;
  std::vector<double> log_weights;
  if (steps > 0) best = read_finished_individual(reader, *problem_.graph, settings_.genes);
  for (std::uint64_t i = 0; steps > 0 && i < living; ++i) {
    log_weights.push_back(reader.f64());
    if (!std::isfinite(log_weights.back())) throw Error("saved state: a log weight must be finite");
    individuals.push_back(read_individual(reader, *problem_.graph));
  }

  steps_ = steps, evaluations_ = evaluations, sweep_step_ = sweep_step;
  particle_count_ = static_cast<std::uint32_t>(particles);
  log_evidence_ = log_evidence, log_mean_ = log_mean, effective_ = effective;
  last_log_evidence_ = last_log_evidence;
  counts_ = counts;
  best_ = std::move(best);
  living_ = individuals.size();
  particles_ = std::move(individuals);
  log_weights_ = std::move(log_weights);
  if (sweep_step_ == 0) return;
  // The dead of a sweep that goes on are nameless: only their number matters.
  particles_.resize(particle_count_);
  log_weights_.resize(particle_count_);
  for (std::size_t i = living_; i < particles_.size(); ++i) bury(i);
}

}  // namespace espalier
