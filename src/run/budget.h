#pragma once
// Why a search ends.

#include <string>

#include "run/progress.h"

namespace espalier {

/// Steps in a row in which nothing was scored, after which a search ends: everything is locked, or nothing new is left.
inline constexpr std::uint64_t kMostIdleSteps = 1000;

/// Steps that have random streams of their own (base/random.h): a day and more of the fastest engine.
inline constexpr std::uint64_t kMostSteps = 0xffff'ffff;

/// "generations", "evaluations", "seconds", or "nothing left to try", or "steps" after kMostSteps; empty: it
/// goes on.
inline std::string budget_spent(const SceneBudget& budget, const StepReport& report) {
  if (budget.generations && report.step >= *budget.generations) return "generations";
  if (budget.evaluations && report.evaluations >= *budget.evaluations) return "evaluations";
  if (budget.seconds && report.seconds >= *budget.seconds) return "seconds";
  if (report.step >= kMostSteps) return "steps";
  return report.idle >= kMostIdleSteps ? "nothing left to try" : "";
}

}  // namespace espalier
