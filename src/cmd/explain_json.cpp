#include <nlohmann/json.hpp>

#include "cmd/explain.h"

namespace espalier {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Spread& s) {
  return {{"mean", s.mean},     {"least", s.least}, {"p05", s.low},
          {"median", s.median}, {"p95", s.high},    {"most", s.most}};
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const RuleReport& r) {
  Json json = {{"name", r.name},
               {"draws", r.draws},
               {"required_slots", r.required_slots},
               {"optional_slots", r.optional_slots},
               {"variants", r.variants},
               {"limit", nullptr},
               {"guard", nullptr},
               {"spawned_by", r.spawned_by},
               {"expected_genes", nullptr},
               {"mean_genes", r.mean}};
  if (r.limit) json["limit"] = *r.limit;
  if (!r.guard.empty()) json["guard"] = r.guard;
  if (r.expected) json["expected_genes"] = *r.expected;
  return json;
}

Json json_of(const SampleReport& s) {
  Json json = {{"genes", json_of(s.genes)},
               {"levels", json_of(s.levels)},
               {"parts", json_of(s.parts)},
               {"details", json_of(s.details)},
               {"triangles", json_of(s.triangles)},
               {"log_prior", json_of(s.log_prior)},
               {"size", {json_of(s.size[0]), json_of(s.size[1]), json_of(s.size[2])}},
               {"box", nullptr},
               {"reached_gene_budget", s.open},
               {"reached_detail_budget", s.thinned},
               {"dropped_parts", s.dropped},
               {"showed_nothing", s.bare}};
  if (!s.box.empty()) json["box"] = {{"min", json_of(s.box.min)}, {"max", json_of(s.box.max)}};
  return json;
}

Json attributes_of(const GrammarReport& report) {
  Json list = Json::array();
  for (const AttributeReport& a : report.attributes) {
    Json json = {{"name", a.name}, {"label", a.label}, {"written", a.written}, {"value", a.value}};
    if (a.ranged) json["low"] = a.low, json["high"] = a.high;
    if (a.ranged && a.step > 0) json["step"] = a.step;
    list.push_back(std::move(json));
  }
  return list;
}

Json materials_of(const GeneratorGraph& graph) {
  Json list = Json::array();
  for (const Material& m : graph.materials) {
    list.push_back({{"name", m.name}, {"color", json_of(m.color)}, {"roughness", m.roughness}, {"metal", m.metal},
                    {"opacity", m.opacity}, {"glow", m.glow}});
  }
  return list;
}

}  // namespace

std::string report_json(const GrammarReport& report, const ExplainRequest& request) {
  const GeneratorGraph& graph = *report.grammar.graph;
  Json json = {{"file", report.grammar.path},
               {"grammar", graph.name},
               {"grammar_hash", graph.source_hash},
               {"edges", graph.edges.size() - 1},
               {"details", graph.detail_names},
               {"expected_genes", nullptr}};
  if (report.expected) json["expected_genes"] = *report.expected;
  json["rules"] = Json::array();
  for (const RuleReport& rule : report.rules) json["rules"].push_back(json_of(rule));
  json["attributes"] = attributes_of(report);
  json["meshes"] = Json::array();
  for (const MeshReport& mesh : report.meshes) {
    json["meshes"].push_back({{"name", mesh.name}, {"triangles", mesh.triangles}});
  }
  json["materials"] = materials_of(graph);
  json["derivations"] = Json::array();
  for (const DerivationCount& count : report.derivations) {
    json["derivations"].push_back({{"most_levels", count.levels}, {"count", count.count}});  // null: 10^300 or more
  }
  json["seed"] = request.seed;
  json["samples"] = report.samples.count;
  json["sampled"] = json_of(report.samples);
  json["seconds"] = {{"draw", report.samples.draw_seconds}, {"build", report.samples.build_seconds}};
  json["warnings"] = report.grammar.warnings;
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace espalier
