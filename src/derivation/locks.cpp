#include "derivation/locks.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/position.h"

namespace espalier {

std::vector<std::uint16_t> parse_gene_path(const GeneratorGraph& graph, const std::string& text) {
  std::vector<std::uint16_t> path;
  const Rule* rule = nullptr;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    const std::string_view step = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    if (!rule) {
      rule = &graph.rules[graph.start()];
      if (step == rule->name) continue;
      throw Error(
          fmt::format("gene path \"{}\": starts with \"{}\", but the start rule is {}", text, step, rule->name));
    }
    const auto found = std::find_if(rule->slots.begin(), rule->slots.end(),
                                    [&](const Slot& slot) { return slot.name == step; });
    if (found == rule->slots.end()) {
      throw Error(fmt::format("gene path \"{}\": rule {} has no slot \"{}\"", text, rule->name, step));
    }
    path.push_back(static_cast<std::uint16_t>(found - rule->slots.begin()));
    rule = &graph.rule_of(found->edge);
  }
  return path;
}

std::string format_gene_path(const GeneratorGraph& graph, const std::vector<std::uint16_t>& path) {
  const Rule* rule = &graph.rules[graph.start()];
  std::string text = rule->name;
  for (const std::uint16_t s : path) {
    CHECK(s < rule->slots.size());
    text += '/';
    text += rule->slots[s].name;
    rule = &graph.rule_of(rule->slots[s].edge);
  }
  return text;
}

std::vector<std::uint16_t> gene_path(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t gene) {
  GenePath way;
  locate(graph, derivation, gene, way);
  std::vector<std::uint16_t> path;
  for (const PathStep& step : way.steps) {
    path.push_back(variant_of(graph, derivation.genes[step.gene.gene]).slots[step.slot]);
  }
  return path;
}

std::optional<std::uint32_t> find_gene(const GeneratorGraph& graph, const Derivation& derivation,
                                       const std::vector<std::uint16_t>& path) {
  GenePosition here;
  for (const std::uint16_t s : path) {
    const std::vector<std::uint16_t>& slots = variant_of(graph, derivation.genes[here.gene]).slots;
    const auto found = std::find(slots.begin(), slots.end(), s);
    if (found == slots.end()) return std::nullopt;
    const std::uint32_t k = static_cast<std::uint32_t>(found - slots.begin());
    if (derivation.slots[here.slot + k] != SlotState::filled) return std::nullopt;
    here = child_in_slot(graph, derivation, here, k);
  }
  return here.gene;
}

}  // namespace espalier
