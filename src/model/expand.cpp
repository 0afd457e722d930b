#include "model/expand.h"

#include "base/check.h"
#include "base/hash.h"
#include "model/machine.h"

namespace espalier {

struct Expander::Scratch {
  explicit Scratch(const GeneratorGraph& graph) : machine(graph) {}
  Machine machine;
};

Expander::Expander(const GeneratorGraph& graph, const ExpandLimits& limits)
    : graph_(&graph), limits_(limits), scratch_(std::make_unique<Scratch>(graph)) {}
Expander::~Expander() = default;
Expander::Expander(Expander&&) noexcept = default;

void Expander::expand(const Derivation& derivation, ExpandTo phase, Model& model) {
  Machine& machine = scratch_->machine;
  model.clear();
  machine.model = &model;
  machine.parts_wanted = phase != ExpandTo::bones;
  machine.materials->reset();
  machine.materials_wanted = limits_.make_materials && phase != ExpandTo::bones;
  machine.details_wanted = phase == ExpandTo::full && graph_->uses_details;
  machine.parts_left = limits_.most_parts;
  machine.turns_left = limits_.most_turns;
  machine.copies_left = limits_.most_copies;
  const auto stride = static_cast<std::uint32_t>(graph_->counted_rules.size() + graph_->registers.parameters);
  machine.children.reset(stride);
  machine.calls.reset(stride);

  float* counts;
  Pending& root = machine.children.push(counts);
  root = {};
  root.state.key = scatter(derivation.detail_seed);
  for (std::size_t i = 0; i < stride; ++i) counts[i] = 0;

  // Rules: depth first, the last slot of a gene before its first. The budget of parts thins details, never the tree.
  while (!machine.children.empty()) {
    machine.take(machine.children, machine.children.size() - 1);
    machine.children.pop_back();
    machine.run_gene(derivation);
  }
  // Details: first come, first served, so a spent budget thins them evenly.
  for (std::size_t i = 0; i < machine.calls.size() && !model.truncated; ++i) {
    machine.take(machine.calls, i);
    machine.run_detail();
  }
}

}  // namespace espalier
