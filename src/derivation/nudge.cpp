#include "derivation/nudge.h"

#include <algorithm>
#include <vector>

#include "derivation/lock_map.h"
#include "derivation/position.h"

namespace espalier {
namespace {

constexpr std::uint32_t kScales = 9;  // 1/2 .. 1/512
constexpr std::int64_t kOne = std::int64_t{1} << 32;

struct Place {
  std::uint32_t first_draw = 0;
  const Rule* rule = nullptr;
  const Variant* variant = nullptr;
};

struct Workspace {
  LockMap locks;
  std::vector<Place> places;
};

/// In units of 2^-32; triangular over (-scale, scale), never 0.
std::int64_t draw_step(const DrawComponent& component, RandomStream& random) {
  const std::uint32_t halvings = 1 + random.below(kScales);
  std::int64_t step = 0;
  while (step == 0) {  // forwards and backwards alike: samplers count on it
    const auto a = static_cast<std::int64_t>(random.next_u32()), b = static_cast<std::int64_t>(random.next_u32());
    step = (a - b) / (std::int64_t{1} << halvings);
  }
  if (component.shape == DrawShape::discrete && component.values > 1) {
    const std::int64_t plateau = kOne / component.values;
    step = step < 0 ? std::min(step, -plateau) : std::max(step, plateau);
  }
  return step;
}

std::uint32_t moved(std::uint32_t quantile, std::int64_t step, DrawShape shape) {
  std::int64_t u = static_cast<std::int64_t>(quantile) + step;
  if (shape == DrawShape::circular) return static_cast<std::uint32_t>(u);
  if (u < 0) u = -u - 1;
  if (u >= kOne) u = 2 * kOne - 1 - u;
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(u, 0, kOne - 1));
}

void nudge_one(const Place& place, Derivation& derivation, RandomStream& random) {
  const std::uint32_t which = random.below(static_cast<std::uint32_t>(place.variant->draws.size()));
  const DrawComponent& component = place.rule->draws[place.variant->draws[which]];
  std::uint32_t& quantile = derivation.draws[place.first_draw + which];
  quantile = moved(quantile, draw_step(component, random), component.shape);
}

}  // namespace

bool nudge(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random) {
  static thread_local Workspace work;
  work.locks.reset(graph, derivation, locks);
  work.places.clear();
  // Own draws stand in gene order, so a running sum finds them.
  std::uint32_t draw = 0;
  for (std::uint32_t g = 0; g < derivation.size(); ++g) {
    const Rule& rule = rule_of(graph, derivation.genes[g]);
    const Variant& variant = rule.variants[derivation.genes[g].variant];
    const auto count = static_cast<std::uint32_t>(variant.draws.size());
    if (count > 0 && !(work.locks.held(g) & LockMap::kDraws)) work.places.push_back({draw, &rule, &variant});
    draw += count;
  }
  if (work.places.empty()) return false;
  nudge_one(work.places[random.below(static_cast<std::uint32_t>(work.places.size()))], derivation, random);
  return true;
}

void nudge_gene(const GeneratorGraph& graph, Derivation& derivation, std::uint32_t gene, RandomStream& random) {
  static thread_local GenePath path;
  locate(graph, derivation, gene, path);
  const Rule& rule = rule_of(graph, derivation.genes[gene]);
  nudge_one({path.gene.draw, &rule, &rule.variants[derivation.genes[gene].variant]}, derivation, random);
}

}  // namespace espalier
