#include "breed/variation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "breed/alignment.h"
#include "derivation/crossover.h"
#include "derivation/moves.h"
#include "search/genesis_encoding.h"

namespace espalier {
namespace {

constexpr double kOne = 0x1.0p32;

/// Mean 0, standard deviation 1, within 3.5 of 0: the sum of four uniform numbers.
double bell(RandomStream& random) {
  double sum = -2;
  for (int i = 0; i < 4; ++i) sum += random.next_unit();
  return sum * 1.7320508075688772;
}

std::uint32_t reflected(double u) {
  if (u < 0) u = -u - 1;
  if (u >= kOne) u = 2 * kOne - 1 - u;
  return static_cast<std::uint32_t>(std::clamp(u, 0.0, kOne - 1));
}

/// Of the plateau of a value.
std::uint32_t middle_of(std::uint64_t value, std::uint32_t values) {
  return static_cast<std::uint32_t>(((value * 2 + 1) << 31) / values);
}

std::uint32_t other_value(std::uint32_t quantile, std::uint32_t values, double scale, RandomStream& random) {
  if (values < 2) return quantile;
  const auto n = static_cast<std::int64_t>(values);
  const std::int64_t value = static_cast<std::int64_t>((std::uint64_t{quantile} * values) >> 32);
  std::int64_t step = std::llround(bell(random) * scale * static_cast<double>(n));
  if (step == 0) step = random.chance(0.5) ? 1 : -1;
  std::int64_t moved = value + step;
  if (moved < 0) moved = -moved;
  if (moved >= n) moved = 2 * (n - 1) - moved;
  moved = std::clamp<std::int64_t>(moved, 0, n - 1);
  if (moved == value) moved = value > 0 ? value - 1 : value + 1;
  return middle_of(static_cast<std::uint64_t>(moved), values);
}

/// The draws of a derivation in order, with what they are.
std::vector<const DrawComponent*> components_of(const GeneratorGraph& graph, const Derivation& derivation) {
  std::vector<const DrawComponent*> components;
  for (const GeneRecord& gene : derivation.genes) {
    const Rule& rule = rule_of(graph, gene);
    for (const std::uint16_t draw : rule.variants[gene.variant].draws) components.push_back(&rule.draws[draw]);
  }
  return components;
}

/// Moves each free draw with this chance, one at least where there is one.
void move_draws(const GeneratorGraph& graph, Derivation& child, const Held& held, double chance, double scale,
                RandomStream& random) {
  const std::vector<const DrawComponent*> components = components_of(graph, child);
  const std::vector<std::uint8_t> is_held = held_draws(graph, child, held);
  std::vector<std::uint32_t> free;
  for (std::uint32_t i = 0; i < is_held.size(); ++i) {
    if (!is_held[i]) free.push_back(i);
  }
  if (free.empty()) return;
  const auto move = [&](std::uint32_t i) {
    child.draws[i] = step_quantile(child.draws[i], *components[i], scale, random);
  };
  bool moved = false;
  for (const std::uint32_t i : free) {
    if (!random.chance(chance)) continue;
    move(i);
    moved = true;
  }
  if (!moved) move(free[random.below(static_cast<std::uint32_t>(free.size()))]);
}

/// One gene comes, goes or changes; false where none can.
bool change_structure(const GeneratorGraph& graph, Derivation& child, const Held& held, RandomStream& random) {
  const Derivation before = child;
  const std::uint32_t first = random.below(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t kind = (first + i) % 3;
    const bool changed = kind == 0   ? grow(graph, child, held.genes, random)
                         : kind == 1 ? cut(graph, child, held.genes, random)
                                     : alter(graph, child, held.genes, random);
    if (!changed) continue;
    keep_held_draws(graph, before, held, child);
    return true;
  }
  return false;
}

std::size_t heaviest(std::span<const double> weights) {
  return static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
}

/// The weighted mean of one draw of several parents; parent `base` is what circular ones are measured from.
std::uint32_t mixed(const DrawComponent& draw, std::span<const std::uint32_t> quantiles,
                    std::span<const double> weights, std::size_t base) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (draw.shape == DrawShape::circular) {
    double step = 0;
    for (std::size_t i = 0; i < quantiles.size(); ++i) {
      step += weights[i] / sum * static_cast<std::int32_t>(quantiles[i] - quantiles[base]);
    }
    return quantiles[base] + static_cast<std::uint32_t>(std::llround(step));
  }
  if (draw.shape == DrawShape::discrete && draw.values > 1) {
    double value = 0;
    for (std::size_t i = 0; i < quantiles.size(); ++i) {
      value += weights[i] / sum * static_cast<double>((std::uint64_t{quantiles[i]} * draw.values) >> 32);
    }
    const auto nearest = static_cast<std::uint64_t>(std::llround(value));
    return middle_of(nearest, draw.values);
  }
  double u = 0;
  for (std::size_t i = 0; i < quantiles.size(); ++i) u += weights[i] / sum * quantiles[i];
  return static_cast<std::uint32_t>(std::clamp(std::floor(u + 0.5), 0.0, kOne - 1));
}

std::uint32_t moved_by(std::uint32_t quantile, const DrawComponent& draw, std::uint32_t to, std::uint32_t from,
                       double amount) {
  if (draw.shape == DrawShape::circular) {
    return quantile + static_cast<std::uint32_t>(std::llround(amount * static_cast<std::int32_t>(to - from)));
  }
  if (draw.shape == DrawShape::discrete && draw.values > 1) {
    const std::int64_t n = draw.values;
    const auto value = [&](std::uint32_t q) {
      return static_cast<std::int64_t>((std::uint64_t{q} * draw.values) >> 32);
    };
    const std::int64_t step = std::llround(amount * static_cast<double>(value(to) - value(from)));
    const std::int64_t moved = std::clamp<std::int64_t>(value(quantile) + step, 0, n - 1);
    return moved == value(quantile) ? quantile : middle_of(static_cast<std::uint64_t>(moved), draw.values);
  }
  const double moved = quantile + amount * (static_cast<double>(to) - from);
  return static_cast<std::uint32_t>(std::clamp(std::floor(moved + 0.5), 0.0, kOne - 1));
}

}  // namespace

std::uint32_t step_quantile(std::uint32_t quantile, const DrawComponent& draw, double scale, RandomStream& random) {
  if (draw.shape == DrawShape::discrete) return other_value(quantile, draw.values, scale, random);
  const double step = bell(random) * scale * kOne;
  if (draw.shape == DrawShape::circular) return quantile + static_cast<std::uint32_t>(std::llround(step));
  return reflected(quantile + step);
}

Derivation mutate(const GeneratorGraph& graph, const Derivation& parent, const Held& held, double strength,
                  RandomStream& random) {
  Derivation child = parent;
  // Single genes of hundreds of draws change in a few tenths of them at most; GenTree's 13 in one to nine.
  constexpr int kMostStructure = 8;
  for (int i = 0; i < kMostStructure && random.chance(0.2 + 0.6 * strength); ++i) {
    if (!change_structure(graph, child, held, random)) break;
  }
  if (child == parent || random.chance(0.7)) {
    move_draws(graph, child, held, 0.7 * strength, 0.03 + 0.3 * strength, random);
  }
  return child;
}

Derivation cross(const GeneratorGraph& graph, const Derivation& first, const Derivation& second, const Held& held,
                 RandomStream& random) {
  Derivation child = first;
  const bool draw_by_draw = why_not_start_draws(graph).empty();
  const std::vector<std::uint8_t> is_held = held_draws(graph, child, held);
  for (const AlignedGene& gene : align(graph, first, second)) {
    bool from_second = random.chance(0.5);
    for (std::uint32_t k = 0; k < gene.draws; ++k) {
      if (draw_by_draw) from_second = random.chance(0.5);
      const std::uint32_t at = gene.first.draw + k;
      if (from_second && !is_held[at]) child.draws[at] = second.draws[gene.second.draw + k];
    }
  }
  if (draw_by_draw || !random.chance(0.75)) return child;
  Derivation crossed, rest;
  crossover(graph, child, second, held.genes, {}, {}, random, crossed, rest);
  keep_held_draws(graph, first, held, crossed);
  return crossed;
}

Derivation blend(const GeneratorGraph& graph, std::span<const Derivation* const> parents,
                 std::span<const double> weights, const Held& held) {
  CHECK(parents.size() >= 2 && parents.size() <= 3 && weights.size() == parents.size());
  CHECK(weights[heaviest(weights)] > 0);
  // Genes that are held must stand where the first parent has them.
  const std::size_t base = held.genes.empty() ? heaviest(weights) : 0;
  Derivation child = *parents[base];
  // How many parents have a draw of the base, and where.
  std::vector<std::vector<std::uint32_t>> at(parents.size(), std::vector<std::uint32_t>(child.draws.size()));
  std::vector<std::size_t> owners(child.draws.size());
  for (std::size_t p = 0; p < parents.size(); ++p) {
    for (const AlignedGene& gene : align(graph, child, *parents[p])) {
      for (std::uint32_t k = 0; k < gene.draws; ++k) {
        at[p][gene.first.draw + k] = gene.second.draw + k;
        ++owners[gene.first.draw + k];
      }
    }
  }
  const std::vector<const DrawComponent*> components = components_of(graph, child);
  const std::vector<std::uint8_t> is_held = held_draws(graph, child, held);
  std::vector<std::uint32_t> quantiles(parents.size());
  for (std::size_t draw = 0; draw < child.draws.size(); ++draw) {
    if (owners[draw] < parents.size() || (base == 0 && is_held[draw])) continue;
    for (std::size_t p = 0; p < parents.size(); ++p) quantiles[p] = parents[p]->draws[at[p][draw]];
    child.draws[draw] = mixed(*components[draw], quantiles, weights, base);
  }
  keep_held_draws(graph, *parents[0], held, child);
  return child;
}

void lean(const GeneratorGraph& graph, const Derivation& toward, const Derivation& away, double amount,
          const Held& held, Derivation& child) {
  constexpr std::uint32_t kNowhere = 0xffffffff;
  std::vector<std::uint32_t> at(child.draws.size(), kNowhere);
  for (const AlignedGene& gene : align(graph, child, away)) {
    for (std::uint32_t k = 0; k < gene.draws; ++k) at[gene.first.draw + k] = gene.second.draw + k;
  }
  const std::vector<const DrawComponent*> components = components_of(graph, child);
  const std::vector<std::uint8_t> is_held = held_draws(graph, child, held);
  for (const AlignedGene& gene : align(graph, child, toward)) {
    for (std::uint32_t k = 0; k < gene.draws; ++k) {
      const std::uint32_t draw = gene.first.draw + k;
      if (at[draw] == kNowhere || is_held[draw]) continue;
      const std::uint32_t to = toward.draws[gene.second.draw + k], from = away.draws[at[draw]];
      child.draws[draw] = moved_by(child.draws[draw], *components[draw], to, from, amount);
    }
  }
}

Derivation make_sibling(const GeneratorGraph& graph, const Derivation& favourite, const Held& held, double strength,
                        RandomStream& random) {
  Derivation child = favourite;
  if (strength > 0.5 && random.chance(2 * strength - 1)) change_structure(graph, child, held, random);
  move_draws(graph, child, held, 1, 0.02 + 0.2 * strength, random);
  child.detail_seed = random.next_u64();
  return child;
}

}  // namespace espalier
