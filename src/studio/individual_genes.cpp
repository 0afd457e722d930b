#include "studio/individual_genes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/locks.h"
#include "derivation/position.h"
#include "grammar/outline.h"
#include "model/draw_values.h"
#include "render/gene_text.h"

namespace espalier::studio {
namespace {

constexpr const char* kDegrees = "deg";  // as the language writes them
/// What a draw's range comes to is asked gene by gene, of the whole derivation; beyond so much work ranges are left
/// out.
constexpr std::size_t kMostRangeWork = 2'000'000;

struct GeneDraws {
  std::uint32_t gene = 0;
  std::size_t first = 0;  // of its draws
};

/// The genes that have draws, as many as may be told of.
std::vector<GeneDraws> genes_with_draws(const GeneratorGraph& graph, const Derivation& derivation, bool& truncated) {
  std::vector<GeneDraws> genes;
  std::size_t first = 0;
  truncated = false;
  for (std::uint32_t gene = 0; gene < derivation.size() && !truncated; ++gene) {
    const std::size_t count = variant_of(graph, derivation.genes[gene]).draws.size();
    truncated = first + count > kMostAskedDraws;
    if (count > 0 && !truncated) genes.push_back({gene, first});
    first += count;
  }
  return genes;
}

}  // namespace

std::vector<api::BredGene> individual_genes(const Setup& setup, const Derivation& derivation, const Held& held,
                                            bool& truncated) {
  const GeneratorGraph& graph = setup.graph();
  const std::vector<GeneDraws> genes = genes_with_draws(graph, derivation, truncated);
  const GrammarOutline outline = outline_of(*setup.grammar.checked, setup.grammar.sources);
  const std::vector<std::uint8_t> locked = held_draws(graph, derivation, held);
  const std::vector<std::optional<float>> values = draw_values(graph, derivation);
  const bool ranges = genes.size() * derivation.size() <= kMostRangeWork;
  Derivation ends = derivation;
  std::vector<api::BredGene> texts;
  for (const GeneDraws& at : genes) {
    const Rule& rule = rule_of(graph, derivation.genes[at.gene]);
    const Variant& variant = variant_of(graph, derivation.genes[at.gene]);
    const auto begin = ends.draws.begin() + static_cast<std::ptrdiff_t>(at.first);
    const auto values_at = [&](std::uint32_t quantile) {
      std::fill_n(begin, variant.draws.size(), quantile);
      return ranges ? draw_values(graph, ends) : std::vector<std::optional<float>>(values.size());
    };
    const std::vector<std::optional<float>> low = values_at(0), high = values_at(0xffffffff);
    std::copy_n(derivation.draws.begin() + static_cast<std::ptrdiff_t>(at.first), variant.draws.size(), begin);
    api::BredGene text;
    text.gene = at.gene;
    text.rule = rule.name;
    text.path = format_gene_path(graph, gene_path(graph, derivation, at.gene));
    for (std::size_t k = 0; k < variant.draws.size(); ++k) {
      const DrawComponent& component = rule.draws[variant.draws[k]];
      const DrawOutline* const draw = outline.find_draw(rule.name, component.name);
      const std::size_t i = at.first + k;
      api::Draw row;
      row.name = component.name.substr(component.name.find('.') + 1);
      row.index = variant.draws[k];
      row.quantile = derivation.draws[i] * 0x1p-32;
      row.value = draw_text(draw, values[i], derivation.draws[i], kDegrees);
      if (low[i]) row.low = draw_text(draw, low[i], 0, kDegrees);
      if (high[i]) row.high = draw_text(draw, high[i], 0xffffffff, kDegrees);
      if (locked[i]) text.locked.push_back(row.index);
      text.draws.push_back(std::move(row));
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

void set_draw(const GeneratorGraph& graph, Derivation& derivation, const api::DrawSetting& setting) {
  if (setting.gene < 0 || setting.gene >= static_cast<std::int64_t>(derivation.size())) {
    throw Error(fmt::format("the individual has no gene {}", setting.gene));
  }
  const auto gene = static_cast<std::uint32_t>(setting.gene);
  const std::vector<std::uint16_t>& draws = variant_of(graph, derivation.genes[gene]).draws;
  const auto found = std::find(draws.begin(), draws.end(), setting.index);
  if (found == draws.end()) throw Error(fmt::format("gene {} has no draw {}", setting.gene, setting.index));
  if (!(setting.quantile >= 0 && setting.quantile <= 1)) throw Error("a quantile must be 0 .. 1");
  GenePath path;
  locate(graph, derivation, gene, path);
  const double scaled = std::floor(setting.quantile * 0x1p32);
  derivation.draws[path.gene.draw + static_cast<std::size_t>(found - draws.begin())] =
      scaled >= 0x1p32 ? 0xffffffffu : static_cast<std::uint32_t>(scaled);
}

void require_place(const GeneratorGraph& graph, const api::DrawPlace& place) {
  Held held;
  held.draws.push_back(
      {parse_gene_path(graph, place.path), static_cast<std::uint16_t>(std::min<std::int64_t>(place.index, 0xffff))});
  validate(graph, held);
}

}  // namespace espalier::studio
