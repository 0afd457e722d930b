#include "studio/gene_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/locks.h"
#include "derivation/position.h"
#include "grammar/outline.h"
#include "model/draw_values.h"
#include "render/gene_text.h"
#include "studio/grammar_check.h"

namespace espalier::studio {
namespace {

constexpr const char* kDegrees = "deg";  // as the language writes them

GenePosition position_of(const ShownModel& shown, std::int64_t gene) {
  if (gene < 0 || gene >= static_cast<std::int64_t>(shown.derivation.size())) {
    throw Error(fmt::format("model {} has no gene {}", shown.number, gene));
  }
  GenePath path;
  locate(shown.setup->graph(), shown.derivation, static_cast<std::uint32_t>(gene), path);
  return path.gene;
}

}  // namespace

bool stands_on(const std::string& path, const std::string& other) {
  return path == other || (path.starts_with(other) && path[other.size()] == '/');
}

std::string path_of(const ShownModel& shown, std::int64_t gene) {
  const GenePosition at = position_of(shown, gene);
  const GeneratorGraph& graph = shown.setup->graph();
  return format_gene_path(graph, gene_path(graph, shown.derivation, at.gene));
}

std::int64_t gene_at(const ShownModel& shown, const std::string& path) {
  const GeneratorGraph& graph = shown.setup->graph();
  const std::optional<std::uint32_t> gene = find_gene(graph, shown.derivation, parse_gene_path(graph, path));
  if (!gene) throw Error(fmt::format("model {} has no gene {}", shown.number, path));
  return *gene;
}

api::Gene gene_text(const ShownModel& shown, std::int64_t gene) {
  const GenePosition at = position_of(shown, gene);
  const GeneratorGraph& graph = shown.setup->graph();
  const LoadedGrammar& grammar = shown.setup->grammar;
  const GeneRecord& record = shown.derivation.genes[at.gene];
  const Rule& rule = rule_of(graph, record);
  const Variant& variant = variant_of(graph, record);
  api::Gene text;
  text.model = shown.number;
  text.gene = gene;
  text.rule = rule.name;
  text.path = path_of(shown, gene);
  text.below = record.genes_below;
  text.locked = std::any_of(shown.locks.begin(), shown.locks.end(),
                            [&](const std::string& lock) { return stands_on(text.path, lock); });
  if (rule.span.file == 0 && rule.span.line > 0) text.at = Utf16Offsets(grammar.sources[0].text).place(rule.span);

  const GrammarOutline outline = outline_of(*grammar.checked, grammar.sources);
  Derivation ends = shown.derivation;
  const std::vector<std::optional<float>> values = draw_values(graph, ends);
  const auto values_at = [&](std::uint32_t quantile) {
    std::fill_n(ends.draws.begin() + at.draw, variant.draws.size(), quantile);
    return draw_values(graph, ends);
  };
  const std::vector<std::optional<float>> low = values_at(0), high = values_at(0xffffffff);
  for (std::size_t k = 0; k < variant.draws.size(); ++k) {
    const DrawComponent& component = rule.draws[variant.draws[k]];
    const DrawOutline* const draw = outline.find_draw(rule.name, component.name);
    const std::size_t i = at.draw + k;
    const std::uint32_t quantile = shown.derivation.draws[i];
    api::Draw row;
    row.name = component.name.substr(component.name.find('.') + 1);
    row.index = static_cast<std::int64_t>(k);
    row.quantile = quantile * 0x1p-32;
    row.value = draw_text(draw, values[i], quantile, kDegrees);
    if (low[i]) row.low = draw_text(draw, low[i], 0, kDegrees);
    if (high[i]) row.high = draw_text(draw, high[i], 0xffffffff, kDegrees);
    text.draws.push_back(std::move(row));
  }
  return text;
}

Derivation with_draw(const ShownModel& shown, std::int64_t gene, std::int64_t index, double quantile) {
  const GenePosition at = position_of(shown, gene);
  const Variant& variant = variant_of(shown.setup->graph(), shown.derivation.genes[at.gene]);
  if (index < 0 || index >= static_cast<std::int64_t>(variant.draws.size())) {
    throw Error(fmt::format("gene {} has no draw {}", gene, index));
  }
  Derivation changed = shown.derivation;
  const double scaled = std::floor(quantile * 0x1p32);
  changed.draws[at.draw + static_cast<std::size_t>(index)] =
      scaled >= 0x1p32 ? 0xffffffffu : static_cast<std::uint32_t>(scaled);
  return changed;
}

}  // namespace espalier::studio
