#pragma once
// SearchSession: the search of a scene, step by step: its engine, scorer, archive of alternatives, log and stopwatch.
// What a number of steps finds depends on the setup alone; nothing here looks at budgets.

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "base/executor.h"
#include "run/diversity.h"
#include "run/scene_scorer.h"
#include "run/search_log.h"
#include "run/setup.h"
#include "run/stopwatch.h"
#include "search/engine.h"

namespace espalier {

struct SearchResult {
  Individual best;
  std::vector<Individual> alternatives;  // best first, far from the best and from each other
  double spread = 0;                     // mean distance of any two of the best and these; 0: there is only the best
  Explanation explanation;               // of the best
  SearchLog log;
  std::vector<NamedCount> diagnostics;
  std::vector<Rejections> rejections;    // by hard limit
  std::uint64_t steps = 0, evaluations = 0;
  double seconds = 0;
  std::string stopped_by;
};

class SearchSession {
 public:
  /// Both must outlive it. Throws Error for settings that do not suit.
  SearchSession(const Setup& setup, Executor& executor, StopwatchClock clock = StopwatchClock::wall);
  SearchSession(const SearchSession&) = delete;
  SearchSession& operator=(const SearchSession&) = delete;

  /// One step of the engine; sets the stopwatch going. The first throws Error for a grammar that does not suit.
  const StepReport& step();
  /// Of the last step; all 0 before the first.
  const StepReport& last() const { return last_; }
  /// The stopwatch stands until the next step: another search has its turn.
  void pause() { watch_.pause(); }

  const Setup& setup() const { return setup_; }
  const Engine& engine() const { return *engine_; }
  const SearchLog& log() const { return log_; }
  const DiverseArchive& archive() const { return archive_; }
  /// Figures of the engine and of the alternatives after the last step.
  std::vector<NamedGauge> gauges() const;
  /// Whether the last step's were kept in the log.
  bool logged_gauges() const { return log_.wants_gauges(last_.step); }

  /// Writes all that an equal session needs to go on as if this one never stopped. After the first step.
  void save(std::ostream& out) const;
  /// Goes on where a session of the same setup was saved; before the first step. Throws Error for a damaged stream, or
  /// one of another search; the session is of no use then.
  void load(std::istream& in);

  /// What was found; after the first step. The session cannot go on afterwards.
  SearchResult finish(std::string stopped_by);

 private:
  void check_loaded() const;

  const Setup& setup_;
  SceneScorer scorer_;
  std::unique_ptr<Engine> engine_;
  DiverseArchive archive_;
  SearchLog log_;
  StepReport last_;
  Stopwatch watch_;
  bool finished_ = false;
};

}  // namespace espalier
