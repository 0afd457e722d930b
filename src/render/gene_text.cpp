#include "render/gene_text.h"

#include <fmt/format.h>

#include "base/math.h"
#include "render/rule_palette.h"

namespace espalier {
namespace {

// Three digits; -0 as 0.
std::string number(double value) { return fmt::format("{:.3g}", value + 0.0); }

// "k[2]" of "Row.k[2].x": everything that components of one draw share.
std::string_view draw_stem(std::string_view component) {
  component.remove_prefix(component.find('.') + 1);
  return component.substr(0, component.find('.'));
}

}  // namespace

std::string draw_text(const DrawOutline* draw, std::optional<float> value, std::uint32_t quantile,
                      std::string_view degrees) {
  if (!value) return "u " + number(quantile * 0x1p-32);
  if (!draw) return number(*value);
  if (draw->distribution == "chance") return *value == 0 ? "true" : "false";
  if (draw->distribution == "pick") {
    const auto index = static_cast<std::size_t>(*value);
    return index < draw->alternatives.size() ? draw->alternatives[index] : fmt::format("#{}", index + 1);
  }
  if (draw->kind == Kind::angle) return fmt::format("{}{}", number(*value * (180 / kPi)), degrees);
  return number(*value);
}

std::vector<std::string> gene_lines(const GeneratorGraph& graph, const Derivation& derivation,
                                    const GenePosition& position, const GrammarOutline& outline,
                                    std::span<const std::optional<float>> values) {
  const Rule& rule = rule_of(graph, derivation.genes[position.gene]);
  const Variant& variant = variant_of(graph, derivation.genes[position.gene]);
  std::vector<std::string> lines;
  std::string_view last;
  for (std::size_t k = 0; k < variant.draws.size(); ++k) {
    const std::string& name = rule.draws[variant.draws[k]].name;
    const std::size_t at = position.draw + k;
    const bool goes_on = !lines.empty() && draw_stem(name) == last && name.find('.') != name.rfind('.');
    const std::string text =
        draw_text(outline.find_draw(rule.name, name), values[at], derivation.draws[at], "\u00b0");
    if (goes_on) lines.back() += ", " + text;
    else lines.push_back(fmt::format("{} {}", draw_stem(name), text));
    last = draw_stem(name);
  }
  return lines;
}

}  // namespace espalier
