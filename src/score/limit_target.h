#pragma once
// LimitTarget: limits on what a model measures, so that models grow no larger than they need to, or can be built.
// One target for all of them: the measures are taken in one pass.

#include <string>
#include <vector>

#include "score/gauge.h"
#include "score/limit.h"
#include "score/target.h"

namespace espalier {

class LimitTarget final : public Target {
 public:
  /// Keeps what it needs of `meshes`; `view` says which instances measures see. Throws Error for a bad limit.
  LimitTarget(const Limits& limits, const MeshTable& meshes, VolumeView view);

  const Limits& limits() const { return limits_; }
  /// The measures that are limited, in order.
  const std::vector<Measure>& measures() const { return measures_; }
  /// One line per thing that a person should know: mesh files without volume where volume is limited.
  const std::vector<std::string>& warnings() const { return warnings_; }

  const std::string& name() const override { return name_; }
  TargetView view() const override;
  bool may_reject() const override { return may_reject_; }
  std::unique_ptr<TargetScratch> make_scratch() const override;
  /// Minus the sum of what the ramps cost; -infinity for a model beyond a hard bound. Where slots are still open, only
  /// beyond one that growth cannot mend.
  double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  double optimum() const override { return 0; }
  /// A term per measure, with its value.
  Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  /// By measure. A model beyond several bounds counts for each.
  std::vector<Rejections> rejections(const TargetScratch* scratch) const override;

 private:
  Limits limits_;
  std::vector<Measure> measures_;
  std::vector<std::string> warnings_;
  bool may_reject_ = false;
  VolumeView shown_;
  Gauge gauge_;
  std::string name_ = "limits";
};

}  // namespace espalier
