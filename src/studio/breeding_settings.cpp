#include "studio/breeding_settings.h"

#include <fmt/format.h>

#include "base/error.h"

namespace espalier::studio {
namespace {

template <class T>
void lay_over(std::optional<T>& setting, const std::optional<T>& change) {
  if (change) setting = change;
}

void lay_over(api::GenesisKnobs& knobs, const api::GenesisKnobs& change) {
  lay_over(knobs.crossover, change.crossover);
  lay_over(knobs.mutation, change.mutation);
  lay_over(knobs.gap, change.gap);
  lay_over(knobs.window, change.window);
  lay_over(knobs.selection, change.selection);
  lay_over(knobs.elitist, change.elitist);
  lay_over(knobs.gray, change.gray);
}

void lay_over(api::RoomSettings& settings, const api::RoomSettings& change) {
  lay_over(settings.method, change.method);
  lay_over(settings.mode, change.mode);
  lay_over(settings.population, change.population);
  lay_over(settings.strength, change.strength);
  lay_over(settings.keep, change.keep);
  lay_over(settings.newcomers, change.newcomers);
  lay_over(settings.taste, change.taste);
  lay_over(settings.max_triangles, change.max_triangles);
  lay_over(settings.max_height, change.max_height);
  lay_over(settings.max_spread, change.max_spread);
  if (change.classic && settings.classic) lay_over(*settings.classic, *change.classic);
}

template <class Kind>
Kind read_request_text(std::string_view text, const char* what) {
  std::optional<std::int64_t> number;
  api::Request request = api::read_request(text, number);
  Kind* const found = std::get_if<Kind>(&request);
  if (!found) throw Error(fmt::format("a breeding session is damaged: {}", what));
  return std::move(*found);
}

}  // namespace

api::RoomSettings complete(const api::RoomSettings& asked) {
  const bool classic = asked.method == api::RoomSettingsMethod::classic;
  BreedSettings plain;
  const GenesisSettings genesis = BreedSettings::classic_genesis();
  api::RoomSettings settings;
  settings.method = api::RoomSettingsMethod::free;
  settings.mode = api::RoomSettingsMode::rate_and_edit;
  settings.population = classic ? genesis.population : plain.population;
  settings.strength = plain.strength;
  settings.keep = plain.keep;
  settings.newcomers = plain.newcomers;
  settings.taste = false;
  settings.max_triangles = 0;
  settings.max_height = 0;
  settings.max_spread = 0;
  api::GenesisKnobs knobs;
  knobs.crossover = genesis.crossover;
  knobs.mutation = genesis.mutation;
  knobs.gap = genesis.gap;
  knobs.window = genesis.window;
  knobs.selection = genesis.selection == GenesisSelection::ranking ? api::GenesisKnobsSelection::rank
                                                                   : api::GenesisKnobsSelection::proportional;
  knobs.elitist = genesis.elitism;
  knobs.gray = genesis.gray;
  settings.classic = knobs;
  lay_over(settings, asked);
  breed_settings(settings);
  viability_settings(settings);
  return settings;
}

api::RoomSettings changed(api::RoomSettings settings, const api::RoomSettings& change) {
  if (change.method && change.method != settings.method) {
    throw Error("a session keeps its method: begin another one from its individuals");
  }
  lay_over(settings, change);
  breed_settings(settings);
  viability_settings(settings);
  return settings;
}

bool may_rate(const api::RoomSettings& settings) {
  return settings.mode == api::RoomSettingsMode::rate_and_edit || settings.mode == api::RoomSettingsMode::rate;
}

bool may_edit(const api::RoomSettings& settings) {
  return settings.mode == api::RoomSettingsMode::rate_and_edit || settings.mode == api::RoomSettingsMode::edit;
}

BreedSettings breed_settings(const api::RoomSettings& settings) {
  BreedSettings made;
  made.method = settings.method == api::RoomSettingsMethod::classic ? BreedMethod::classic : BreedMethod::free;
  made.population = static_cast<std::uint32_t>(settings.population.value());
  made.strength = settings.strength.value();
  made.keep = static_cast<std::uint32_t>(settings.keep.value());
  made.newcomers = settings.newcomers.value();
  made.use_ratings = may_rate(settings);
  const api::GenesisKnobs& knobs = settings.classic.value();
  made.genesis.population = made.population;
  made.genesis.crossover = knobs.crossover.value();
  made.genesis.mutation = knobs.mutation.value();
  made.genesis.gap = knobs.gap.value();
  made.genesis.window = static_cast<std::uint32_t>(knobs.window.value());
  made.genesis.selection = knobs.selection == api::GenesisKnobsSelection::rank ? GenesisSelection::ranking
                                                                               : GenesisSelection::proportional;
  made.genesis.elitism = knobs.elitist.value();
  made.genesis.gray = knobs.gray.value();
  validate(made);
  return made;
}

ViabilitySettings viability_settings(const api::RoomSettings& settings) {
  ViabilitySettings made;
  const auto bound = [&](Measure measure, double most) {
    if (most > 0) made.limits[measure].max = most;
  };
  bound(Measure::triangles, static_cast<double>(settings.max_triangles.value()));
  bound(Measure::height, settings.max_height.value());
  bound(Measure::spread, settings.max_spread.value());
  validate(made);
  return made;
}

// Texts are the requests that would bring them about: one reader, and its rules, for both.

std::string settings_text(const api::RoomSettings& settings) {
  return to_text(api::Request(api::SetBreeding{.settings = settings}));
}

api::RoomSettings read_settings(std::string_view text) {
  return complete(read_request_text<api::SetBreeding>(text, "its settings").settings);
}

std::string locked_text(const std::vector<api::DrawPlace>& locked) {
  return to_text(api::Request(api::LockDraws{.draws = locked, .locked = true}));
}

std::vector<api::DrawPlace> read_locked(std::string_view text) {
  return read_request_text<api::LockDraws>(text, "its locks").draws;
}

}  // namespace espalier::studio
