#include "run/contest_html.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "run/report_text.h"

namespace espalier {
namespace {

/// The tables of a settings file that an engine reads.
std::string engine_settings(EngineKind engine, const std::string& settings) {
  std::vector<std::string_view> wanted = {name_of(engine)};
  if (engine == EngineKind::hybrid)
    wanted = {name_of(engine), name_of(EngineKind::sosmc), name_of(EngineKind::ga), name_of(EngineKind::rjmcmc)};
  std::string text;
  for (const std::string_view name : wanted) {
    const std::string head = fmt::format("[engine.{}]\n", name);
    const std::size_t begin = settings.find(head);
    if (begin == std::string::npos) continue;
    const std::size_t end = settings.find("\n[", begin + head.size());
    text += (text.empty() ? "" : "\n") + settings.substr(begin, end - begin);
    if (!text.ends_with('\n')) text += '\n';
  }
  return text;
}

/// Numbers for script: null for what is not finite.
std::string numbers_json(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) {
    if (text.size() > 1) text += ',';
    text += std::isfinite(value) ? fmt::format("{:.7g}", value) : "null";
  }
  return text + "]";
}

std::string curve_json(const CompareCurve& curve) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const auto member = [&](const char* name, double (*value)(const SampleSummary&)) {
    std::vector<double> values;
    for (const std::optional<SampleSummary>& point : curve.points) values.push_back(point ? value(*point) : kNothing);
    return fmt::format("\"{}\":{},\n", name, numbers_json(values));
  };
  std::string searches;
  for (const auto& search : curve.searches) {
    std::vector<double> values;
    for (const std::optional<double>& value : search) values.push_back(value.value_or(kNothing));
    searches += (searches.empty() ? "" : ",\n") + numbers_json(values);
  }
  return "{" + member("mean", [](const SampleSummary& s) { return s.mean; }) +
         member("deviation", [](const SampleSummary& s) { return s.deviation; }) +
         member("median", [](const SampleSummary& s) { return s.median; }) +
         member("lower", [](const SampleSummary& s) { return s.lower; }) +
         member("upper", [](const SampleSummary& s) { return s.upper; }) + fmt::format("\"searches\":[{}]}}", searches);
}

}  // namespace

std::string score_html(double score, double optimum) {
  if (!std::isfinite(score)) return "&ndash;";
  if (optimum > 0) return fmt::format("{:.1f}&thinsp;%", 100 * score / optimum);
  return readable_number(score);
}

std::string chance_in_words(double chance) {
  if (chance < 0.001) return "< 0.001";
  return chance < 0.1 ? fmt::format("{:.3f}", chance) : fmt::format("{:.2f}", chance);
}

std::string spread_cell(const SampleSummary& s, double low, double high, const std::string& kind) {
  std::string html = fmt::format("<td class=\"spread {}\"><span aria-hidden=\"true\">", kind);
  const bool drawn = std::isfinite(s.median) && high > low;
  const auto at = [&](double value) { return 100 * std::clamp((value - low) / (high - low), 0.0, 1.0); };
  const auto piece = [&](const char* name, double from, double to) {
    html += fmt::format("<i class=\"{}\" style=\"left:{:.2f}%;width:{:.2f}%\"></i>", name, at(from), at(to) - at(from));
  };
  if (drawn) {
    piece("range", s.min, s.max);
    piece("box", s.lower, s.upper);
    html += fmt::format("<i class=\"middle\" style=\"left:{:.2f}%\"></i>", at(s.median));
  }
  return html + "</span></td>";
}

std::string warning_list(const std::vector<std::string>& warnings) {
  std::string items;
  for (const std::string& warning : warnings) items += "<li>" + escape_html(warning) + "</li>\n";
  return items.empty() ? "" : "<ul class=\"warnings\" aria-label=\"Warnings\">\n" + items + "</ul>\n";
}

std::string contest_provenance(const Contest& contest, const ContestMachine& machine, const InputFiles& inputs) {
  std::string html = "<dl>\n";
  const auto row = [&](const std::string& name, const std::string& value) {
    html += fmt::format("<dt>{}</dt><dd><code>{}</code></dd>\n", escape_html(name), escape_html(value));
  };
  row("version", kVersion);
  row("scene", contest.scene_path);
  if (const std::string words = in_words(machine); !words.empty()) row("machine", words);
  row("seeds", fmt::format("{}", fmt::join(contest.seeds, ", ")));
  for (const auto& [name, hash] : inputs.hashes()) row(name, hash);
  return html + "</dl>\n";
}

std::string settings_box(const ContestVariant& variant, const std::string& settings) {
  std::string own;
  for (const std::string& setting : variant.settings) own += "<code>" + escape_html(setting) + "</code> ";
  return fmt::format("<details><summary><b>{}</b> {}</summary>\n<pre tabindex=\"0\">{}</pre></details>\n",
                     escape_html(variant.name), own,
                     escape_html(engine_settings(variant.scene.search.engine, settings)));
}

std::string kind_of(std::size_t variant) { return fmt::format("s{}", variant % 8); }

std::string swatch(std::size_t variant) { return fmt::format("<i class=\"swatch {}\"></i>", kind_of(variant)); }

std::string legend(const std::vector<std::string>& names) {
  std::string html;
  for (std::size_t v = 0; v < names.size(); ++v) {
    html += fmt::format("<button type=\"button\" class=\"{}\" aria-pressed=\"true\">{}{}</button>", kind_of(v),
                        swatch(v), escape_html(names[v]));
  }
  return html;
}

std::string axis_json(const std::string& name, const std::vector<double>& at, const std::vector<CompareCurve>& curves) {
  std::string text;
  for (const CompareCurve& curve : curves) text += (text.empty() ? "" : ",\n") + curve_json(curve);
  return fmt::format("{{\"name\":\"{}\",\n\"at\":{},\n\"curves\":[{}]}}", name, numbers_json(at), text);
}

std::string chart_json(double optimum, const std::vector<std::string>& names, const std::vector<std::string>& labels,
                       const std::vector<std::string>& axes) {
  const auto list = [](const std::vector<std::string>& texts) {
    return nlohmann::ordered_json(texts).dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  };
  return json_for_script(fmt::format("{{\"optimum\":{:.9g},\n\"names\":{},\n\"labels\":{},\n\"axes\":[{}]}}",
                                     optimum, list(names), list(labels), fmt::join(axes, ",\n")));
}

std::string listed_names(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "" : names[0];
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

}  // namespace espalier
