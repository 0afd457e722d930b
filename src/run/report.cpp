#include "run/report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/version.h"
#include "run/report_assets.h"
#include "run/report_diagnostics.h"
#include "run/report_text.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 1500;  // of a curve: more than a screen has columns

/// Steps to draw: all of a short log; of a long one the last of each of equal stretches, and the first step.
std::vector<std::size_t> points_of(std::size_t steps) {
  std::vector<std::size_t> points;
  const std::size_t stride = (steps + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < steps; ++i) {
    if (i == 0 || i + 1 == steps || (i + 1) % stride == 0) points.push_back(i);
  }
  return points;
}

std::string dump(const ordered_json& json) {
  return json_for_script(json.dump(-1, ' ', true, ordered_json::error_handler_t::replace));
}

/// One member a line, so that the line with times can be told.
std::string data_json(const ReportInput& input) {
  const std::vector<StepReport> log = input.result.log.steps();
  ordered_json seconds = ordered_json::array(), evaluations = seconds, best = seconds, mean = seconds;
  for (const std::size_t i : points_of(log.size())) {
    seconds.push_back(static_cast<double>(static_cast<std::int64_t>(log[i].seconds * 1e4 + 0.5)) / 1e4);
    evaluations.push_back(log[i].evaluations);
    best.push_back(log[i].best);
    mean.push_back(log[i].mean);
  }
  ordered_json live;
  if (input.live) {
    live = {{"refresh", input.live->refresh_seconds}, {"final", input.live->final_folder}};
  }
  std::string out = "{\n";
  out += fmt::format("\"live\": {},\n", dump(live));
  out += fmt::format("\"optimum\": {},\n", dump(input.result.explanation.optimum));
  out += fmt::format("{} {},\n", kTimesLine, dump(seconds));
  out += fmt::format("\"evaluations\": {},\n\"best\": {},\n\"mean\": {},\n", dump(evaluations), dump(best), dump(mean));
  const SceneOutput& output = input.setup.scene.output;
  out += fmt::format("\"picture\": [{}, {}],\n", output.picture[0], output.picture[1]);
  out += fmt::format("\"side\": [{}, {}],\n", output.azimuth_deg, output.elevation_deg);
  return out + fmt::format("\"model\": {}\n}}", json_for_script(input.model.header));
}

std::string headline(const SearchResult& result) {
  const Explanation& e = result.explanation;
  std::string text;
  if (e.percent) text += fmt::format("<span class=\"percent\">{:.1f}&thinsp;%</span> ", *e.percent);
  text += fmt::format("<span class=\"score\">score <b>{}</b>", readable_number(result.best.score));
  if (e.optimum > 0) text += " of at most " + readable_number(e.optimum);
  return text + "</span>";
}

std::string status(const ReportInput& input) {
  if (!input.live) return "";
  return fmt::format("<span class=\"status live\" id=\"status\" role=\"status\">The search goes on; this page loads "
                     "itself anew every {:g} seconds.</span>", input.live->refresh_seconds);
}

std::string ended_by(const std::string& reason) {
  if (reason == "interrupt") return "stopped by hand";
  if (reason.empty()) return "going on";
  if (reason == "nothing left to try") return "ended: there was nothing left to try";
  return "ended by its budget of " + reason;
}

std::string search_line(const ReportInput& input) {
  const SearchResult& r = input.result;
  return fmt::format("{} evaluations in {} steps of {}, {}", readable_number(static_cast<double>(r.evaluations)),
                     readable_number(static_cast<double>(r.steps)), name_of(input.setup.scene.search.engine),
                     ended_by(r.stopped_by));
}

std::string speed_line(const SearchResult& r) {
  const double speed = r.seconds > 0 ? static_cast<double>(r.evaluations) / r.seconds : 0;
  return fmt::format("{}{:.1f} seconds, {:.0f} evaluations per second.</p>", kSpeedClass, r.seconds, speed);
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  std::string items;
  for (const std::string& warning : warnings) items += "<li>" + escape_html(warning) + "</li>\n";
  return items.empty() ? "" : "<ul class=\"warnings\" aria-label=\"Warnings\">\n" + items + "</ul>\n";
}

/// Without script a page can only load itself anew.
std::string reload_tag(const ReportInput& input) {
  if (!input.live) return "";
  const double seconds = std::max(1.0, input.live->refresh_seconds);
  return fmt::format("<noscript><meta http-equiv=\"refresh\" content=\"{:.0f}\"></noscript>\n", seconds);
}

}  // namespace

std::string report_page(const ReportInput& input) {
  const std::string grammar = escape_html(input.setup.graph().name);
  return fill_template(kReportHtml,
                       {{"css", std::string(kReportCss)},
                        {"js", std::string(kReportJs)},
                        {"reload", reload_tag(input)},
                        {"grammar", grammar},
                        {"version", kVersion},
                        {"seed", fmt::format("{}", input.setup.scene.seed)},
                        {"words", escape_html(input.result.explanation.words)},
                        {"headline", headline(input.result)},
                        {"status", status(input)},
                        {"search", search_line(input)},
                        {"speed", speed_line(input.result)},
                        {"warnings", warnings_html(input.setup.warnings)},
                        {"pictures", pictures_html(input)},
                        {"score", score_html(input.result.explanation)},
                        {"diagnostics", diagnostics_html(input.result.log, input.result.diagnostics)},
                        {"alternatives", alternatives_html(input)},
                        {"settings", escape_html(input.provenance.settings)},
                        {"provenance", provenance_html(input)},
                        {"data", data_json(input)},
                        {"model", encode_base64(input.model.bytes)}});
}

}  // namespace espalier
