#pragma once
// Pearson's test of observed counts against expected probabilities.

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace espalier::test {

/// The value that chi-square with `degrees` of freedom exceeds with probability 0.0005 (Wilson and Hilferty).
inline double chi_square_bound(double degrees) {
  const double a = 2 / (9 * degrees);
  return degrees * std::pow(1 - a + 3.2905 * std::sqrt(a), 3);
}

/// Expects counts[i] of their sum to follow probabilities[i]. Outcomes expected fewer than 5 times are pooled; those of
/// probability 0 must not occur.
inline void expect_distribution(const std::vector<double>& probabilities, const std::vector<int>& counts) {
  double total = 0, chi2 = 0, pooled = 0, pooled_count = 0;
  int cells = 0;
  for (const int count : counts) total += count;
  const auto add = [&](double count, double expected) {
    chi2 += (count - expected) * (count - expected) / expected;
    ++cells;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = probabilities[i] * total;
    if (expected == 0) {
      EXPECT_EQ(counts[i], 0) << "outcome " << i << " has probability 0";
    } else if (expected < 5) {
      pooled += expected;
      pooled_count += counts[i];
    } else {
      add(counts[i], expected);
    }
  }
  if (pooled >= 5) add(pooled_count, pooled);
  ASSERT_GE(cells, 2);
  EXPECT_LT(chi2, chi_square_bound(cells - 1)) << "with " << cells - 1 << " degrees of freedom";
}

/// The same for named outcomes; outcomes that are not named must not occur.
inline void expect_distribution(const std::map<std::string, double>& probabilities,
                                const std::map<std::string, int>& counts) {
  std::vector<double> p;
  std::vector<int> n;
  double sum = 0;
  for (const auto& [name, probability] : probabilities) {
    p.push_back(probability);
    sum += probability;
    const auto found = counts.find(name);
    n.push_back(found == counts.end() ? 0 : found->second);
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  for (const auto& [name, count] : counts) EXPECT_TRUE(probabilities.contains(name)) << name << ": " << count;
  expect_distribution(p, n);
}

}  // namespace espalier::test
