#include "search/ga_variation.h"

#include <algorithm>

#include "base/check.h"
#include "derivation/moves.h"
#include "derivation/nudge.h"

namespace espalier {
namespace {

using Kind = VariationKind;
constexpr Kind kMutations[] = {Kind::grow, Kind::cut, Kind::alter, Kind::nudge};

struct Entry {
  const char* name;
  std::uint64_t GaCounts::*member;
};
constexpr Entry kEntries[] = {
    {"crossed pairs", &GaCounts::crossed_pairs},
    {"crossover tries", &GaCounts::crossover_tries},
    {"failed crossovers", &GaCounts::failed_crossovers},
    {"grown", &GaCounts::grown},
    {"cut", &GaCounts::cut},
    {"altered", &GaCounts::altered},
    {"nudged", &GaCounts::nudged},
    {"mutation fallbacks", &GaCounts::mutation_fallbacks},
    {"failed mutations", &GaCounts::failed_mutations},
    {"redrawn children", &GaCounts::redrawn_children},
    {"redrawn twins", &GaCounts::redrawn_twins},
    {"restarts", &GaCounts::restarts},
    {"kept parents", &GaCounts::kept_parents},
    {"reused scores", &GaCounts::reused_scores},
    {"rejected children", &GaCounts::rejected_children},
    {"rejected starts", &GaCounts::rejected_starts},
    {"copied starts", &GaCounts::copied_starts},
    {"short starts", &GaCounts::short_starts},
    {"joined children", &GaCounts::joined_children},
    {"joined changes", &GaCounts::joined_changes},
    {"better joins", &GaCounts::better_joins},
};
static_assert(sizeof(GaCounts) == sizeof(std::uint64_t) * std::size(kEntries));

}  // namespace

std::vector<NamedCount> named(const GaCounts& counts) {
  std::vector<NamedCount> result;
  for (const Entry& entry : kEntries) result.push_back({entry.name, counts.*entry.member});
  return result;
}

GaCounts counts_from(const std::vector<std::uint64_t>& values) {
  CHECK(values.size() == std::size(kEntries));
  GaCounts counts;
  for (std::size_t i = 0; i < values.size(); ++i) counts.*kEntries[i].member = values[i];
  return counts;
}

void GaVariation::vary(const Individual& parent1, const Individual& parent2, RandomStream& random, Child& child1,
                       Child& child2, GaCounts& counts) const {
  if (random.chance(mutation_)) {
    mutate(parent1, random, child1, counts);
    mutate(parent2, random, child2, counts);
    return;
  }
  const CrossoverSettings crossing = {settings_.crossover, static_cast<int>(settings_.retries),
                                      settings_.replace_probability};
  const CrossoverResult result =
      crossover(graph_, parent1.derivation, parent2.derivation, locks_, locks_, crossing, random,
                child1.individual.derivation, child2.individual.derivation);
  ++counts.crossed_pairs;
  counts.crossover_tries += static_cast<std::uint64_t>(result.tries);
  counts.failed_crossovers += !result.crossed;
  child1.individual.score = parent1.score;
  child2.individual.score = parent2.score;
  child1.scored = child2.scored = !result.crossed;
  child1.kind = child2.kind = Kind::crossover;
}

void GaVariation::set_rates(const VariationRates& rates) {
  mutation_ = 1 - rates.of(VariationKind::crossover);
  std::copy_n(rates.chance.begin(), shares_.size(), shares_.begin());
}

void GaVariation::mutate(const Individual& parent, RandomStream& random, Child& child, GaCounts& counts) const {
  child.individual = parent;
  child.scored = false;
  const Kind drawn = draw_kind(random);
  child.kind = drawn;
  if (apply(drawn, child.individual.derivation, random, counts)) return;
  for (const Kind other : kMutations) {
    if (other == drawn || !(share(other) > 0)) continue;
    if (!apply(other, child.individual.derivation, random, counts)) continue;
    child.kind = other;
    ++counts.mutation_fallbacks;
    return;
  }
  ++counts.failed_mutations;
  child.scored = true;
}

VariationKind GaVariation::draw_kind(RandomStream& random) const {
  double ball = random.next_unit() * (shares_[0] + shares_[1] + shares_[2] + shares_[3]);
  Kind last = Kind::grow;
  for (const Kind kind : kMutations) {
    if (!(share(kind) > 0)) continue;
    if (ball < share(kind)) return kind;
    ball -= share(kind);
    last = kind;
  }
  return last;  // rounding carried the ball past the wheel's end
}

bool GaVariation::apply(Kind kind, Derivation& derivation, RandomStream& random, GaCounts& counts) const {
  const auto tallied = [](bool done, std::uint64_t& count) {
    count += done;
    return done;
  };
  switch (kind) {
    case Kind::grow: return tallied(grow(graph_, derivation, locks_, random), counts.grown);
    case Kind::cut: return tallied(cut(graph_, derivation, locks_, random), counts.cut);
    case Kind::alter: return tallied(alter(graph_, derivation, locks_, random), counts.altered);
    case Kind::nudge: return tallied(nudge(graph_, derivation, locks_, random), counts.nudged);
    case Kind::crossover: break;
  }
  CHECK(false);
}

}  // namespace espalier
