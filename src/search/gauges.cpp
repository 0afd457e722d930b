#include "search/gauges.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace espalier {

double share_distinct(std::span<const Individual> population) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(population.size());
  for (const Individual& one : population) hashes.push_back(hash(one.derivation));
  std::sort(hashes.begin(), hashes.end());
  const auto end = std::unique(hashes.begin(), hashes.end());
  return share_of(static_cast<std::uint64_t>(end - hashes.begin()), population.size());
}

double mean_genes(std::span<const Individual> population) {
  std::uint64_t genes = 0;
  for (const Individual& one : population) genes += one.derivation.size();
  return share_of(genes, population.size());
}

double mean_score(std::span<const Individual> population) {
  if (population.empty()) return kNothingToTell;
  double sum = 0;
  for (const Individual& one : population) sum += one.score;
  return sum / static_cast<double>(population.size());
}

double score_deviation(std::span<const Individual> population) {
  if (population.empty()) return kNothingToTell;
  const auto n = static_cast<double>(population.size());
  double sum = 0, squares = 0;
  for (const Individual& one : population) sum += one.score;
  for (const Individual& one : population) squares += (one.score - sum / n) * (one.score - sum / n);
  return std::sqrt(squares / n);
}

}  // namespace espalier
