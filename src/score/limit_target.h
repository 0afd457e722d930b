#pragma once
// LimitTarget: a soft ramp on the number of genes, so that models grow no larger than they need to.
// (Haubenwallner et al. 2016, eq. 4.)

#include <cstdint>
#include <limits>

#include "score/target.h"

namespace espalier {

/// Sizes of derivations, in genes. `min` and `max` are hard: the search rejects what is outside; the score does not see
/// them. The penalty weight * S(genes, from, to) is subtracted from the score.
struct Limit {
  std::uint32_t min = 1;
  std::uint32_t max = std::numeric_limits<std::uint32_t>::max();
  double from = 0;
  double to = 0;
  double weight = 0;

  bool accepts(std::size_t genes) const { return genes >= min && genes <= max; }
};

/// Throws Error unless min <= max, from <= to, weight >= 0 and all are finite.
void validate(const Limit& limit);

class LimitTarget final : public Target {
 public:
  explicit LimitTarget(const Limit& limit);

  const Limit& limit() const { return limit_; }
  double penalty(std::size_t genes) const;

  const std::string& name() const override { return name_; }
  TargetView view() const override { return TargetView::genes; }
  double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  double optimum() const override { return 0; }
  Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;

 private:
  Limit limit_;
  std::string name_ = "genes";
};

}  // namespace espalier
