#pragma once
// The search loop: steps an engine until its budget is spent. The clock only decides whether another step is taken, so
// what a number of steps finds depends on the setup alone.

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "base/executor.h"
#include "run/progress.h"
#include "run/search_session.h"

namespace espalier {

/// Is told of every step, with what was found; on the search's own thread, so it must be quick.
class SearchWatcher {
 public:
  virtual ~SearchWatcher() = default;
  virtual void stepped(const StepReport& report, const Individual& best) = 0;
};

/// Is shown the search itself, on its own thread: to keep what it needs to go on later.
class SearchKeeper {
 public:
  virtual ~SearchKeeper() = default;
  virtual void stepped(const SearchSession& session) = 0;
  /// After the last step, before the session finishes.
  virtual void ending(const SearchSession& session) = 0;
};

struct SearchControl {
  SceneBudget budget;
  std::optional<std::uint64_t> exact_steps;  // take precisely these, whatever the budget: to reproduce
  const std::atomic<bool>* stop = nullptr;   // set from outside: end after the step that runs
  RunObserver* observer = nullptr;
  SearchWatcher* watcher = nullptr;
  SearchKeeper* keeper = nullptr;
};

/// Goes on with `session` from wherever it is: not a step more where the budget is spent already. Otherwise as below.
std::optional<SearchResult> run_search(SearchSession& session, const SearchControl& control);

/// Empty if `stop` was set before the first step ended. Throws Error for a grammar that does not suit the engine.
std::optional<SearchResult> run_search(const Setup& setup, const SearchControl& control, Executor& executor);

}  // namespace espalier
