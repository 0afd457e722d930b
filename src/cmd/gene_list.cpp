#include "cmd/gene_list.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "derivation/sweep.h"
#include "model/draw_values.h"
#include "render/gene_text.h"

namespace espalier {
namespace {

struct Row {
  std::uint32_t gene = 0, below = 0;
  std::string rule, variant, path;
  std::vector<std::string> draws, empty;  // "k 0.92, 1.1"; names of slots in which nothing stands
};

std::vector<Row> rows_of(const LoadedDerivation& loaded) {
  const GeneratorGraph& graph = *loaded.grammar.graph;
  const GrammarOutline outline = outline_of(*loaded.grammar.checked, loaded.grammar.sources);
  const std::vector<std::optional<float>> values = draw_values(graph, loaded.derivation);
  std::vector<Row> rows;
  GeneSweep sweep;
  sweep.begin(graph, loaded.derivation);
  while (sweep.next()) {
    Row row;
    row.gene = sweep.position().gene, row.below = sweep.gene().genes_below;
    row.rule = sweep.rule().name, row.variant = sweep.variant().name;
    row.path = row.rule;
    if (sweep.parent() != GeneSweep::kNoParent) {
      const Rule& parent = rule_of(graph, loaded.derivation.genes[sweep.parent()]);
      const Variant& variant = variant_of(graph, loaded.derivation.genes[sweep.parent()]);
      row.path = rows[sweep.parent()].path + "/" + parent.slots[variant.slots[sweep.parent_slot()]].name;
    }
    row.draws = gene_lines(graph, loaded.derivation, sweep.position(), outline, values);
    for (std::size_t k = 0; k < sweep.variant().slots.size(); ++k) {
      if (sweep.slot(k) != SlotState::filled) row.empty.push_back(sweep.slot_of_rule(k).name);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace

std::string gene_list(const LoadedDerivation& loaded) {
  std::string text;
  for (const Row& row : rows_of(loaded)) {
    text += fmt::format("{:>5}  {}", row.gene, row.path);
    if (!row.variant.empty()) text += fmt::format("  ({})", row.variant);
    if (row.below > 0) text += fmt::format("  {} below", row.below);
    text += "\n";
    if (!row.draws.empty()) text += fmt::format("       {}\n", joined(row.draws, "; "));
    if (!row.empty.empty()) text += fmt::format("       empty: {}\n", joined(row.empty, ", "));
  }
  return text;
}

std::string gene_list_json(const LoadedDerivation& loaded) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const Row& row : rows_of(loaded)) {
    list.push_back({{"gene", row.gene}, {"path", row.path}, {"rule", row.rule}, {"variant", row.variant},
                    {"below", row.below}, {"draws", row.draws}, {"empty", row.empty}});
  }
  return list.dump(1) + "\n";
}

}  // namespace espalier
