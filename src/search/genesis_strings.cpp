#include "search/genesis_strings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "search/resampling.h"

namespace espalier {
namespace {

template <typename T>
void shuffle(std::vector<T>& values, RandomStream& random) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[random.below(static_cast<std::uint32_t>(i))]);
  }
}

std::vector<double> expected_by_rank(std::span<const double> values, double rank_min) {
  const std::size_t n = values.size();
  std::vector<std::size_t> order(n);  // worst first
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> expected(n);
  for (std::size_t first = 0; first < n;) {
    std::size_t end = first;
    while (end < n && values[order[end]] == values[order[first]]) ++end;
    const double rank = 0.5 * static_cast<double>(first + end - 1) / static_cast<double>(n - 1);
    for (; first < end; ++first) expected[order[first]] = rank_min + 2 * (1 - rank_min) * rank;
  }
  return expected;
}

/// The elite takes the last of the new places, unless some child is the same string.
void put_back_elite(std::span<const BitString> strings, std::span<const double> values,
                    std::vector<GenesisChild>& children, std::size_t place) {
  const auto best = static_cast<std::uint32_t>(std::max_element(values.begin(), values.end()) - values.begin());
  for (const GenesisChild& child : children) {
    // A string that became the same by chance may stand for other quantiles (GenesisEncoding::inherit).
    const bool copy = child.string == strings[best] && strings[child.parent] == strings[best];
    if (copy && values[child.parent] == values[best]) return;
  }
  children[place] = {strings[best], best, best, false};
}

}  // namespace

std::vector<double> expected_places(std::span<const double> values, double worst_of_window,
                                    const GenesisSettings& settings) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) return std::vector<double>(values.size(), 1);
  if (settings.selection == GenesisSelection::ranking) return expected_by_rank(values, settings.rank_min);
  CHECK(worst_of_window <= *least);
  // Halves, so that no difference overflows; scaled to 1, so that no sum does.
  const double span = *most / 2 - worst_of_window / 2;
  std::vector<double> expected(values.size());
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    expected[i] = (values[i] / 2 - worst_of_window / 2) / span;
    sum += expected[i];
  }
  for (double& e : expected) e *= static_cast<double>(values.size()) / sum;
  return expected;
}

std::vector<std::uint32_t> sample_universally(std::span<const double> expected, std::uint32_t count,
                                              RandomStream& random) {
  const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
  std::vector<double> weights;
  for (const double e : expected) weights.push_back(e / sum);
  std::vector<std::uint32_t> places;
  resample(Resampling::systematic, weights, count, random, places);
  shuffle(places, random);
  return places;
}

void mutate_bits(BitString& string, double rate, std::span<const std::uint8_t> held, RandomStream& random) {
  for (std::size_t i = 0; i < string.size(); ++i) {
    if (!random.chance(rate)) continue;
    const std::uint8_t bit = random.next_u32() & 1;
    if (held.empty() || !held[i]) string[i] = bit;
  }
}

bool cross_at_two_points(BitString& a, BitString& b, std::span<const std::uint8_t> held, RandomStream& random) {
  CHECK(a.size() == b.size());
  const auto points = static_cast<std::uint32_t>(a.size() + 1);
  std::uint32_t from = random.below(points), to = random.below(points);
  if (from > to) std::swap(from, to);
  bool changed = false;
  for (std::size_t i = from; i < to; ++i) {
    if (a[i] == b[i] || (!held.empty() && held[i])) continue;
    std::swap(a[i], b[i]);
    changed = true;
  }
  return changed;
}

std::vector<GenesisChild> next_strings(std::span<const BitString> strings, std::span<const double> values,
                                       std::uint32_t count, double worst_of_window, const GenesisSettings& settings,
                                       std::span<const std::uint8_t> held, RandomStream& random) {
  const auto n = static_cast<std::uint32_t>(strings.size());
  CHECK(n >= 1 && values.size() == n && count >= 1);
  const auto replaced = static_cast<std::uint32_t>(std::lround(settings.gap * count));
  const std::uint32_t made = std::clamp(replaced, count > n ? count - n : 1, count);
  std::vector<GenesisChild> children;
  const std::vector<double> expected = expected_places(values, worst_of_window, settings);
  for (const std::uint32_t parent : sample_universally(expected, made, random)) {
    children.push_back({strings[parent], parent, parent, false});
  }
  std::vector<std::uint32_t> old(n);
  std::iota(old.begin(), old.end(), 0u);
  if (made < count) shuffle(old, random);
  for (std::uint32_t i = 0; i < count - made; ++i) children.push_back({strings[old[i]], old[i], old[i], false});

  for (std::uint32_t i = 0; i < made; ++i) mutate_bits(children[i].string, settings.mutation, held, random);
  const auto crossed = static_cast<std::uint32_t>(std::lround(settings.crossover * made / 2)) * 2;
  for (std::uint32_t i = 0; i + 1 < std::min(crossed, made); i += 2) {
    if (!cross_at_two_points(children[i].string, children[i + 1].string, held, random)) continue;
    children[i].partner = children[i + 1].parent;
    children[i + 1].partner = children[i].parent;
  }
  if (settings.elitism) put_back_elite(strings, values, children, made - 1);
  for (GenesisChild& child : children) child.changed = child.string != strings[child.parent];
  return children;
}

void ScalingWindow::add(double worst) {
  worst_.push_back(worst);
  while (worst_.size() > std::size_t{generations_} + 1) worst_.pop_front();
}

double ScalingWindow::worst() const {
  CHECK(!worst_.empty());
  return *std::min_element(worst_.begin(), worst_.end());
}

}  // namespace espalier
