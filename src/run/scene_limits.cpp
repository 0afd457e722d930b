#include "run/scene_limits.h"

#include <fmt/format.h>

#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr double kMostWeight = 1e9;
constexpr Choice<int> kPresets[] = {{"length-2016", 0}, {"length-2017", 0}};

void read_bounds(TomlSection& s, const MeasureFacts& facts, Limit& limit) {
  const auto read = [&](const char* key) -> std::optional<double> {
    if (!facts.whole) return s.number(key, facts.lowest, facts.highest);
    const auto low = static_cast<std::uint64_t>(facts.lowest), high = static_cast<std::uint64_t>(facts.highest);
    const std::optional<std::uint64_t> whole = s.whole(key, low, high);
    return whole ? std::optional<double>(static_cast<double>(*whole)) : std::nullopt;
  };
  if (const auto min = read("min")) limit.min = min;
  if (const auto max = read("max")) limit.max = max;
  if (limit.min && limit.max && *limit.min > *limit.max) {
    s.fail("max", fmt::format("must be at least {} = {}, got {}", s.path_of("min"), *limit.min, *limit.max));
  }
}

// `preset`: what the ramp is where the scene does not say.
void read_ramp(TomlSection& s, const MeasureFacts& facts, const Limit& preset, Limit& limit) {
  const double most = facts.whole ? 1e9 : facts.highest;
  const auto from = s.number("from", 0, most), to = s.number("to", 0, most);
  const auto weight = s.number("weight", 0, kMostWeight);
  const bool has_preset = preset.weight > 0;
  limit.from = from.value_or(preset.from);
  limit.to = to.value_or(preset.to);
  limit.weight = weight.value_or(preset.weight);
  if ((from || to) && !weight && !has_preset) {
    s.fail(from ? "from" : "to", fmt::format("needs {} beside it: a ramp without weight does nothing",
                                             s.path_of("weight")));
  }
  if (!(limit.weight > 0)) return;
  if (!to && !has_preset) s.fail("weight", fmt::format("needs {} beside it: the end of the ramp", s.path_of("to")));
  if (limit.from == limit.to) {
    s.fail("to", fmt::format("must differ from {} = {}, got {}", s.path_of("from"), limit.from, limit.to));
  }
}

}  // namespace

void read_limits(const TomlValue& table, const std::string& file, Scene& scene) {
  TomlSection limits(table, file, "limits");
  if (limits.choice("preset", kPresets)) scene.limits.preset = table.find("preset")->text;
  for (const Measure measure : kAllMeasures) {
    const MeasureFacts& facts = facts_of(measure);
    const TomlValue* given = limits.table(facts.name);
    const bool genes = measure == Measure::genes;
    if (!given && !genes) continue;
    const TomlValue nothing;
    TomlSection s(given ? *given : nothing, file, fmt::format("limits.{}", facts.name));
    GeneLimits& hard = scene.search.ga.genes;
    Limit limit, preset;
    if (genes) limit.min = hard.min, limit.max = hard.max;
    read_bounds(s, facts, limit);
    if (genes) {
      hard = {static_cast<std::uint32_t>(*limit.min), static_cast<std::uint32_t>(*limit.max)};
      if (!scene.limits.preset.empty()) preset = length_term(scene.limits.preset, *limit.min, *limit.max);
      limit.min = limit.max = std::nullopt;
    }
    read_ramp(s, facts, preset, limit);
    s.finish();
    scene.limits.of[measure] = limit;
  }
  limits.finish();
}

std::string limits_to_toml(const Scene& scene) {
  std::string text;
  if (!scene.limits.preset.empty()) text = fmt::format("[limits]\npreset = {}\n\n", quote_toml(scene.limits.preset));
  const Limits limits = limits_of(scene);
  for (const Measure measure : kAllMeasures) {
    const Limit& limit = limits[measure];
    if (limit == Limit{}) continue;
    const MeasureFacts& facts = facts_of(measure);
    const auto bound = [&](const char* key, const std::optional<double>& value) {
      if (!value) return;
      text += fmt::format("{} = {}\n", key, facts.whole ? fmt::format("{:.0f}", *value) : format_toml(*value));
    };
    text += fmt::format("{}[limits.{}]\n", measure == Measure::genes ? "" : "\n", facts.name);
    bound("min", limit.min);
    bound("max", limit.max);
    text += fmt::format("from = {}\nto = {}\nweight = {}\n", format_toml(limit.from), format_toml(limit.to),
                        format_toml(limit.weight));
  }
  text.pop_back();  // the caller ends the line
  return text;
}

Limits limits_of(const Scene& scene) {
  Limits limits = scene.limits.of;
  limits[Measure::genes].min = scene.search.ga.genes.min;
  limits[Measure::genes].max = scene.search.ga.genes.max;
  return limits;
}

}  // namespace espalier
