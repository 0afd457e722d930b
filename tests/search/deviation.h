#pragma once
// How far estimates lie from the truth, in standard errors: several independent ones of many quantities at once.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace espalier::testing {

class Deviation {
 public:
  explicit Deviation(std::map<std::string, double> truth) : truth_(std::move(truth)) {}

  /// One estimate of everything; what is not named is 0. Names without a truth fail the test.
  void add(const std::map<std::string, double>& estimate) {
    ++count_;
    for (const auto& [name, value] : estimate) {
      EXPECT_TRUE(truth_.contains(name)) << name;
      sum_[name] += value, squares_[name] += value * value;
    }
  }
  /// The largest distance of a mean from its truth, of quantities that are at least `least` large: what is rarer has no
  /// error that can be told.
  double worst(double least) {
    double worst = 0;
    for (const auto& [name, expected] : truth_) {
      if (expected < least) continue;
      const double mean = sum_[name] / count_, variance = squares_[name] / count_ - mean * mean;
      worst = std::max(worst, std::abs(mean - expected) / std::sqrt(variance / count_));
    }
    return worst;
  }

 private:
  std::map<std::string, double> truth_, sum_, squares_;
  int count_ = 0;
};

/// Of fifty quantities one is that far off once in a thousand.
inline constexpr double kLargeDeviation = 4.2;

/// The values over their sum.
inline std::map<std::string, double> shares(std::map<std::string, double> values) {
  double total = 0;
  for (const auto& [name, value] : values) total += value;
  for (auto& [name, value] : values) value /= total;
  return values;
}

}  // namespace espalier::testing
