#include "studio/publisher.h"

#include <string_view>

#include "derivation/encode.h"
#include "studio/model_message.h"
#include "studio/shown_text.h"

namespace espalier::studio {

Published Publisher::publish(const Workbench& bench, const std::shared_ptr<const Setup>& setup, std::int64_t revision,
                             Derivation derivation, std::uint64_t steps) {
  const GeneratorGraph& graph = setup->graph();
  auto model = std::make_shared<ShownModel>();
  model->number = ++number_;
  model->revision = revision;
  model->setup = setup;
  model->derivation = std::move(derivation);
  model->encoded = encode(graph, model->derivation);
  model->steps = steps;
  model->locks = bench.scene().locks;
  Expander expander(graph);
  expander.expand(model->derivation, ExpandTo::full, model_);
  const Explanation explanation = explain(*model, expander);
  if (bench.scene().has_targets) model->score = explanation.score, model->optimum = explanation.optimum;
  model->words = explanation.words;
  update_table(bench, *setup);
  SentModel sent = model_message(model->number, table_, graph, model->derivation, model_);
  ModelPacket packet{table_, meshes_, nullptr, nullptr};
  packet.shown = std::make_shared<const std::string>(to_text(shown_text(*model, explanation, model_, sent)));
  packet.model = std::make_shared<const std::string>(std::move(sent.bytes));
  return {std::move(model), std::move(packet)};
}

Explanation Publisher::explain(const ShownModel& shown, Expander& expander) {
  const Objective& objective = shown.setup->objective;
  Objective::Scratch scratch(objective);
  const Model* seen = &model_;
  switch (objective.view()) {
    case TargetView::genes: view_.clear(), seen = &view_; break;
    case TargetView::bones: expander.expand(shown.derivation, ExpandTo::bones, view_), seen = &view_; break;
    case TargetView::parts: expander.expand(shown.derivation, ExpandTo::parts, view_), seen = &view_; break;
    case TargetView::full: break;
  }
  return objective.explain(shown.derivation, *seen, scratch);
}

/// A new number whenever the meshes may have changed.
void Publisher::update_table(const Workbench& bench, const Setup& setup) {
  if (meshes_of_ == bench.grammar_number()) return;
  std::string message = mesh_message(table_ + 1, setup.meshes);
  const bool same = meshes_ && std::string_view(*meshes_).substr(12) == std::string_view(message).substr(12);
  if (!same) meshes_ = std::make_shared<const std::string>(std::move(message)), ++table_;
  meshes_of_ = bench.grammar_number();
}

}  // namespace espalier::studio
