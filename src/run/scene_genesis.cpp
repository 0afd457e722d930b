#include "run/scene_genesis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "run/scene_choices.h"

namespace espalier {
namespace {

constexpr Choice<GenesisSelection> kGenesisSelections[] = {{"proportional", GenesisSelection::proportional},
                                                           {"ranking", GenesisSelection::ranking}};
constexpr std::size_t kMostGenes = 10'000;

}  // namespace

void read_genesis(TomlSection& s, GenesisSettings& settings) {
  take(settings.population, s.whole("population", 2, 100'000));
  take(settings.crossover, s.number("crossover", 0, 1));
  take(settings.mutation, s.number("mutation", 0, 1));
  take(settings.gap, s.number("gap", 1e-6, 1));
  take(settings.selection, s.choice("selection", kGenesisSelections));
  take(settings.window, s.whole("window", 0, 1'000'000));
  take(settings.rank_min, s.number("rank_min", 0, 1));
  take(settings.elitism, s.boolean("elitism"));
  take(settings.gray, s.boolean("gray"));
  take(settings.idle, s.whole("idle", 1, 1000));
  if (const TomlValue* const bits = s.member("bits")) {
    if (bits->items.size() > kMostGenes) s.fail("bits", fmt::format("must be at most {} numbers", kMostGenes));
    const auto read = s.wholes("bits", bits->items.size(), 1, 32);
    settings.bits.assign(read->begin(), read->end());
  }
}

std::string to_toml(const GenesisSettings& s) {
  std::string text = fmt::format(
      "population = {}\ncrossover = {}\nmutation = {}\ngap = {}\nselection = \"{}\"\nwindow = {}\nrank_min = {}\n"
      "elitism = {}\ngray = {}\nidle = {}\n",
      s.population, format_toml(s.crossover), format_toml(s.mutation), format_toml(s.gap),
      word_for(kGenesisSelections, s.selection), s.window, format_toml(s.rank_min), s.elitism, s.gray, s.idle);
  if (!s.bits.empty()) text += fmt::format("bits = [{}]\n", fmt::join(s.bits, ", "));
  return text;
}

}  // namespace espalier
