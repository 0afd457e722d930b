#pragma once
// What a contest tells while it goes on, and the sinks that turn it into a bar, plain lines or JSON lines.

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "run/contest.h"

namespace espalier {

struct ContestStart {
  std::string what;     // "compare" or "sweep"
  std::string grammar;
  std::vector<std::string> names;  // of the variants
  std::vector<std::uint64_t> seeds;
  SceneBudget budget;
  int threads = 1;
  double optimum = 0;
  std::string out;
};

/// What is known before the first search. `what`: "compare" or "sweep".
ContestStart contest_start(const char* what, const Contest& contest, const Setup& setup, const std::string& out,
                           int threads);

class ContestObserver : public ContestWatcher {
 public:
  virtual void started(const ContestStart&) {}
  /// The searches are over, results are being written.
  virtual void writing() {}
  virtual void written() {}
};

/// For a terminal: a line that is drawn anew, at most ten times a second.
std::unique_ptr<ContestObserver> make_contest_bar(std::ostream& out);
/// For a pipe or file: a line per search that ends, and one every ten seconds.
std::unique_ptr<ContestObserver> make_contest_lines(std::ostream& out);
/// One JSON object per line: {"event": "started" | "turn" | "ended" | "warning" | "writing", ...}.
std::unique_ptr<ContestObserver> make_contest_json(std::ostream& out);

/// "5 variants x 3 seeds, 20 s each: about 5 minutes".
std::string plan_in_words(const ContestStart& start);

}  // namespace espalier
