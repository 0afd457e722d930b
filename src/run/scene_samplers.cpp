#include "run/scene_samplers.h"

#include <fmt/format.h>

#include "run/initial_length.h"
#include "run/scene_choices.h"

namespace espalier {
namespace {

constexpr Choice<Resampling> kResamplings[] = {{"systematic", Resampling::systematic},
                                               {"stratified", Resampling::stratified},
                                               {"multinomial", Resampling::multinomial},
                                               {"residual", Resampling::residual}};
constexpr Choice<ScoreWeight> kWeights[] = {{"exponential", ScoreWeight::exponential}, {"ratio", ScoreWeight::ratio}};
constexpr Choice<PlaceChoice> kPlaceChoices[] = {{"uniform", PlaceChoice::uniform}, {"level", PlaceChoice::by_level}};

std::string temperature_line(const std::optional<double>& temperature) {
  return temperature ? fmt::format("temperature = {}\n", format_toml(*temperature)) : "";
}

}  // namespace

void read_smc(TomlSection& s, SmcSettings& settings) {
  take(settings.particles, s.whole("particles", 2, 1'000'000));
  take(settings.schedule, s.number("schedule", 1, 100));
  take(settings.most_particles, s.whole("most_particles", 2, 1'000'000));
  take(settings.most_steps, s.whole("steps", 1, 1'000'000));
  take(settings.resampling, s.choice("resampling", kResamplings));
  take(settings.resample_below, s.number("resample_below", 0, 1));
  take(settings.weight, s.choice("weight", kWeights));
  take(settings.temperature, s.number("temperature", 1e-12, 1e12));
  read_initial_length(s, settings.initial_length_min, settings.initial_length_max);
}

void read_rjmcmc(TomlSection& s, RjmcmcSettings& settings) {
  take(settings.chains, s.whole("chains", 1, 100'000));
  take(settings.temperatures, s.whole("temperatures", 1, 100'000));
  take(settings.heat, s.number("heat", 1, 1e6));
  take(settings.weight, s.choice("weight", kWeights));
  take(settings.temperature, s.number("temperature", 1e-12, 1e12));
  take(settings.anneal, s.number("anneal", 1, 100));
  take(settings.anneal_every, s.whole("anneal_every", 1, 1'000'000'000));
  take(settings.anneal_most, s.number("anneal_most", 1, 1e12));
  take(settings.draws, s.number("draws", 0, 1e6));
  take(settings.nudges, s.number("nudges", 0, 1e6));
  take(settings.slots, s.number("slots", 0, 1e6));
  take(settings.jumps, s.number("jumps", 0, 1e6));
  take(settings.choice, s.choice("choice", kPlaceChoices));
  take(settings.delayed, s.boolean("delayed"));
  take(settings.swap_every, s.whole("swap_every", 0, 1'000'000'000));
  read_initial_length(s, settings.initial_length_min, settings.initial_length_max);
}

void read_guided(TomlSection& s, GuidedSettings& settings) {
  take(settings.particles, s.whole("particles", 2, 1'000'000));
  take(settings.last_particles, s.whole("last_particles", 2, 1'000'000));
  take(settings.steps, s.whole("steps", 1, 100'000));
  take(settings.heuristic, s.number("heuristic", 0, 1e6));
  take(settings.heuristic_steps, s.whole("heuristic_steps", 0, 100'000));
  take(settings.temperature, s.number("temperature", 1e-12, 1e12));
  take(settings.resampling, s.choice("resampling", kResamplings));
  take(settings.regrow, s.boolean("regrow"));
  take(settings.regrow_particles, s.whole("regrow_particles", 2, 1'000'000));
  take(settings.regrow_steps, s.whole("regrow_steps", 1, 100'000));
}

void read_hybrid(TomlSection& s, HybridSettings& settings) {
  take(settings.sweeps, s.whole("sweeps", 1, 1000));
  take(settings.start_evaluations, s.whole("start_evaluations", 1, 1'000'000'000'000));
  take(settings.turn, s.whole("turn", 1, 1'000'000'000'000));
}

std::string to_toml(const SmcSettings& s) {
  return fmt::format(
             "particles = {}\nschedule = {}\nmost_particles = {}\nsteps = {}\nresampling = \"{}\"\n"
             "resample_below = {}\nweight = \"{}\"\n",
             s.particles, format_toml(s.schedule), s.most_particles, s.most_steps, word_for(kResamplings, s.resampling),
             format_toml(s.resample_below), word_for(kWeights, s.weight)) +
         temperature_line(s.temperature) + initial_length_line(s.initial_length_min, s.initial_length_max);
}

std::string to_toml(const RjmcmcSettings& s) {
  return fmt::format("chains = {}\ntemperatures = {}\nheat = {}\nweight = \"{}\"\n", s.chains, s.temperatures,
                     format_toml(s.heat), word_for(kWeights, s.weight)) +
         temperature_line(s.temperature) +
         fmt::format("anneal = {}\nanneal_every = {}\nanneal_most = {}\ndraws = {}\nnudges = {}\nslots = {}\n"
                     "jumps = {}\nchoice = \"{}\"\ndelayed = {}\nswap_every = {}\n",
                     format_toml(s.anneal), s.anneal_every, format_toml(s.anneal_most), format_toml(s.draws),
                     format_toml(s.nudges), format_toml(s.slots), format_toml(s.jumps),
                     word_for(kPlaceChoices, s.choice), s.delayed, s.swap_every) +
         initial_length_line(s.initial_length_min, s.initial_length_max);
}

std::string to_toml(const GuidedSettings& s) {
  return fmt::format("particles = {}\nlast_particles = {}\nsteps = {}\nheuristic = {}\nheuristic_steps = {}\n"
                     "temperature = {}\nresampling = \"{}\"\nregrow = {}\nregrow_particles = {}\nregrow_steps = {}\n",
                     s.particles, s.last_particles, s.steps, format_toml(s.heuristic), s.heuristic_steps,
                     format_toml(s.temperature), word_for(kResamplings, s.resampling), s.regrow, s.regrow_particles,
                     s.regrow_steps);
}

std::string to_toml(const HybridSettings& s) {
  return fmt::format("sweeps = {}\nstart_evaluations = {}\nturn = {}\n", s.sweeps, s.start_evaluations, s.turn);
}

}  // namespace espalier
