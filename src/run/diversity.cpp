#include "run/diversity.h"

#include <algorithm>

#include "base/hash.h"

namespace espalier {
namespace {

// Of two quantiles, in [0, 1].
double difference(std::uint32_t a, std::uint32_t b, DrawShape shape) {
  const std::uint32_t gap = a > b ? a - b : b - a;
  if (shape != DrawShape::circular) return gap * 0x1p-32;
  return std::min(gap, 0u - gap) * 0x1p-31;  // half a turn is as far as it goes
}

double agreement(const GeneratorGraph& graph, const DerivationSketch& a, const DerivationSketch::Gene& in_a,
                 const DerivationSketch& b, const DerivationSketch::Gene& in_b) {
  const Rule& rule = graph.rule_of(in_a.edge);
  const std::vector<std::uint16_t>& draws = rule.variants[in_a.variant].draws;
  if (draws.empty()) return 1;
  double sum = 0;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    sum += difference(a.draws[in_a.draw + k], b.draws[in_b.draw + k], rule.draws[draws[k]].shape);
  }
  return 1 - sum / static_cast<double>(draws.size());
}

}  // namespace

void make_sketch(const GeneratorGraph& graph, const Derivation& derivation, GeneSweep& sweep,
                 DerivationSketch& sketch) {
  sketch.genes.clear();
  sketch.draws = derivation.draws;
  for (sweep.begin(graph, derivation); sweep.next();) {
    std::uint64_t place = 0;
    if (sweep.parent() != GeneSweep::kNoParent) {
      place = key_below(sketch.genes[sweep.parent()].place, sweep.parent_slot());
    }
    const GeneRecord& gene = sweep.gene();
    sketch.genes.push_back({key_below(place, gene.variant), sweep.position().draw, gene.edge, gene.variant});
  }
  std::sort(sketch.genes.begin(), sketch.genes.end(),
            [](const DerivationSketch::Gene& a, const DerivationSketch::Gene& b) { return a.place < b.place; });
}

double distance(const GeneratorGraph& graph, const DerivationSketch& a, const DerivationSketch& b) {
  double shared = 0;
  std::size_t places = 0;
  auto i = a.genes.begin();
  auto j = b.genes.begin();
  while (i != a.genes.end() && j != b.genes.end()) {
    ++places;
    if (i->place < j->place) {
      ++i;
    } else if (j->place < i->place) {
      ++j;
    } else {
      // Equal hashes of unequal places are possible, though one in 2^64.
      if (i->edge == j->edge && i->variant == j->variant) shared += agreement(graph, a, *i, b, *j);
      ++i, ++j;
    }
  }
  places += static_cast<std::size_t>(a.genes.end() - i) + static_cast<std::size_t>(b.genes.end() - j);
  return places == 0 ? 0 : std::max(0.0, 1 - shared / static_cast<double>(places));
}

double distance(const GeneratorGraph& graph, const Derivation& a, const Derivation& b) {
  GeneSweep sweep;
  DerivationSketch of_a, of_b;
  make_sketch(graph, a, sweep, of_a);
  make_sketch(graph, b, sweep, of_b);
  return distance(graph, of_a, of_b);
}

DiverseArchive::DiverseArchive(const GeneratorGraph& graph, std::size_t size, double least_distance)
    : graph_(graph), size_(size), least_distance_(least_distance) {}

void DiverseArchive::offer(std::span<const Individual> population) {
  for (const Individual& individual : population) {
    if (members_.size() == size_ && (size_ == 0 || individual.score <= members_.back().score)) return;
    offer(individual);
  }
}

void DiverseArchive::offer(const Individual& individual) {
  make_sketch(graph_, individual.derivation, sweep_, sketch_);
  // Best first: whoever is as good comes before the place where the newcomer would stand.
  std::size_t place = 0;
  for (; place < members_.size() && members_[place].score >= individual.score; ++place) {
    if (members_[place].derivation == individual.derivation) return;
    if (distance(graph_, sketches_[place], sketch_) < least_distance_) return;
  }
  for (std::size_t i = members_.size(); i-- > place;) {
    if (distance(graph_, sketches_[i], sketch_) >= least_distance_) continue;
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(i));
    sketches_.erase(sketches_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  members_.insert(members_.begin() + static_cast<std::ptrdiff_t>(place), individual);
  sketches_.insert(sketches_.begin() + static_cast<std::ptrdiff_t>(place), sketch_);
  if (members_.size() > size_) members_.pop_back(), sketches_.pop_back();
}

}  // namespace espalier
