#include "search/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/natural_exp.h"
#include "base/natural_log.h"

namespace espalier {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

double greatest(std::span<const double> values) {
  double most = kNothing;
  for (const double value : values) most = std::max(most, value);
  return most;
}

/// Gives a place to each of the ascending points in [0, total), where the weights lie side by side.
class Places {
 public:
  explicit Places(std::span<const double> weights) : weights_(weights) {
    while (last_ > 0 && weights_[last_] <= 0) --last_;
  }
  std::uint32_t at(double point) {
    // Rounding may leave a point beyond the sum: it belongs to the last particle that has a weight.
    while (i_ < last_ && point >= below_ + weights_[i_]) below_ += weights_[i_++];
    return static_cast<std::uint32_t>(i_);
  }

 private:
  std::span<const double> weights_;
  std::size_t i_ = 0, last_ = weights_.size() - 1;
  double below_ = 0;  // sum of the weights before i_
};

void add_multinomially(std::span<const double> weights, double total, std::uint32_t count, RandomStream& random,
                       std::vector<std::uint32_t>& ancestors) {
  std::vector<double> points(count);
  for (double& point : points) point = random.next_unit() * total;
  std::sort(points.begin(), points.end());
  Places places(weights);
  for (const double point : points) ancestors.push_back(places.at(point));
}

void add_by_residuals(std::span<const double> weights, std::uint32_t count, RandomStream& random,
                      std::vector<std::uint32_t>& ancestors) {
  std::vector<double> rest(weights.size());
  double total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double wanted = weights[i] * count;
    const double whole = std::min(std::floor(wanted), static_cast<double>(count - ancestors.size()));
    ancestors.insert(ancestors.end(), static_cast<std::size_t>(whole), static_cast<std::uint32_t>(i));
    total += rest[i] = wanted - whole;
  }
  const auto left = static_cast<std::uint32_t>(count - ancestors.size());
  if (left == 0) return;
  add_multinomially(rest, total, left, random, ancestors);
  std::sort(ancestors.begin(), ancestors.end());
}

}  // namespace

std::string_view name_of(Resampling scheme) {
  switch (scheme) {
    case Resampling::systematic: return "systematic";
    case Resampling::stratified: return "stratified";
    case Resampling::multinomial: return "multinomial";
    case Resampling::residual: return "residual";
  }
  return "?";
}

double log_sum(std::span<const double> log_weights) {
  const double most = greatest(log_weights);
  if (most == kNothing) return most;
  double sum = 0;
  for (const double w : log_weights) sum += natural_exp(w - most);
  return most + natural_log(sum);
}

bool normalise(std::span<const double> log_weights, std::vector<double>& weights) {
  const double most = greatest(log_weights);
  if (most == kNothing) return false;
  weights.resize(log_weights.size());
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] = natural_exp(log_weights[i] - most);
  for (double& w : weights) w /= sum;
  return true;
}

double effective_size(std::span<const double> weights) {
  double squares = 0;
  for (const double w : weights) squares += w * w;
  return 1 / squares;
}

void resample(Resampling scheme, std::span<const double> weights, std::uint32_t count, RandomStream& random,
              std::vector<std::uint32_t>& ancestors) {
  CHECK(!weights.empty());
  ancestors.clear();
  if (scheme == Resampling::multinomial) return add_multinomially(weights, 1, count, random, ancestors);
  if (scheme == Resampling::residual) return add_by_residuals(weights, count, random, ancestors);
  Places places(weights);
  double within = scheme == Resampling::systematic ? random.next_unit() : 0;
  for (std::uint32_t place = 0; place < count; ++place) {
    if (scheme == Resampling::stratified) within = random.next_unit();
    ancestors.push_back(places.at((place + within) / count));
  }
}

}  // namespace espalier
