// espalier explain: what a grammar can make.
#include "cmd/explain.h"

#include <fmt/format.h>

#include "base/counted.h"
#include "base/natural_log.h"
#include "cmd/attributes.h"
#include "cmd/text_table.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"

namespace espalier {
namespace {

constexpr std::size_t kWidth = 100;

// Short and without exponents where people would write none.
std::string number(double value) {
  if (value == 0) return "0";
  const double size = value < 0 ? -value : value;
  if (size >= 1e6 || size < 1e-3) return fmt::format("{:.3g}", value);
  if (size >= 100) return fmt::format("{:.0f}", value);
  std::string text = fmt::format("{:.{}f}", value, size >= 10 ? 1 : size >= 1 ? 2 : 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string slots_of(const RuleReport& rule) {
  std::string text;
  if (rule.required_slots > 0) text = fmt::format("{} required", rule.required_slots);
  if (rule.optional_slots > 0) text += fmt::format("{}{} optional", text.empty() ? "" : ", ", rule.optional_slots);
  return text.empty() ? "none" : text;
}

std::string rules_table(const GrammarReport& report) {
  TextTable table({{"rule"}, {"expected", true}, {"sampled", true}, {"draws", true}, {"variants", true}, {"slots"},
                   {"spawned by"}});
  for (const RuleReport& rule : report.rules) {
    table.add({rule.name, rule.expected ? number(*rule.expected) : "?", number(rule.mean),
               fmt::format("{}", rule.draws), fmt::format("{}", rule.variants), slots_of(rule),
               rule.spawned_by.empty() ? "start" : fmt::format("{}", fmt::join(rule.spawned_by, ", "))});
  }
  std::string text = table.text(kWidth);
  for (const RuleReport& rule : report.rules) {
    std::string bounds = rule.limit ? fmt::format(" limit {}", *rule.limit) : "";
    if (!rule.guard.empty()) bounds += " when " + rule.guard;
    if (!bounds.empty()) text += cut_to(fmt::format("  {}{}", rule.name, bounds), kWidth) + "\n";
  }
  return text;
}

std::string attributes_table(const GrammarReport& report) {
  TextTable table({{"attribute"}, {"value"}, {"range"}, {"label"}});
  for (const AttributeReport& a : report.attributes) {
    table.add({a.name, cut_to(a.written, 24), a.range.empty() ? "-" : cut_to(a.range, 30), a.label});
  }
  return table.text(kWidth);
}

std::string meshes_and_materials(const GrammarReport& report) {
  std::vector<std::string> meshes, materials;
  for (const MeshReport& mesh : report.meshes) {
    meshes.push_back(fmt::format("{} ({})", mesh.name, counted(mesh.triangles, "triangle")));
  }
  std::size_t nameless = 0;
  for (std::size_t m = 1; m < report.grammar.graph->materials.size(); ++m) {
    const std::string& name = report.grammar.graph->materials[m].name;
    if (name.empty()) ++nameless;
    else materials.push_back(name);
  }
  if (nameless > 0) materials.push_back(fmt::format("{} without a name", nameless));
  if (meshes.empty()) meshes.push_back("none");
  if (materials.empty()) materials.push_back("none");
  return listed("meshes:", meshes) + listed("materials:", materials);
}

// 12345, 10^24.6
std::string large_number(double count) {
  if (count < 1e6) return fmt::format("{:.0f}", count);
  return fmt::format("10^{:.1f}", natural_log(count) / 2.302585092994046);
}

std::string samples_table(const SampleReport& s, const ExplainRequest& request) {
  TextTable table({{fmt::format("{}, seed {}", counted(s.count, "sample"), request.seed)}, {"mean", true},
                   {"least", true}, {"5%", true}, {"median", true}, {"95%", true}, {"most", true}});
  const auto add = [&](const char* name, const Spread& v) {
    table.add({name, number(v.mean), number(v.least), number(v.low), number(v.median), number(v.high), number(v.most)});
  };
  add("genes", s.genes);
  add("levels of genes", s.levels);
  add("parts", s.parts);
  add("details", s.details);
  add("triangles", s.triangles);
  add("log prior", s.log_prior);
  constexpr const char* kSizes[] = {"size along x, m", "size along y, m", "size along z, m"};
  for (std::size_t axis = 0; axis < 3; ++axis) add(kSizes[axis], s.size[axis]);
  return table.text(kWidth);
}

std::string remarks(const GrammarReport& report, const ExplainRequest& request) {
  const SampleReport& s = report.samples;
  std::string text;
  if (!s.box.empty()) {
    text += fmt::format("box around all samples: ({}, {}, {}) to ({}, {}, {})\n", number(s.box.min.x),
                        number(s.box.min.y), number(s.box.min.z), number(s.box.max.x), number(s.box.max.y),
                        number(s.box.max.z));
  }
  const auto share = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    text += fmt::format("{} of {} samples {} ({}%)\n", count, s.count, what,
                        number(100.0 * static_cast<double>(count) / static_cast<double>(s.count)));
  };
  if (s.count < request.samples) {
    text += fmt::format("{} of {} samples were looked at: together they have over 5 000 000 parts\n", s.count,
                        request.samples);
  }
  share(s.open, "reached the budget of 10000 genes: the rest of them stays open");
  share(s.thinned, "reached a budget of parts, loops or copies: parts of them are missing");
  share(s.dropped, "lost parts, because a size was negative or not finite");
  share(s.bare, "show nothing");
  std::vector<std::string> counts;
  for (const DerivationCount& count : report.derivations) {
    const bool many = count.count > 1e300;
    counts.push_back(fmt::format("{} of {}", many ? "over 10^300" : large_number(count.count),
                                 counted(count.levels, "level")));
  }
  text += listed("derivations, without their draws, at most so deep:", counts);
  text += fmt::format("time per sample, one thread: {} us to draw, {} us to build\n", number(s.draw_seconds * 1e6),
                      number(s.build_seconds * 1e6));
  return text;
}

}  // namespace

std::string report_text(const GrammarReport& report, const ExplainRequest& request) {
  const GeneratorGraph& graph = *report.grammar.graph;
  std::vector<std::string> counts = {counted(graph.rules.size(), "rule"), counted(graph.edges.size() - 1, "edge"),
                                     counted(graph.details.size(), "detail")};
  if (report.expected) counts.push_back(number(*report.expected) + " genes expected");
  std::string text = listed(fmt::format("{} ({}):", graph.name, report.grammar.path), counts) + "\n";
  text += rules_table(report);
  bool limited = false;
  for (const RuleReport& rule : report.rules) limited |= rule.limit.has_value();
  if (!report.expected) text += "expected genes are too many, or take too long to compute\n";
  else if (limited) text += "expected genes are those without the limits\n";
  if (!report.attributes.empty()) text += "\n" + attributes_table(report);
  text += "\n" + meshes_and_materials(report) + "\n" + samples_table(report.samples, request);
  text += "\n" + remarks(report, request);
  return report.grammar.warnings.empty() ? text : text + "\n" + report.grammar.warnings;
}

int explain_verb(const ExplainOptions& options) {
  const ExplainRequest request{options.grammar, parse_attributes(options.attributes), options.samples, options.seed};
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(0);
  const GrammarReport report = explain_grammar(request, source, *executor);
  fmt::print("{}", options.json ? report_json(report, request) + "\n" : report_text(report, request));
  return kDone;
}

}  // namespace espalier
