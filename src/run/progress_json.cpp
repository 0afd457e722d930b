// Progress as JSON lines.
#include <ostream>

#include <nlohmann/json.hpp>

#include "run/json_number.h"
#include "run/progress.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

class JsonLines final : public RunObserver {
 public:
  explicit JsonLines(std::ostream& out) : out_(out) {}

  void started(const RunStart& start) override {
    ordered_json budget = ordered_json::object();
    if (start.budget.seconds) budget["seconds"] = *start.budget.seconds;
    if (start.budget.evaluations) budget["evaluations"] = *start.budget.evaluations;
    if (start.budget.generations) budget["generations"] = *start.budget.generations;
    print({{"event", "started"},
           {"grammar", start.grammar},
           {"engine", start.engine},
           {"seed", start.seed},
           {"threads", start.threads},
           {"voxels", start.voxels},
           {"pixels", start.pixels},
           {"optimum", start.optimum},
           {"budget", budget},
           {"out", start.out},
           {"live", start.live.empty() ? ordered_json() : ordered_json(start.live)},
           {"resumed_from", start.resumed_from > 0 ? ordered_json(start.resumed_from) : ordered_json()},
           {"resumed_folder", start.resumed_from > 0 ? ordered_json(start.resumed_folder) : ordered_json()}});
  }
  void step(const StepReport& report) override {
    print({{"event", "step"},
           {"step", report.step},
           {"evaluations", report.evaluations},
           {"seconds", report.seconds},
           {"best", report.best},
           {"mean", report.mean}});
  }
  void gauges(const StepReport& report, const std::vector<NamedGauge>& gauges) override {
    ordered_json values = ordered_json::object();
    for (const NamedGauge& gauge : gauges) {
      values[gauge.name] = number_or_null(gauge.value);
    }
    print({{"event", "gauges"}, {"step", report.step}, {"evaluations", report.evaluations}, {"gauges", values}});
  }
  void warning(const std::string& text) override { print({{"event", "warning"}, {"message", text}}); }
  void writing() override { print({{"event", "writing"}}); }
  void finished(const RunEnd& end) override {
    print({{"event", "finished"},
           {"score", end.score},
           {"optimum", end.optimum},
           {"percent", end.percent ? ordered_json(*end.percent) : ordered_json()},
           {"words", end.words},
           {"alternatives", end.alternatives},
           {"spread", end.spread},
           {"steps", end.steps},
           {"evaluations", end.evaluations},
           {"wall_seconds", end.seconds},
           {"stopped_by", end.stopped_by},
           {"folder", end.folder},
           {"files", end.files}});
  }

 private:
  void print(const ordered_json& event) {
    out_ << event.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << '\n' << std::flush;
  }
  std::ostream& out_;
};

}  // namespace

std::unique_ptr<RunObserver> make_json_lines(std::ostream& out) { return std::make_unique<JsonLines>(out); }

}  // namespace espalier
