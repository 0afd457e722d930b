#pragma once
// CurveTarget: guiding curves as a target. Score = -cost of the skeleton.

#include <string>

#include "score/curve_cost.h"
#include "score/target.h"

namespace espalier {

class CurveTarget final : public Target {
 public:
  /// Throws Error for bad settings.
  explicit CurveTarget(const CurveSettings& settings) : cost_(settings) {}

  const CurveCost& cost() const { return cost_; }

  const std::string& name() const override { return name_; }
  TargetView view() const override { return TargetView::bones; }
  std::unique_ptr<TargetScratch> make_scratch() const override;
  double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  /// 0: how many bones a grammar can make is not known, nor what they are worth. No share of it is told.
  double optimum() const override { return 0; }
  bool bounded() const override { return false; }
  Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;

 private:
  CurveCost cost_;
  std::string name_ = "curves";
};

/// Every bone of the model, in order.
void tally_bones(const CurveCost& cost, const Model& model, CurveTally& tally);

}  // namespace espalier
