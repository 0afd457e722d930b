#include "run/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/check.h"

namespace espalier {
namespace {

constexpr std::size_t kMostExact = 50;  // C(50, 25) is still a whole number in a double

/// Twice the rank of each value, equal values sharing the mean of theirs: whole numbers.
std::vector<std::uint32_t> doubled_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<std::uint32_t> ranks(values.size());
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = static_cast<std::uint32_t>(begin + 1 + end);
  }
  return ranks;
}

/// The share of all ways to choose `size` of the ranks whose sum is at least as far from the mean as `sum` is.
double exact_share(std::span<const std::uint32_t> ranks, std::size_t size, std::uint64_t sum) {
  const std::size_t most = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::vector<std::vector<double>> ways(size + 1, std::vector<double>(most + 1, 0.0));  // [chosen][sum]
  ways[0][0] = 1;
  for (const std::uint32_t rank : ranks) {
    for (std::size_t chosen = size; chosen > 0; --chosen) {
      for (std::size_t s = most; s >= rank; --s) ways[chosen][s] += ways[chosen - 1][s - rank];
    }
  }
  const double mean = static_cast<double>(size) * static_cast<double>(ranks.size() + 1);
  const double distance = std::fabs(static_cast<double>(sum) - mean);
  double all = 0, far = 0;
  for (std::size_t s = 0; s <= most; ++s) {
    all += ways[size][s];
    if (std::fabs(static_cast<double>(s) - mean) >= distance) far += ways[size][s];
  }
  return far / all;
}

double normal_share(std::span<const std::uint32_t> ranks, std::size_t size, std::uint64_t sum) {
  const double n = static_cast<double>(ranks.size()), chosen = static_cast<double>(size);
  double squares = 0;  // of the ranks around their mean: ties make them scatter less
  for (const std::uint32_t rank : ranks) squares += std::pow(rank / 2.0 - (n + 1) / 2, 2);
  const double variance = chosen * (n - chosen) * squares / (n * (n - 1));
  if (variance <= 0) return 1;
  const double distance = std::fabs(static_cast<double>(sum) / 2 - chosen * (n + 1) / 2);
  return std::min(1.0, std::erfc(std::max(0.0, distance - 0.5) / std::sqrt(2 * variance)));
}

}  // namespace

double quantile(std::span<const double> ascending, double share) {
  CHECK(!ascending.empty() && share >= 0 && share <= 1);
  const double rank = share * static_cast<double>(ascending.size() - 1);
  const std::size_t below = static_cast<std::size_t>(rank);
  const double low = ascending[below], high = ascending[std::min(below + 1, ascending.size() - 1)];
  const double part = rank - static_cast<double>(below);
  if (part == 0 || low == high || std::isinf(low)) return low;
  return low + part * (high - low);
}

SampleSummary summarise(std::vector<double> values) {
  CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  SampleSummary s;
  s.count = values.size();
  s.median = quantile(values, 0.5);
  s.lower = quantile(values, 0.25), s.upper = quantile(values, 0.75);
  s.min = values.front(), s.max = values.back();
  s.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) return s;
  double squares = 0;
  for (const double value : values) squares += (value - s.mean) * (value - s.mean);
  s.deviation = std::sqrt(squares / (n - 1));
  return s;
}

double rank_test(std::span<const double> a, std::span<const double> b) {
  CHECK(!a.empty() && !b.empty());
  std::vector<double> both(a.begin(), a.end());
  both.insert(both.end(), b.begin(), b.end());
  const std::vector<std::uint32_t> ranks = doubled_ranks(both);
  const std::uint64_t sum =
      std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(a.size()), std::uint64_t{0});
  return both.size() <= kMostExact ? exact_share(ranks, a.size(), sum) : normal_share(ranks, a.size(), sum);
}

std::vector<double> holm(std::span<const double> chances) {
  std::vector<std::size_t> order(chances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return chances[i] < chances[j]; });
  std::vector<double> corrected(chances.size());
  double least = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    least = std::max(least, std::min(1.0, static_cast<double>(order.size() - rank) * chances[order[rank]]));
    corrected[order[rank]] = least;
  }
  return corrected;
}

double least_rank_test(std::size_t a, std::size_t b) {
  std::vector<double> low(a, 0.0), high(b, 0.0);
  for (std::size_t i = 0; i < a; ++i) low[i] = static_cast<double>(i);
  for (std::size_t i = 0; i < b; ++i) high[i] = static_cast<double>(a + i);
  return rank_test(low, high);
}

}  // namespace espalier
