#pragma once
// Progress: what a run tells while it goes on. Observers receive plain values; the sinks below turn them into a bar,
// plain lines or JSON lines.

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/scene.h"
#include "search/engine.h"

namespace espalier {

struct RunStart {
  std::string grammar, engine, out;
  std::uint64_t seed = 0;
  double optimum = 0;
  SceneBudget budget;
  int threads = 1;
  std::uint64_t voxels = 0, pixels = 0;  // of the targets
  std::string live;  // path of the report that is refreshed while the search goes on; empty: none
  double refresh_seconds = 0;
  std::uint64_t resumed_from = 0;  // the step that is there already; 0: a search from the start
  std::string resumed_folder;      // where its checkpoint was
};

/// After each step.
struct StepReport {
  std::uint64_t step = 0, evaluations = 0;
  double seconds = 0;  // since the first step began
  double best = 0;     // ever
  double mean = 0;     // of the population
  std::uint64_t idle = 0;  // steps in a row, up to this one, in which nothing was scored
};

struct RunEnd {
  std::string folder;
  std::vector<std::string> files;  // the ones worth opening, with their paths
  double score = 0, optimum = 0;
  std::optional<double> percent;
  std::string words;
  std::size_t alternatives = 0;
  double spread = 0;        // mean distance of any two of the best and these
  std::uint64_t steps = 0, evaluations = 0;
  double seconds = 0;
  std::string stopped_by;  // as budget_spent (run/budget.h) says, or "interrupt"
};

class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void started(const RunStart&) {}
  virtual void step(const StepReport&) {}
  /// After some of the steps: figures of the moment of the engine and of the alternatives, by name.
  virtual void gauges(const StepReport&, const std::vector<NamedGauge>&) {}
  virtual void warning(const std::string&) {}
  /// The search is over, its results are being written.
  virtual void writing() {}
  virtual void finished(const RunEnd&) {}
};

/// For a terminal: one line that is drawn anew, at most ten times a second.
std::unique_ptr<RunObserver> make_bar(std::ostream& out);
/// For a pipe or file: a line per second at most, then the summary.
std::unique_ptr<RunObserver> make_lines(std::ostream& out);
/// One JSON object per line: {"event": "started" | "step" | "gauges" | "warning" | "writing" | "finished", ...}; every step.
std::unique_ptr<RunObserver> make_json_lines(std::ostream& out);

/// The lines that end a run: score, optimum, percent, words, files.
std::string summary(const RunEnd& end);

}  // namespace espalier
