// How the genetic algorithm begins a population, and begins it anew.
#include "search/ga.h"

namespace espalier {

void GaEngine::begin_population() {
  if (steps_ > 0) {
    champions_.push_back(population_.front());
    ++epoch_;
    ++counts_.restarts;
  }
  const bool reunion = champions_.size() >= kReunion;
  const StartSettings settings = {settings_.population, settings_.initial_length_min, settings_.initial_length_max,
                                  settings_.genes};
  const std::span<const Individual> champions = champions_;
  std::span<const Individual> founders = champions.first(reunion ? champions.size() : 0);
  if (steps_ == 0) founders = problem_.founders;
  StartResult made = make_initial_population(problem_, settings, epoch_, founders, champions);
  newcomers_ = std::move(made.individuals);
  evaluations_ += made.evaluations;
  counts_.short_starts += made.short_starts;
  counts_.rejected_starts += made.rejected_starts;
  counts_.copied_starts += made.copied_starts;
  if (reunion) champions_.clear();
}

bool GaEngine::restart_is_due() const { return settings_.restart_after > 0 && stalled_ >= settings_.restart_after; }

}  // namespace espalier
