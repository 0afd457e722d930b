#pragma once
// CurveGrowth: guiding curves for derivations that grow. What a bone costs is known as soon as its gene is there, so a
// place is an account of costs and used segments; the nearest curve of each slot is looked up once for all derivations
// that share it. The same costs as CurveTarget's, bit for bit.

#include <vector>

#include "derivation/growth_pool.h"
#include "model/gene_expander.h"
#include "score/curve_cost.h"
#include "score/objective.h"

namespace espalier {

class CurveGrowth final : public GrowthScorer {
 public:
  /// All must outlive it. `expected`: per rule, as expected_directions gives them; scores are -weight * cost.
  CurveGrowth(const GeneratorGraph& graph, const CurveCost& cost, double weight, const std::vector<Vec3>& expected);

  void begin(std::size_t places) override;
  void clear(std::size_t place) override;
  void grown(std::size_t place, const GrowthPool& pool, ShootId shoot) override;
  void grown_again(std::size_t place, ShootId shoot, ShootId copy_of) override;
  void follow(std::span<const std::uint32_t> ancestors) override;
  void score(const GrowthPool& pool, std::span<const GrowingDerivation> growing, std::span<double> scores) override;
  /// Equation 10, negated.
  void promise(const GrowthPool& pool, std::span<const GrowingDerivation> growing,
               std::span<double> promises) override;
  double worth(ShootId shoot) const override { return scale_ * static_cast<double>(deeds_[shoot].cost); }
  void renumber(const GrowthRenumbering& renumbering) override;

  const CurveTally& tally(std::size_t place) const { return tallies_[place]; }

 private:
  /// Of a bud; what is not known yet is looked up when it is first asked for.
  struct Outlook {
    CurvePoint nearest;  // of the frame's origin
    std::int64_t promised = 0;
    bool has_nearest = false, has_promise = false;
  };

  /// Of a shoot: what its bones do, and what they cost when they came.
  struct Deed {
    std::uint32_t first = 0, bones = 0;  // effects
    std::int64_t cost = 0;
  };

  Deed& deed(ShootId shoot);
  void add_effects(std::size_t place, Deed& deed);
  /// Of the frame in which a bud's child would stand, known to be at this point.
  const CurvePoint& nearest(const GrowthPool& pool, BudId bud, const Vec3& origin);
  std::int64_t promised(const GrowthPool& pool, BudId bud);

  const GeneratorGraph& graph_;
  const CurveCost& cost_;
  const std::vector<Vec3>& expected_;
  double scale_;  // from units of cost to score
  GeneExpander expander_;
  std::vector<CurveTally> tallies_, scratch_;
  std::vector<Outlook> outlooks_;          // per bud, so far as anybody asked
  Vec3 last_point_{0};                     // looked up last
  CurvePoint last_nearest_;
  bool has_last_ = false;
  std::vector<Deed> deeds_;                // per shoot
  std::vector<BoneEffect> effects_;
};

}  // namespace espalier
