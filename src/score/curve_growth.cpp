#include "score/curve_growth.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {

CurveGrowth::CurveGrowth(const GeneratorGraph& graph, const CurveCost& cost, double weight,
                         const std::vector<Vec3>& expected)
    : graph_(graph), cost_(cost), expected_(expected), scale_(-weight * kCostUnit), expander_(graph) {
  CHECK(expected.size() == graph.rules.size());
}

void CurveGrowth::begin(std::size_t places) {
  expander_.clear();
  outlooks_.clear();
  has_last_ = false;
  deeds_.clear();
  effects_.clear();
  tallies_.resize(places);
  for (CurveTally& tally : tallies_) cost_.reset(tally);
}

void CurveGrowth::clear(std::size_t place) { cost_.reset(tallies_[place]); }

const CurvePoint& CurveGrowth::nearest(const GrowthPool& pool, BudId bud, const Vec3& origin) {
  if (bud >= outlooks_.size()) outlooks_.resize(2 * pool.buds());
  Outlook& known = outlooks_[bud];
  if (known.has_nearest) return known.nearest;
  known.has_nearest = true;
  // A fork's branches stand where the fork does, and beside each other.
  const BudId below = pool.shoot(pool.bud(bud).shoot).bud;
  Frame frame;
  if (below < outlooks_.size() && outlooks_[below].has_nearest && expander_.frame(below, frame) &&
      frame.origin == origin) {
    return known.nearest = outlooks_[below].nearest;
  }
  if (!has_last_ || last_point_ != origin) {
    last_point_ = origin;
    last_nearest_ = cost_.nearest(origin);
    has_last_ = true;
  }
  return known.nearest = last_nearest_;
}

CurveGrowth::Deed& CurveGrowth::deed(ShootId shoot) {
  if (shoot >= deeds_.size()) deeds_.resize(2 * std::size_t{shoot} + 64);
  return deeds_[shoot];
}

void CurveGrowth::add_effects(std::size_t place, Deed& deed) {
  CurveTally& tally = tallies_[place];
  const std::int64_t before = tally.total();
  for (std::uint32_t i = 0; i < deed.bones; ++i) cost_.add(effects_[deed.first + i], tally);
  deed.cost = tally.total() - before;
}

void CurveGrowth::grown(std::size_t place, const GrowthPool& pool, ShootId shoot) {
  const BudId bud = pool.shoot(shoot).bud;
  Deed& own = deed(shoot);
  own.first = static_cast<std::uint32_t>(effects_.size());
  Frame frame;
  const bool placed = bud != kNoShoot && expander_.frame(bud, frame);
  for (const Bone& bone : expander_.run(pool, shoot)) {
    const bool known = placed && frame.origin == bone.from;
    effects_.push_back(cost_.judge(known ? nearest(pool, bud, bone.from) : cost_.nearest(bone.from), bone.from, bone.to));
  }
  own.bones = static_cast<std::uint32_t>(effects_.size()) - own.first;
  add_effects(place, own);
}

void CurveGrowth::grown_again(std::size_t place, ShootId shoot, ShootId copy_of) {
  Deed copy = deed(copy_of);
  add_effects(place, copy);
  deed(shoot) = copy;
}

void CurveGrowth::follow(std::span<const std::uint32_t> ancestors) {
  scratch_.resize(ancestors.size());
  for (std::size_t k = 0; k < ancestors.size(); ++k) scratch_[k] = tallies_[ancestors[k]];
  tallies_.swap(scratch_);
}

void CurveGrowth::score(const GrowthPool&, std::span<const GrowingDerivation> growing, std::span<double> scores) {
  for (std::size_t k = 0; k < growing.size(); ++k) scores[k] = scale_ * static_cast<double>(tallies_[k].total());
}

std::int64_t CurveGrowth::promised(const GrowthPool& pool, BudId bud) {
  if (bud < outlooks_.size() && outlooks_[bud].has_promise) return outlooks_[bud].promised;
  Frame frame;
  const Vec3& expected = expected_[graph_.edges[pool.bud(bud).edge].child];
  std::int64_t promised = 0;
  if (expected != Vec3(0) && expander_.frame(bud, frame)) {
    promised = cost_.alignment(nearest(pool, bud, frame.origin), frame.vector(expected));
  }
  if (bud >= outlooks_.size()) outlooks_.resize(2 * pool.buds());
  outlooks_[bud].promised = promised;
  outlooks_[bud].has_promise = true;
  return promised;
}

void CurveGrowth::promise(const GrowthPool& pool, std::span<const GrowingDerivation> growing,
                          std::span<double> promises) {
  for (std::size_t k = 0; k < growing.size(); ++k) {
    std::int64_t sum = 0;
    for (const BudId bud : growing[k].open) sum += promised(pool, bud);
    promises[k] = scale_ * static_cast<double>(sum);
  }
}

void CurveGrowth::renumber(const GrowthRenumbering& renumbering) {
  expander_.renumber(renumbering);
  // Numbers only fall, so each moves to a place that is free.
  std::size_t buds = 0, shoots = 0;
  for (std::size_t bud = 0; bud < std::min(outlooks_.size(), renumbering.buds.size()); ++bud) {
    if (renumbering.buds[bud] == kNoShoot) continue;
    outlooks_[renumbering.buds[bud]] = outlooks_[bud];
    buds = renumbering.buds[bud] + 1;
  }
  std::vector<BoneEffect> effects;
  for (std::size_t shoot = 0; shoot < std::min(deeds_.size(), renumbering.shoots.size()); ++shoot) {
    if (renumbering.shoots[shoot] == kNoShoot) continue;
    Deed deed = deeds_[shoot];
    const auto first = effects_.begin() + deed.first;
    deed.first = static_cast<std::uint32_t>(effects.size());
    effects.insert(effects.end(), first, first + deed.bones);
    deeds_[renumbering.shoots[shoot]] = deed;
    shoots = renumbering.shoots[shoot] + 1;
  }
  outlooks_.resize(buds);
  deeds_.resize(shoots);
  effects_ = std::move(effects);
}

}  // namespace espalier
