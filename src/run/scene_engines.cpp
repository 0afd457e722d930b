#include "run/scene_engines.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/error.h"
#include "run/scene_choices.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 1> kEngines = {"ga"};

std::string known_engines() {
  std::string names;
  for (const std::string_view name : kEngines) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  return names;
}

bool is_engine(std::string_view name) { return std::find(kEngines.begin(), kEngines.end(), name) != kEngines.end(); }

template <typename T, typename U>
void take(T& place, const std::optional<U>& value) {
  if (value) place = static_cast<T>(*value);
}

// One number, or [from, to].
void read_initial_length(TomlSection& s, GaSettings& ga) {
  const TomlValue* value = s.member("initial_length");
  if (!value) return;
  if (value->kind == TomlValue::Kind::array) {
    const auto range = *s.wholes("initial_length", 2, 1, 1'000'000);
    ga.initial_length_min = static_cast<std::uint32_t>(range[0]);
    ga.initial_length_max = static_cast<std::uint32_t>(range[1]);
  } else {
    ga.initial_length_min = ga.initial_length_max =
        static_cast<std::uint32_t>(*s.whole("initial_length", 1, 1'000'000));
  }
}

/// All but the preset.
void read_ga(TomlSection& s, GaSettings& ga) {
  take(ga.population, s.whole("population", 2, 1'000'000));
  take(ga.elitism, s.whole("elitism", 0, 1'000'000));
  read_initial_length(s, ga);
  take(ga.mutation, s.number("mutation", 0, 1));
  take(ga.grow, s.number("grow", 0, 1e6));
  take(ga.cut, s.number("cut", 0, 1e6));
  take(ga.alter, s.number("alter", 0, 1e6));
  take(ga.nudge, s.number("nudge", 0, 1e6));
  take(ga.first, s.choice("first", kSelectionSchemes));
  take(ga.second, s.choice("second", kSelectionSchemes));
  take(ga.tournament_size, s.whole("tournament_size", 1, 10'000));
  take(ga.crossover, s.choice("crossover", kCompatibilities));
  take(ga.retries, s.whole("retries", 1, 1000));
  take(ga.replace_probability, s.number("replace_probability", 0, 1));
  take(ga.reuse_scores, s.boolean("reuse_scores"));
  take(ga.restart_after, s.whole("restart_after", 0, 1'000'000'000));
  take(ga.unique, s.boolean("unique"));
  take(ga.join, s.boolean("join"));
}

/// A table that settings of an engine come from; later ones win.
struct Source {
  TomlValue table;
  std::string path;
};

/// The members that were set on the command line.
TomlValue set_by_hand(const TomlValue& table) {
  TomlValue result = table;
  std::erase_if(result.members, [](const auto& member) { return member.second.line != 0; });
  return result;
}

void read_preset(const std::vector<Source>& sources, const std::string& file, SceneSearch& search) {
  for (const Source& source : sources) {
    TomlSection s(source.table, file, source.path);
    const auto preset = s.text("preset");
    if (!preset) continue;
    try {
      search.ga = ga_preset(*preset);
      search.preset = *preset;
    } catch (const Error& error) {
      s.fail("preset", std::string(error.what()).substr(std::string_view("preset ").size()));
    }
  }
}

void read_ga_settings(const std::vector<Source>& sources, const std::string& file, SceneSearch& search) {
  read_preset(sources, file, search);
  for (const Source& source : sources) {
    TomlSection s(source.table, file, source.path);
    if (source.path == "search") s.member("engine");
    s.member("preset");
    read_ga(s, search.ga);
    s.finish();
  }
}

std::string read_engine(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "search");
  const std::string engine = s.text("engine").value_or("ga");
  if (!is_engine(engine)) s.fail("engine", fmt::format("must be one of {}, got {}", known_engines(), quote_toml(engine)));
  return engine;
}

void check_names(const TomlValue& engines, const std::string& file) {
  TomlSection s(engines, file, "engine");
  for (const auto& [name, settings] : engines.members) {
    if (!is_engine(name)) s.fail(name, fmt::format("is no engine; there is {}", known_engines()));
    s.table(name);  // and nothing else
  }
}

/// What [search] says is meant for the engine that is chosen.
std::vector<Source> sources_for(const std::string& engine, const std::string& chosen, const TomlValue& common,
                                const TomlValue* engines) {
  const TomlValue* const own = engines ? engines->find(engine) : nullptr;
  std::vector<Source> sources;
  if (engine == chosen) sources.push_back({common, "search"});
  if (own) sources.push_back({*own, "engine." + engine});
  if (own && engine == chosen) sources.push_back({set_by_hand(common), "search"});
  return sources;
}

}  // namespace

void read_search(const TomlValue& document, const std::string& file, SceneSearch& search) {
  TomlSection root(document, file, "");
  const TomlValue nothing;
  const TomlValue* const table = root.table("search");
  const TomlValue* const engines = root.table("engine");
  const TomlValue& common = table ? *table : nothing;
  search.engine = read_engine(common, file);
  if (engines) check_names(*engines, file);
  read_ga_settings(sources_for("ga", search.engine, common, engines), file, search);
}

std::string search_to_toml(const SceneSearch& search) {
  const GaSettings& ga = search.ga;
  std::string text = fmt::format("[search]\nengine = {}\n\n[engine.ga]\npreset = {}\n", quote_toml(search.engine),
                                 quote_toml(search.preset));
  text += fmt::format("population = {}\nelitism = {}\n", ga.population, ga.elitism);
  text += ga.initial_length_min == ga.initial_length_max
              ? fmt::format("initial_length = {}\n", ga.initial_length_min)
              : fmt::format("initial_length = [{}, {}]\n", ga.initial_length_min, ga.initial_length_max);
  text += fmt::format("mutation = {}\ngrow = {}\ncut = {}\nalter = {}\nnudge = {}\n", format_toml(ga.mutation),
                      format_toml(ga.grow), format_toml(ga.cut), format_toml(ga.alter), format_toml(ga.nudge));
  text += fmt::format("first = \"{}\"\nsecond = \"{}\"\ntournament_size = {}\n", word_for(kSelectionSchemes, ga.first),
                      word_for(kSelectionSchemes, ga.second), ga.tournament_size);
  return text + fmt::format("crossover = \"{}\"\nretries = {}\nreplace_probability = {}\nreuse_scores = {}\n"
                            "unique = {}\njoin = {}\nrestart_after = {}\n",
                            word_for(kCompatibilities, ga.crossover), ga.retries, format_toml(ga.replace_probability),
                            ga.reuse_scores, ga.unique, ga.join, ga.restart_after);
}

}  // namespace espalier
