#pragma once
// Features: a derivation and its model as a list of numbers of fixed length, for comparing them and for learning what a
// person likes. All are about 0..1.
//
//   draws of the start rule   their quantiles; two numbers (cosine, sine) for circular ones; 1/2 where one is lacking
//   genes                     per rule other than the start rule: how many, on a log scale; and the means of its draws
//   measures                  triangles, height, spread and volume on log scales, balance
//   shape                     per quarter of the height: share of the parts, and how far they reach from the axis

#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"
#include "score/measure.h"

namespace espalier {

class Features {
 public:
  /// Draws beyond this many are left out.
  static constexpr std::size_t kMostDraws = 96;

  explicit Features(const GeneratorGraph& graph);

  std::size_t size() const { return names_.size(); }
  /// For people: "taper", "number of Branch", "height", "width of the top quarter".
  const std::vector<std::string>& names() const { return names_; }
  /// How many of them, from the first, are of the genome alone.
  std::size_t genome_size() const { return genome_size_; }

  /// `measures`: all. `model`: with details.
  std::vector<double> of(const GeneratorGraph& graph, const Derivation& derivation, const Model& model,
                         const PerMeasure<double>& measures) const;
  /// The first genome_size() of them.
  std::vector<double> of_genome(const GeneratorGraph& graph, const Derivation& derivation) const;

 private:
  /// One draw of one rule: where its numbers stand.
  struct Place {
    RuleId rule = 0;
    std::uint16_t draw = 0;
    bool circular = false;
    std::size_t at = 0;
  };
  std::vector<Place> places_;
  std::vector<std::size_t> counts_;  // per rule: where its count stands; 0 for the start rule
  std::vector<std::string> names_;
  std::size_t genome_size_ = 0;
};

/// Root of the mean squared difference; lists of equal length, at least 1.
double feature_distance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace espalier
