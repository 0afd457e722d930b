#pragma once
// A contest's searches. For every seed all variants search at once and take turns of a slice of their own time, so that
// a machine that becomes slower or faster does so for all of them. Each stops when its own budget is spent, by its own
// stopwatch, so what they find in a number of steps does not depend on who else takes part.

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/executor.h"
#include "run/contest_plan.h"
#include "run/search_session.h"

namespace espalier {

/// What one search came to.
struct ContestOutcome {
  std::size_t variant = 0;
  std::uint64_t seed = 0;
  Rises rises;
  std::vector<StepReport> steps;  // of its log
  Individual best;
  std::size_t genes = 0;   // of the best
  std::string derivation;  // hash of the best's
  /// Of the best of the steps that ended within the budget; none: the first step did not, or there was none.
  std::optional<double> score;
  std::uint64_t step_count = 0, evaluations = 0;
  double seconds = 0;
  std::string stopped_by;  // "seconds", "evaluations", "generations"; "interrupt": before its budget was spent
  std::string problem;     // why it came to nothing; empty: it did not

  /// Its budget was spent.
  bool complete() const { return problem.empty() && stopped_by != "interrupt"; }
};

/// What is told while a contest goes on.
struct ContestTurn {
  std::size_t variant = 0;
  std::uint64_t seed = 0;
  StepReport report;     // of the last step of the turn
  double share = 0;      // of all that there is to do
};

class ContestWatcher {
 public:
  virtual ~ContestWatcher() = default;
  virtual void turn(const ContestTurn&) {}
  virtual void ended(const ContestOutcome&) {}
  virtual void warning(const std::string&) {}
};

/// The variants, made ready. As many as search at once are kept; more are made anew when their turn comes.
class ContestSetups {
 public:
  static constexpr std::size_t kMostKept = 8;

  /// Both must outlive it.
  ContestSetups(const Contest& contest, MeshSource& source) : contest_(contest), source_(source) {}

  /// All stand before the same targets: a camera that fits itself does so for the first variant. Throws Error.
  Setup& of(std::size_t variant);
  /// Lets go of what more variants than can be kept would fill memory with.
  void rest();
  /// The first that can be made ready: grammar, optimum and warnings are its; whether targets can be reached is looked
  /// into once. Throws Error where none can be, with what is wrong with the first.
  Setup& first();

 private:
  Setup& make(std::size_t variant);

  const Contest& contest_;
  MeshSource& source_;
  std::vector<std::unique_ptr<Setup>> setups_;
  std::optional<std::size_t> first_;
  std::vector<SceneSilhouette> settled_;  // of the first
};

struct ContestControl {
  double slice_seconds = 0.25;               // of a turn
  const std::atomic<bool>* stop = nullptr;   // set from outside: end with what is there
  ContestWatcher* watcher = nullptr;
};

/// Hands each outcome to `take`, in the order of seeds and then of variants within those that search at once. False:
/// it was stopped. A search that fails becomes an outcome with a problem, and costs no other. Throws Error, the first
/// of the problems, naming the variant, where it went to its end and every search failed.
bool run_contest(const Contest& contest, ContestSetups& setups, Executor& executor, const ContestControl& control,
                 const std::function<void(ContestOutcome)>& take);

/// How many of those that were begun failed.
std::size_t failed_of(std::span<const std::optional<ContestOutcome>> searches);
/// "small: 2 of 3 searches came to nothing; seed 4: WHY", of the first that failed. Empty: none did.
std::string failures_in_words(const std::string& name, std::span<const std::optional<ContestOutcome>> searches);

/// A line for every variant whose targets or limits differ from the first's: their scores do not compare.
std::vector<std::string> warn_of_other_scores(const Contest& contest);

}  // namespace espalier
