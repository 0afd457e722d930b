// The numbers of a run: result.json and convergence.csv.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "io/file.h"
#include "run/csv.h"
#include "run/explanation_json.h"
#include "run/json_number.h"
#include "run/results.h"

namespace espalier {

using nlohmann::ordered_json;

namespace {

ordered_json gauges_json(const SearchLog& log) {
  ordered_json gauges = ordered_json::object();
  for (const NamedGauge& gauge : log.last_gauges()) gauges[gauge.name] = number_or_null(gauge.value);
  return gauges;
}

/// Evaluations per second between two rows.
std::string speed_cell(const StepReport& from, const StepReport& to) {
  const double seconds = to.seconds - from.seconds;
  return seconds > 0 ? fmt::format("{:.1f}", static_cast<double>(to.evaluations - from.evaluations) / seconds) : "";
}

}  // namespace

void ResultWriter::write_result(const std::string& path) const {
  const Explanation& e = result_.explanation;
  ordered_json diagnostics = ordered_json::object();
  for (const NamedCount& count : result_.diagnostics) diagnostics[count.name] = count.value;
  ordered_json rejections = ordered_json::object();
  for (const Rejections& rejected : result_.rejections) {
    rejections[rejected.name] = {{"bound", rejected.bound}, {"models", rejected.count}};
    if (rejected.count == 0) continue;
    rejections[rejected.name]["lowest"] = rejected.lowest;
    rejections[rejected.name]["highest"] = rejected.highest;
  }
  ordered_json alternatives = ordered_json::array();
  for (std::size_t i = 1; i < size(); ++i) {
    alternatives.push_back({{"index", i},
                            {"score", individual(i).score},
                            {"genes", individual(i).derivation.size()},
                            {"derivation", hash_text(individual(i).derivation)}});
  }
  const double per_second = result_.seconds > 0 ? static_cast<double>(result_.evaluations) / result_.seconds : 0;
  const ordered_json document = {
      {"espalier_result", 1},
      {"version", kVersion},
      {"grammar", setup_.graph().name},
      {"engine", name_of(setup_.scene.search.engine)},
      {"seed", setup_.scene.seed},
      {"score", result_.best.score},
      {"optimum", e.optimum},
      {"percent", e.percent ? ordered_json(*e.percent) : ordered_json()},
      {"words", e.words},
      {"genes", result_.best.derivation.size()},
      {"derivation", hash_text(result_.best.derivation)},
      {"targets", ordered_json::parse(explanation_json(e)).at("targets")},
      {"steps", result_.steps},
      {"evaluations", result_.evaluations},
      {"stopped_by", result_.stopped_by},
      {"wall_seconds", result_.seconds},
      {"evaluations_per_second", per_second},
      {"engine_counts", diagnostics},
      {"engine_gauges", gauges_json(result_.log)},
      {"rejections", rejections},
      {"alternatives", alternatives},
      {"alternatives_spread", result_.spread},
      {"provenance", ordered_json::parse(to_json(provenance(0, ".")))},
  };
  write_file(path, document.dump(1) + "\n");
}

void ResultWriter::write_convergence(const std::string& path) const {
  std::string text = "step,evaluations,seconds,best,mean\n";
  for (const StepReport& r : result_.log.steps()) {
    text += fmt::format("{},{},{:.6f},{},{}\n", r.step, r.evaluations, r.seconds, r.best, r.mean);
  }
  write_file(path, text);
}

void ResultWriter::write_diagnostics(const std::string& path) const {
  std::string text = "step,evaluations,seconds,evaluations_per_second";
  for (const std::string& name : result_.log.gauge_names()) text += "," + csv_field(name);
  text += "\n";
  StepReport before;
  for (const auto& [number, row] : result_.log.gauge_rows()) {
    const StepReport& r = row.report;
    text += fmt::format("{},{},{:.6f},{}", r.step, r.evaluations, r.seconds, speed_cell(before, r));
    for (const double value : row.values) text += "," + csv_number(value);
    text += "\n";
    before = r;
  }
  write_file(path, text);
}

}  // namespace espalier
