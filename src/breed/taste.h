#pragma once
// Taste: a model of what a person likes, learnt from what was rated: a Gaussian process over features (Rasmussen and
// Williams 2006, algorithm 2.1) with a squared exponential kernel whose length scale is chosen by marginal likelihood.
// It foretells a rating, says how sure it is, and in words what raised it. Opt-in, and of one person's session only.

#include <memory>
#include <string>
#include <vector>

namespace espalier {

/// One thing that a person said of a candidate: a rating (0 = neutral), by its features.
struct Opinion {
  std::vector<double> features;
  double rating = 0;
};

/// Of two candidates, this one was preferred: their ratings are taken to differ by one spread of the ratings (by 1
/// where there are none).
struct Comparison {
  std::vector<double> better, worse;
};

struct TasteSettings {
  double noise = 0.3;  // standard deviation of a person's ratings, as a share of their spread; above 0, at most 10
  std::size_t most_opinions = 600;  // the latest are kept, and as many comparisons; time goes with the cube. 1..2000

  bool operator==(const TasteSettings&) const = default;
};

/// Throws Error stating rule and value.
void validate(const TasteSettings& settings);

struct Forecast {
  double rating = 0;
  double deviation = 0;  // standard deviation of it: grows away from what was rated
};

class Taste {
 public:
  /// Learns at once. All features lists are equally long and not empty; at least one opinion or comparison. The order
  /// of opinions does not count (they are sorted), unless there are more than most_opinions. Throws Error for bad
  /// settings or lists of different lengths, and for numbers that are not finite.
  Taste(const std::vector<Opinion>& opinions, const std::vector<Comparison>& comparisons,
        const TasteSettings& settings);
  ~Taste();
  Taste(Taste&&) noexcept;
  Taste& operator=(Taste&&) noexcept;

  std::size_t opinions() const;  // and comparisons that it knows
  Forecast forecast(const std::vector<double>& features) const;
  std::vector<Forecast> forecasts(const std::vector<std::vector<double>>& features) const;
  /// How much each feature would raise the forecast, if it alone moved from what is usual (the mean of what was
  /// rated) to what the candidate has; in units of rating.
  std::vector<double> contributions(const std::vector<double>& features) const;
  /// "you like: more height; you dislike: less taper": the strongest contributions with the names of their features, at
  /// most `most` of each; empty where nothing counts for a tenth of the spread of the ratings.
  std::string reasons(const std::vector<double>& features, const std::vector<std::string>& names,
                      std::size_t most = 2) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace espalier
