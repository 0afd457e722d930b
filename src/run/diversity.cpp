#include "run/diversity.h"

#include <optional>

#include "base/check.h"
#include "derivation/sample.h"

namespace espalier {
namespace {

double mean_distance(const std::vector<ModelSketch>& sketches) {
  double sum = 0;
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < sketches.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k, ++pairs) sum += distance(sketches[i], sketches[k]);
  }
  return pairs > 0 ? sum / static_cast<double>(pairs) : 0;
}

}  // namespace

DiverseArchive::DiverseArchive(ModelSketcher sketcher, std::size_t size, double least_distance)
    : sketcher_(std::move(sketcher)), size_(size), least_distance_(least_distance) {}

void DiverseArchive::offer(std::span<const Individual> population, bool open) {
  std::optional<double> seen;
  for (std::size_t i = 0; i < population.size(); ++i) {
    const double score = population[i].score;
    if (members_.size() == size_ && (size_ == 0 || score <= members_.back().score)) return;
    if (seen && score == *seen) continue;  // a twin, as good as always
    if (!open && !is_finished(population[i].derivation)) continue;
    seen = score;
    offer(population[i]);
  }
}

void DiverseArchive::restore(std::vector<Individual> members) {
  CHECK(members.size() <= size_);
  members_ = std::move(members);
  sketches_.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) sketcher_.draw(members_[i].derivation, sketches_[i]);
}

std::vector<Individual> DiverseArchive::apart_from(const Derivation& derivation) {
  sketcher_.draw(derivation, sketch_);
  std::vector<Individual> result;
  for (std::size_t i = 0; i < members_.size() && result.size() + 1 < size_; ++i) {
    if (distance(sketches_[i], sketch_) >= least_distance_ && !(members_[i].derivation == derivation)) {
      result.push_back(members_[i]);
    }
  }
  return result;
}

double DiverseArchive::spread() const { return mean_distance(sketches_); }

double DiverseArchive::spread_of(std::span<const Individual> individuals) {
  std::vector<ModelSketch> sketches(individuals.size());
  for (std::size_t i = 0; i < individuals.size(); ++i) sketcher_.draw(individuals[i].derivation, sketches[i]);
  return mean_distance(sketches);
}

void DiverseArchive::offer(const Individual& individual) {
  sketcher_.draw(individual.derivation, sketch_);
  // Best first: whoever is as good comes before the place where the newcomer would stand.
  std::size_t place = 0;
  for (; place < members_.size() && members_[place].score >= individual.score; ++place) {
    if (members_[place].derivation == individual.derivation) return;
    if (distance(sketches_[place], sketch_) < least_distance_) return;
  }
  for (std::size_t i = members_.size(); i-- > place;) {
    if (distance(sketches_[i], sketch_) >= least_distance_) continue;
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(i));
    sketches_.erase(sketches_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  members_.insert(members_.begin() + static_cast<std::ptrdiff_t>(place), individual);
  sketches_.insert(sketches_.begin() + static_cast<std::ptrdiff_t>(place), sketch_);
  if (members_.size() > size_) members_.pop_back(), sketches_.pop_back();
}

}  // namespace espalier
