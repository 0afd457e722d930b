#include "breed/features.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/math.h"
#include "base/natural_log.h"
#include "model/parts.h"

namespace espalier {
namespace {

constexpr std::size_t kQuarters = 4;
constexpr const char* kQuarterNames[kQuarters] = {"bottom", "lower middle", "upper middle", "top"};
constexpr Measure kShown[] = {Measure::triangles, Measure::height, Measure::spread, Measure::volume, Measure::balance};

double circle(std::uint32_t quantile, bool cosine_wanted) {
  const auto angle = static_cast<float>(quantile * 0x1.0p-32 * 2 * kPi);
  return 0.5 + 0.5 * (cosine_wanted ? cosine(angle) : sine(angle));
}

/// 0 at `low`, 1 at `high`, by the logarithm.
double on_log_scale(double value, double low, double high) {
  return natural_log(std::max(value, low) / low) / natural_log(high / low);
}

double scaled(Measure measure, double value) {
  switch (measure) {
    case Measure::triangles: return on_log_scale(value, 10, 1e6);
    case Measure::height:
    case Measure::spread: return on_log_scale(value, 0.01, 100);
    case Measure::volume: return on_log_scale(value, 1e-4, 1e4);
    default: return value;
  }
}

/// Per quarter of the height, the share of the parts and how far they reach out, over the height.
void add_shape(const Model& model, std::vector<double>& features) {
  Bounds box;
  for (const Instance& part : model.instances) {
    if (in_full(part) && can_be_shown(part.model_from_mesh)) box.add(part.model_from_mesh.origin);
  }
  double count[kQuarters] = {}, reach[kQuarters] = {}, all = 0;
  const double height = box.empty() ? 0 : box.size().y;
  for (const Instance& part : model.instances) {
    if (!in_full(part) || !can_be_shown(part.model_from_mesh) || !(height > 0)) continue;
    const Vec3 at = part.model_from_mesh.origin;
    const auto quarter = std::min(static_cast<std::size_t>(kQuarters * ((at.y - box.min.y) / height)), kQuarters - 1);
    const double x = at.x, z = at.z;
    count[quarter] += 1;
    reach[quarter] += std::sqrt(x * x + z * z);
    all += 1;
  }
  for (std::size_t q = 0; q < kQuarters; ++q) {
    features.push_back(all > 0 ? count[q] / all : 0);
    features.push_back(count[q] > 0 ? std::min(reach[q] / count[q] / height, 2.0) / 2 : 0);
  }
}

}  // namespace

Features::Features(const GeneratorGraph& graph) {
  counts_.resize(graph.rules.size());
  std::vector<RuleId> order = {graph.start()};
  for (RuleId rule = 0; rule < graph.rules.size(); ++rule) {
    if (rule != graph.start()) order.push_back(rule);
  }
  for (const RuleId id : order) {
    const Rule& rule = graph.rules[id];
    if (id != graph.start()) {
      counts_[id] = names_.size();
      names_.push_back(fmt::format("number of {}", rule.name));
    }
    for (std::uint16_t draw = 0; draw < rule.draws.size() && places_.size() < kMostDraws; ++draw) {
      const bool circular = rule.draws[draw].shape == DrawShape::circular;
      places_.push_back({id, draw, circular, names_.size()});
      const std::string& full = rule.draws[draw].name;
      const std::string name = id == graph.start() ? full.substr(full.find('.') + 1) : full;
      names_.push_back(circular ? name + ", cosine" : name);
      if (circular) names_.push_back(name + ", sine");
    }
  }
  genome_size_ = names_.size();
  for (const Measure measure : kShown) names_.emplace_back(facts_of(measure).name);
  for (const char* quarter : kQuarterNames) {
    names_.push_back(fmt::format("parts in the {} quarter", quarter));
    names_.push_back(fmt::format("width of the {} quarter", quarter));
  }
}

std::vector<double> Features::of_genome(const GeneratorGraph& graph, const Derivation& derivation) const {
  std::vector<double> features(genome_size_), seen(genome_size_);
  std::vector<double> genes(graph.rules.size());
  // Where the draws of each rule stand in places_: they are in the order of places_, rule by rule.
  std::vector<std::vector<const Place*>> of_rule(graph.rules.size());
  for (const Place& place : places_) {
    std::vector<const Place*>& list = of_rule[place.rule];
    list.resize(graph.rules[place.rule].draws.size());
    list[place.draw] = &place;
  }
  std::size_t at = 0;
  for (const GeneRecord& gene : derivation.genes) {
    const RuleId rule = graph.edges[gene.edge].child;
    genes[rule] += 1;
    for (const std::uint16_t draw : graph.rules[rule].variants[gene.variant].draws) {
      const std::uint32_t quantile = derivation.draws[at++];
      const Place* place = of_rule[rule].empty() ? nullptr : of_rule[rule][draw];
      if (!place) continue;
      features[place->at] += place->circular ? circle(quantile, true) : quantile * 0x1.0p-32;
      if (place->circular) features[place->at + 1] += circle(quantile, false);
      seen[place->at] += 1;
    }
  }
  for (const Place& place : places_) {
    for (std::size_t i = place.at; i <= place.at + place.circular; ++i) {
      features[i] = seen[place.at] > 0 ? features[i] / seen[place.at] : 0.5;
    }
  }
  for (RuleId rule = 0; rule < graph.rules.size(); ++rule) {
    if (rule != graph.start()) features[counts_[rule]] = on_log_scale(1 + genes[rule], 1, 1000);
  }
  return features;
}

std::vector<double> Features::of(const GeneratorGraph& graph, const Derivation& derivation, const Model& model,
                                 const PerMeasure<double>& measures) const {
  std::vector<double> features = of_genome(graph, derivation);
  for (const Measure measure : kShown) features.push_back(scaled(measure, measures[measure]));
  add_shape(model, features);
  CHECK(features.size() == size());
  return features;
}

double feature_distance(const std::vector<double>& a, const std::vector<double>& b) {
  CHECK(!a.empty() && a.size() == b.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace espalier
