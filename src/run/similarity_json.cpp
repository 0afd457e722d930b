#include <nlohmann/json.hpp>

#include "run/similarity.h"

namespace espalier {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SampleSummary& s) {
  return {{"median", s.median}, {"lower", s.lower}, {"upper", s.upper}, {"mean", s.mean}, {"least", s.min},
          {"most", s.max}};
}

Json json_of(const ShapeDistance& d) {
  return {{"all", json_of(d.all)},
          {"occupied", d.occupied ? json_of(*d.occupied) : Json()},
          {"voxels", {{"both", d.both}, {"only_first", d.only_first}, {"only_second", d.only_second},
                      {"neither", d.neither}}}};
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const ComparedModel& m) {
  Json json = {{"path", m.path},
               {"kind", m.is_mesh ? "mesh" : "derivation"},
               {"truncated", m.truncated},
               {"triangles", m.triangles},
               {"area", m.area},
               {"box", nullptr},
               {"anew", json_of(m.anew)}};
  if (!m.box.empty()) json["box"] = {{"min", json_of(m.box.min)}, {"max", json_of(m.box.max)}};
  return json;
}

}  // namespace

std::string similarity_json(const SimilarityRequest& request, const SimilarityReport& report) {
  const DescriptorSettings& settings = request.descriptor;
  Json json = {{"similarity", 1}};
  json["settings"] = {{"grid", settings.layers},
                      {"pairs", settings.pairs},
                      {"bins", settings.bins},
                      {"range", settings.range ? Json(*settings.range) : Json("diagonal")},
                      {"box", request.shared_box ? "shared" : "own"},
                      {"seed", settings.seed}};
  json["models"] = Json::array();
  for (const ComparedModel& model : report.models) json["models"].push_back(json_of(model));
  json["pairs"] = Json::array();
  for (std::size_t a = 0; a < report.models.size(); ++a) {
    for (std::size_t b = a + 1; b < report.models.size(); ++b) {
      Json pair = {{"first", a}, {"second", b}};
      pair.update(json_of(report.pair(a, b)));
      json["pairs"].push_back(std::move(pair));
    }
  }
  if (!report.voxels.empty()) json["distances"] = report.voxels;
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace espalier
