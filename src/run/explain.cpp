#include "run/explain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/check.h"
#include "derivation/sample.h"
#include "derivation/sweep.h"
#include "model/expand.h"
#include "model/parts.h"

namespace espalier {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What one sample has to say.
struct Finding {
  std::vector<std::uint32_t> genes_of_rule;
  double genes = 0, levels = 0, parts = 0, details = 0, triangles = 0, log_prior = 0;
  Bounds box;
  bool open = false, thinned = false, dropped = false;
  double draw_seconds = 0, build_seconds = 0;
};

Finding look_at(const GeneratorGraph& graph, const MeshTable& meshes, std::uint64_t seed, std::uint32_t index) {
  Finding found;
  const auto start = std::chrono::steady_clock::now();
  RandomStream random({seed, Purpose::sample, 0, index, 0});
  const SampleResult drawn = sample(graph, random);
  found.draw_seconds = seconds_since(start);
  found.open = drawn.truncated;
  found.genes = static_cast<double>(drawn.derivation.size());
  found.log_prior = log_prior(graph, drawn.derivation);
  found.genes_of_rule.assign(graph.rules.size(), 0);
  GeneSweep sweep;
  sweep.begin(graph, drawn.derivation);
  while (sweep.next()) {
    ++found.genes_of_rule[graph.edges[sweep.gene().edge].child];
    found.levels = std::max(found.levels, sweep.above().depth + 1.0);
  }
  const auto build = std::chrono::steady_clock::now();
  Model model;
  Expander(graph).expand(drawn.derivation, ExpandTo::full, model);
  found.build_seconds = seconds_since(build);
  found.thinned = model.truncated;
  found.dropped = model.dropped > 0;
  for (const Instance& instance : model.instances) (in_parts(instance) ? found.parts : found.details) += 1;
  found.box = bounds(model, meshes, true);
  const Parts shown = collect_parts(model, meshes, true);
  for (const Part& part : shown.parts) {
    found.triangles += static_cast<double>(shown.shapes[part.shape].mesh.triangles.size());
  }
  return found;
}

Spread spread_over(const std::vector<Finding>& findings, double Finding::* value) {
  std::vector<double> values;
  for (const Finding& found : findings) values.push_back(found.*value);
  return spread_of(std::move(values));
}

// In blocks, so that it can be told whether there were parts enough without asking the clock.
std::vector<Finding> look_at_samples(const GeneratorGraph& graph, const MeshTable& meshes,
                                     const ExplainRequest& request, Executor& executor) {
  constexpr std::size_t kBlock = 50;
  std::vector<Finding> findings;
  double built = 0;
  while (findings.size() < request.samples && built < kMostPartsOfSamples) {
    const std::size_t first = findings.size(), count = std::min<std::size_t>(kBlock, request.samples - first);
    findings.resize(first + count);
    executor.for_each(count, [&](std::size_t i, int) {
      findings[first + i] = look_at(graph, meshes, request.seed, static_cast<std::uint32_t>(first + i));
    });
    for (std::size_t i = first; i < findings.size(); ++i) built += findings[i].parts + findings[i].details;
  }
  return findings;
}

SampleReport summed_up(const std::vector<Finding>& findings) {
  SampleReport report;
  report.count = findings.size();
  report.genes = spread_over(findings, &Finding::genes);
  report.levels = spread_over(findings, &Finding::levels);
  report.parts = spread_over(findings, &Finding::parts);
  report.details = spread_over(findings, &Finding::details);
  report.triangles = spread_over(findings, &Finding::triangles);
  report.log_prior = spread_over(findings, &Finding::log_prior);
  report.draw_seconds = spread_over(findings, &Finding::draw_seconds).mean;
  report.build_seconds = spread_over(findings, &Finding::build_seconds).mean;
  std::array<std::vector<double>, 3> sizes;
  for (const Finding& found : findings) {
    report.open += found.open;
    report.thinned += found.thinned;
    report.dropped += found.dropped;
    report.bare += found.box.empty();
    if (found.box.empty()) continue;
    report.box.add(found.box);
    for (int axis = 0; axis < 3; ++axis) sizes[static_cast<std::size_t>(axis)].push_back(found.box.size()[axis]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) report.size[axis] = spread_of(std::move(sizes[axis]));
  return report;
}

std::vector<RuleReport> rules_of(const GeneratorGraph& graph, const GrammarOutline& outline) {
  std::vector<RuleReport> rules;
  for (const Rule& rule : graph.rules) {
    RuleReport& report = rules.emplace_back();
    report.name = rule.name;
    report.draws = rule.draws.size();
    for (const Slot& slot : rule.slots) {
      ++(graph.edges[slot.edge].required ? report.required_slots : report.optional_slots);
    }
    report.variants = rule.variants.size();
    report.limit = rule.limit;
    const auto written = outline.rules.find(rule.name);
    if (rule.guarded) report.guard = written == outline.rules.end() ? "(a guard)" : written->second.guard;
  }
  for (std::size_t e = 1; e < graph.edges.size(); ++e) {
    std::vector<std::string>& by = rules[graph.edges[e].child].spawned_by;
    const std::string& parent = graph.rules[graph.edges[e].parent].name;
    if (std::find(by.begin(), by.end(), parent) == by.end()) by.push_back(parent);
  }
  return rules;
}

std::vector<AttributeReport> attributes_of(const GeneratorGraph& graph, const GrammarOutline& outline,
                                           const std::map<std::string, std::string>& overrides) {
  std::vector<AttributeReport> attributes;
  for (const Attribute& a : graph.attributes) {
    AttributeReport report{a.name, "", "", a.label, a.value, a.low, a.high, a.step, a.ranged};
    if (const auto written = outline.attributes.find(a.name); written != outline.attributes.end()) {
      report.written = written->second.value;
      report.range = written->second.range;
    }
    if (const auto set = overrides.find(a.name); set != overrides.end()) report.written = set->second;
    attributes.push_back(std::move(report));
  }
  return attributes;
}

std::vector<MeshReport> meshes_of(const GeneratorGraph& graph, const MeshTable& meshes) {
  constexpr const char* kKinds[] = {"box", "cylinder", "cone", "sphere", "wedge", "pyramid", "quad", "leaf"};
  std::vector<MeshReport> reports;
  for (std::size_t m = 0; m < graph.meshes.size(); ++m) {
    const MeshRef& ref = graph.meshes[m];
    std::string name = ref.kind == MeshKind::file ? ref.path : kKinds[static_cast<std::size_t>(ref.kind)];
    if (ref.kind == MeshKind::cylinder || ref.kind == MeshKind::cone) name += fmt::format(" of {} sides", ref.sides);
    if (ref.kind == MeshKind::file && ref.as_is) name += " as is";
    reports.push_back({std::move(name), meshes.mesh(m).triangles.size()});
  }
  return reports;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto quantile = [&](double share) {
    const double rank = std::max(1.0, std::ceil(share * count - 1e-9));
    return values[static_cast<std::size_t>(rank) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / count, values.front(), quantile(0.05), quantile(0.5),
          quantile(0.95), values.back()};
}

GrammarReport explain_grammar(const ExplainRequest& request, MeshSource& source, Executor& executor) {
  CHECK(request.samples >= 1);
  GrammarReport report;
  report.grammar = load_grammar(request.grammar, request.attributes);
  const GeneratorGraph& graph = *report.grammar.graph;
  const GrammarOutline outline = outline_of(*report.grammar.checked, report.grammar.sources);
  const MeshTable meshes = load_meshes(report.grammar, source);
  report.rules = rules_of(graph, outline);
  report.attributes = attributes_of(graph, outline, request.attributes);
  report.meshes = meshes_of(graph, meshes);
  report.derivations = count_derivations(graph);
  if (const auto expected = expected_genes(graph)) {
    report.expected = std::accumulate(expected->begin(), expected->end(), 0.0);
    for (std::size_t r = 0; r < report.rules.size(); ++r) report.rules[r].expected = (*expected)[r];
  }
  const std::vector<Finding> findings = look_at_samples(graph, meshes, request, executor);
  report.samples = summed_up(findings);
  for (std::size_t r = 0; r < report.rules.size(); ++r) {
    double genes = 0;
    for (const Finding& found : findings) genes += found.genes_of_rule[r];
    report.rules[r].mean = genes / static_cast<double>(findings.size());
  }
  return report;
}

}  // namespace espalier
