#include "studio/bred_model.h"

#include <algorithm>
#include <cmath>

#include "base/counted.h"
#include "model/parts.h"
#include "studio/individual_message.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kMostTerms = 40;

double finite(double value) { return std::isfinite(value) ? value : 0; }

}  // namespace

BredModel bred_model(const GeneratorGraph& graph, const Derivation& derivation, const Model& model,
                     const ViabilityReport& report, std::vector<double> features) {
  BredModel made;
  api::Bred& facts = made.facts;
  facts.genes = static_cast<std::int64_t>(derivation.size());
  facts.parts = std::count_if(model.instances.begin(), model.instances.end(), in_full);
  facts.triangles = static_cast<std::int64_t>(finite(report.measures[Measure::triangles]));
  facts.height = finite(report.measures[Measure::height]);
  facts.spread = finite(report.measures[Measure::spread]);
  facts.viable = report.viable;
  facts.why = report.reasons;
  facts.words = counted(static_cast<std::size_t>(facts.parts), "part");
  made.features = std::move(features);
  IndividualModel sent = individual_model(graph, model);
  facts.truncated = model.truncated || sent.truncated;
  made.bytes = std::move(sent.bytes);
  return made;
}

BredModelMaker::BredModelMaker(std::shared_ptr<const Setup> setup, bool scored, const ViabilitySettings& viability)
    : setup_(std::move(setup)), scored_(scored), viability_(setup_->meshes, viability), features_(setup_->graph()),
      expander_(setup_->graph(), {.most_parts = kMostParts}) {}

Explanation BredModelMaker::explain(const Derivation& derivation) {
  const Objective& objective = setup_->objective;
  Objective::Scratch scratch(objective);
  const Model* seen = &model_;
  switch (objective.view()) {
    case TargetView::genes: view_.clear(), seen = &view_; break;
    case TargetView::bones: expander_.expand(derivation, ExpandTo::bones, view_), seen = &view_; break;
    case TargetView::parts: expander_.expand(derivation, ExpandTo::parts, view_), seen = &view_; break;
    case TargetView::full: break;
  }
  return objective.explain(derivation, *seen, scratch);
}

BredModelPtr BredModelMaker::make(const Derivation& derivation) {
  const GeneratorGraph& graph = setup_->graph();
  expander_.expand(derivation, ExpandTo::full, model_);
  const ViabilityReport report = viability_.judge(derivation, model_, scratch_);
  auto made = std::make_shared<BredModel>(
      bred_model(graph, derivation, model_, report, features_.of(graph, derivation, model_, report.measures)));
  if (setup_->objective.size() > 0) add_targets(derivation, made->facts);
  return made;
}

void BredModelMaker::add_targets(const Derivation& derivation, api::Bred& facts) {
  const Explanation explanation = explain(derivation);
  if (scored_ && std::isfinite(explanation.score)) facts.score = explanation.score;
  if (scored_ && !explanation.words.empty()) facts.words = explanation.words;
  if (!explanation.rejected.empty()) facts.viable = false, facts.why.push_back(explanation.rejected);
  for (const Explanation& target : explanation.targets) {
    for (const Term& term : target.terms) {
      if (facts.terms.size() == kMostTerms) return;
      facts.terms.push_back({target.name, term.name, term.count, term.of, term.unit, target.weight * term.value});
    }
  }
}

ModelPacket bred_packet(const BredModel& model, const Bytes& meshes, std::uint32_t table, std::int64_t session,
                        std::int64_t individual, std::uint32_t version) {
  const IndividualAddress address{static_cast<std::uint32_t>(session), static_cast<std::uint32_t>(individual), version, table};
  api::Bred facts = model.facts;
  facts.session = session;
  facts.individual = individual;
  facts.version = version;
  ModelPacket packet{table, meshes, std::make_shared<const std::string>(addressed(model.bytes, address)), nullptr};
  packet.shown = std::make_shared<const std::string>(to_text(facts));
  return packet;
}

}  // namespace espalier::studio
