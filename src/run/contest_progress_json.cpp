// A contest's progress as JSON lines.
#include <ostream>

#include <nlohmann/json.hpp>

#include "run/contest_progress.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

class ContestJson final : public ContestObserver {
 public:
  explicit ContestJson(std::ostream& out) : out_(out) {}

  void started(const ContestStart& start) override {
    names_ = start.names;
    ordered_json budget = ordered_json::object();
    if (start.budget.seconds) budget["seconds"] = *start.budget.seconds;
    if (start.budget.evaluations) budget["evaluations"] = *start.budget.evaluations;
    if (start.budget.generations) budget["generations"] = *start.budget.generations;
    print({{"event", "started"},
           {"what", start.what},
           {"grammar", start.grammar},
           {"variants", start.names},
           {"seeds", start.seeds},
           {"budget", budget},
           {"threads", start.threads},
           {"optimum", start.optimum},
           {"out", start.out}});
  }
  void turn(const ContestTurn& turn) override {
    print({{"event", "turn"},
           {"variant", names_[turn.variant]},
           {"seed", turn.seed},
           {"step", turn.report.step},
           {"evaluations", turn.report.evaluations},
           {"seconds", turn.report.seconds},
           {"best", turn.report.best},
           {"mean", turn.report.mean},
           {"share_done", turn.share}});
  }
  void ended(const ContestOutcome& outcome) override {
    if (!outcome.problem.empty()) {
      return print({{"event", "ended"}, {"variant", names_[outcome.variant]}, {"seed", outcome.seed},
                    {"problem", outcome.problem}});
    }
    print({{"event", "ended"},
           {"variant", names_[outcome.variant]},
           {"seed", outcome.seed},
           {"score", outcome.score ? ordered_json(*outcome.score) : ordered_json()},
           {"best", outcome.rises.best()},
           {"steps", outcome.step_count},
           {"evaluations", outcome.evaluations},
           {"seconds", outcome.seconds},
           {"stopped_by", outcome.stopped_by}});
  }
  void warning(const std::string& text) override { print({{"event", "warning"}, {"message", text}}); }
  void writing() override { print({{"event", "writing"}}); }

 private:
  void print(const ordered_json& event) {
    out_ << event.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << '\n' << std::flush;
  }
  std::ostream& out_;
  std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<ContestObserver> make_contest_json(std::ostream& out) { return std::make_unique<ContestJson>(out); }

}  // namespace espalier
