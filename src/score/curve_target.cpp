#include "score/curve_target.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/counted.h"

namespace espalier {
namespace {

struct CurveScratch final : TargetScratch {
  CurveTally tally;
};

constexpr const char* kTermNames[kCurveTerms] = {"distance", "alignment", "utilisation", "density"};

double in_cost(std::int64_t units) { return static_cast<double>(units) * kCostUnit; }

}  // namespace

void tally_bones(const CurveCost& cost, const Model& model, CurveTally& tally) {
  cost.reset(tally);
  for (const Bone& bone : model.bones) cost.add_bone(bone.from, bone.to, tally);
}

std::unique_ptr<TargetScratch> CurveTarget::make_scratch() const { return std::make_unique<CurveScratch>(); }

double CurveTarget::score(const Derivation&, const Model& model, TargetScratch* scratch) const {
  CurveTally& tally = static_cast<CurveScratch*>(scratch)->tally;
  tally_bones(cost_, model, tally);
  return -in_cost(tally.total());
}

Explanation CurveTarget::explain(const Derivation&, const Model& model, TargetScratch* scratch) const {
  CurveTally& tally = static_cast<CurveScratch*>(scratch)->tally;
  tally_bones(cost_, model, tally);
  Explanation e;
  e.name = name_;
  e.score = -in_cost(tally.total());
  for (std::size_t i = 0; i < kCurveTerms; ++i) {
    if (i == static_cast<std::size_t>(CurveTerm::density) && tally.crowd.empty()) continue;
    e.terms.push_back({kTermNames[i], -1, in_cost(tally.cost[i]), 0, -in_cost(tally.cost[i]), "cost"});
  }
  const auto used = static_cast<std::size_t>(
      std::count_if(tally.uses.begin(), tally.uses.end(), [](std::uint8_t uses) { return uses > 0; }));
  const double share = tally.uses.empty() ? 0 : 100.0 * static_cast<double>(used) / static_cast<double>(tally.uses.size());
  e.words = fmt::format("{}, {:.0f} % of the curves used", counted(model.bones.size(), "bone"), share);
  return e;
}

}  // namespace espalier
