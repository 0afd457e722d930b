#include "breed/first_generation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/check.h"
#include "breed/newcomer.h"
#include "breed/streams.h"

namespace espalier {
namespace {

/// Every feature to mean 0 and standard deviation 1; those that never change to 0.
std::vector<std::vector<double>> standardised(const std::vector<std::vector<double>>& points) {
  std::vector<std::vector<double>> result = points;
  const auto n = static_cast<double>(points.size());
  for (std::size_t f = 0; f < points[0].size(); ++f) {
    double mean = 0, square = 0;
    for (const auto& point : points) mean += point[f] / n;
    for (const auto& point : points) square += (point[f] - mean) * (point[f] - mean) / n;
    const double scale = square > 1e-18 ? 1 / std::sqrt(square) : 0;
    for (std::size_t i = 0; i < points.size(); ++i) result[i][f] = (points[i][f] - mean) * scale;
  }
  return result;
}

}  // namespace

std::vector<std::size_t> farthest_points(const std::vector<std::vector<double>>& points, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (points.empty() || count == 0) return chosen;
  const std::vector<std::vector<double>> scaled = standardised(points);
  const std::vector<double> middle(scaled[0].size());
  std::vector<double> from_middle, nearest(points.size(), std::numeric_limits<double>::infinity());
  for (const auto& point : scaled) from_middle.push_back(feature_distance(point, middle));
  std::size_t next = static_cast<std::size_t>(std::min_element(from_middle.begin(), from_middle.end()) -
                                              from_middle.begin());
  while (chosen.size() < std::min(count, points.size())) {
    chosen.push_back(next);
    nearest[next] = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (nearest[i] >= 0) nearest[i] = std::min(nearest[i], feature_distance(scaled[i], scaled[next]));
    }
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
  }
  return chosen;
}

FirstGeneration first_generation(const BreedProblem& problem, const BreedSettings& settings,
                                 const std::vector<Derivation>& founders, MemberId first_id) {
  CHECK(problem.appraiser != nullptr);
  validate(settings);
  FirstGeneration first;
  std::vector<Derivation> pool;
  std::vector<std::vector<double>> features;
  const std::size_t places = settings.population - std::min<std::size_t>(founders.size(), settings.population);
  const std::uint32_t round = settings.population * kPoolPerMember;
  while (first.tried < settings.population * kMostDrawsPerMember && pool.size() < places) {
    std::vector<Derivation> drawn;
    std::vector<const Derivation*> candidates;
    for (std::uint32_t i = 0; i < round; ++i) {
      RandomStream random = stream_of(problem, BreedStream::first, 0, first.tried + i);
      drawn.push_back(draw_newcomer(*problem.graph, random));
    }
    for (const Derivation& derivation : drawn) candidates.push_back(&derivation);
    std::vector<Appraisal> appraisals = problem.appraiser->appraise(candidates);
    for (std::uint32_t i = 0; i < round; ++i) {
      if (!appraisals[i].viable || std::find(pool.begin(), pool.end(), drawn[i]) != pool.end()) continue;
      pool.push_back(std::move(drawn[i]));
      features.push_back(std::move(appraisals[i].features));
    }
    first.tried += round;
  }
  first.viable = static_cast<std::uint32_t>(pool.size());
  const auto add = [&](const Derivation& derivation) {
    Member member;
    member.id = first_id + first.members.size();
    member.derivation = derivation;
    first.members.push_back(std::move(member));
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(founders.size(), settings.population); ++i) add(founders[i]);
  for (const std::size_t chosen : farthest_points(features, places)) add(pool[chosen]);
  if (first.members.size() < settings.population) {
    first.note = fmt::format("only {} different viable models were found among {} drawn", pool.size(), first.tried);
  }
  return first;
}

}  // namespace espalier
