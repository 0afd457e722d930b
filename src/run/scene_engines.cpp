#include "run/scene_engines.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "run/initial_length.h"
#include "run/scene_choices.h"
#include "run/scene_genesis.h"
#include "run/scene_samplers.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

std::string known_engines() {
  std::string names;
  for (const std::string_view name : kEngineNames) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  return names;
}

std::optional<EngineKind> engine_named(std::string_view name) {
  const auto found = std::find(kEngineNames.begin(), kEngineNames.end(), name);
  if (found == kEngineNames.end()) return std::nullopt;
  return static_cast<EngineKind>(found - kEngineNames.begin());
}

/// All but the preset.
void read_ga(TomlSection& s, GaSettings& ga) {
  take(ga.population, s.whole("population", 2, 1'000'000));
  take(ga.elitism, s.whole("elitism", 0, 1'000'000));
  read_initial_length(s, ga.initial_length_min, ga.initial_length_max);
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
  take(ga.adapt, s.boolean("adapt"));
}

/// A table that settings of an engine come from; later ones win.
struct Source {
  TomlValue table;
  std::string path;
};

/// The members that were set on the command line, or those that were not.
TomlValue only(const TomlValue& table, bool set_by_hand) {
  TomlValue result = table;
  std::erase_if(result.members, [&](const auto& member) { return (member.second.line == 0) != set_by_hand; });
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

template <typename Read>
void read_settings(const std::vector<Source>& sources, const std::string& file, Read read) {
  for (const Source& source : sources) {
    TomlSection s(source.table, file, source.path);
    if (source.path == "search") s.member("engine");
    read(s);
    s.finish();
  }
}

EngineKind read_engine(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "search");
  const std::string engine = s.text("engine").value_or("ga");
  const std::optional<EngineKind> kind = engine_named(engine);
  if (!kind) s.fail("engine", fmt::format("must be one of {}, got {}", known_engines(), quote_toml(engine)));
  return *kind;
}

void check_names(const TomlValue& engines, const std::string& file) {
  TomlSection s(engines, file, "engine");
  for (const auto& [name, settings] : engines.members) {
    if (!engine_named(name)) s.fail(name, fmt::format("is no engine; there is {}", known_engines()));
    s.table(name);  // and nothing else
  }
}

// While settings are read, 0 stands for what is not given and follows from others: first individuals are made as the
// genetic algorithm makes them, and numbers of particles and chains draw others along.
void unsettle(SceneSearch& search) {
  for (SmcSettings* smc : {&search.smc, &search.sosmc}) smc->initial_length_min = smc->most_particles = 0;
  search.rjmcmc.initial_length_min = search.rjmcmc.temperatures = 0;
}

template <typename Settings>
void settle_lengths(const GaSettings& ga, Settings& settings) {
  if (settings.initial_length_min > 0) return;
  settings.initial_length_min = ga.initial_length_min, settings.initial_length_max = ga.initial_length_max;
}

void settle(SceneSearch& search) {
  for (SmcSettings* smc : {&search.smc, &search.sosmc}) {
    settle_lengths(search.ga, *smc);
    if (smc->most_particles == 0) smc->most_particles = std::max(SmcSettings().most_particles, smc->particles);
  }
  settle_lengths(search.ga, search.rjmcmc);
  std::uint32_t& temperatures = search.rjmcmc.temperatures;
  if (temperatures == 0) temperatures = std::min(RjmcmcSettings().temperatures, search.rjmcmc.chains);
}

}  // namespace

std::string engine_of_file(const TomlValue& document) {
  const TomlValue* const table = document.find("search");
  const TomlValue* const engine = table ? table->find("engine") : nullptr;
  return engine && engine_named(engine->text) ? engine->text : "ga";
}

void read_search(const TomlValue& document, const std::string& engine_of_file, const std::string& file,
                 SceneSearch& search) {
  TomlSection root(document, file, "");
  const TomlValue nothing;
  const TomlValue* const table = root.table("search");
  const TomlValue* const engines = root.table("engine");
  const TomlValue& common = table ? *table : nothing;
  search.engine = read_engine(common, file);
  if (engines) check_names(*engines, file);
  const auto sources = [&](std::string_view engine) {
    std::vector<Source> all;
    if (engine == engine_of_file) all.push_back({only(common, false), "search"});
    const TomlValue* const own = engines ? engines->find(engine) : nullptr;
    if (own) all.push_back({*own, fmt::format("engine.{}", engine)});
    if (engine == name_of(search.engine)) all.push_back({only(common, true), "search"});
    return all;
  };
  read_preset(sources("ga"), file, search);
  read_settings(sources("ga"), file, [&](TomlSection& s) {
    s.member("preset");
    read_ga(s, search.ga);
  });
  unsettle(search);
  read_settings(sources("smc"), file, [&](TomlSection& s) { read_smc(s, search.smc); });
  read_settings(sources("sosmc"), file, [&](TomlSection& s) { read_smc(s, search.sosmc); });
  read_settings(sources("rjmcmc"), file, [&](TomlSection& s) { read_rjmcmc(s, search.rjmcmc); });
  read_settings(sources("guided"), file, [&](TomlSection& s) { read_guided(s, search.guided); });
  read_settings(sources("genesis"), file, [&](TomlSection& s) { read_genesis(s, search.genesis); });
  read_settings(sources("hybrid"), file, [&](TomlSection& s) { read_hybrid(s, search.hybrid); });
  settle(search);
}

void share_limits(SceneSearch& search) {
  search.smc.genes = search.sosmc.genes = search.rjmcmc.genes = search.guided.genes = search.ga.genes;
}

void validate_search(const SceneSearch& search) {
  HybridSettings hybrid = search.hybrid;
  hybrid.start = search.sosmc, hybrid.middle = search.ga, hybrid.end = search.rjmcmc;
  switch (search.engine) {
    case EngineKind::ga: return validate(search.ga);
    case EngineKind::smc: return validate(search.smc);
    case EngineKind::sosmc: return validate(search.sosmc);
    case EngineKind::rjmcmc: return validate(search.rjmcmc);
    case EngineKind::hybrid: return validate(hybrid);
    case EngineKind::guided: return validate(search.guided);
    case EngineKind::genesis: return validate(search.genesis);
  }
}

std::string search_to_toml(const SceneSearch& search) {
  const GaSettings& ga = search.ga;
  std::string text = fmt::format("[search]\nengine = {}\n\n[engine.ga]\npreset = {}\n",
                                 quote_toml(name_of(search.engine)), quote_toml(search.preset));
  text += fmt::format("population = {}\nelitism = {}\n", ga.population, ga.elitism);
  text += initial_length_line(ga.initial_length_min, ga.initial_length_max);
  text += fmt::format("mutation = {}\ngrow = {}\ncut = {}\nalter = {}\nnudge = {}\n", format_toml(ga.mutation),
                      format_toml(ga.grow), format_toml(ga.cut), format_toml(ga.alter), format_toml(ga.nudge));
  text += fmt::format("first = \"{}\"\nsecond = \"{}\"\ntournament_size = {}\n", word_for(kSelectionSchemes, ga.first),
                      word_for(kSelectionSchemes, ga.second), ga.tournament_size);
  text += fmt::format("crossover = \"{}\"\nretries = {}\nreplace_probability = {}\nreuse_scores = {}\n"
                      "unique = {}\njoin = {}\nadapt = {}\nrestart_after = {}\n",
                      word_for(kCompatibilities, ga.crossover), ga.retries, format_toml(ga.replace_probability),
                      ga.reuse_scores, ga.unique, ga.join, ga.adapt, ga.restart_after);
  return text + fmt::format("\n[engine.smc]\n{}\n[engine.sosmc]\n{}\n[engine.rjmcmc]\n{}\n[engine.hybrid]\n{}"
                            "\n[engine.guided]\n{}\n[engine.genesis]\n{}",
                            to_toml(search.smc), to_toml(search.sosmc), to_toml(search.rjmcmc), to_toml(search.hybrid),
                            to_toml(search.guided), to_toml(search.genesis));
}

}  // namespace espalier
