#include "score/curve_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "base/error.h"
#include "score/random_curves.h"

namespace espalier {
namespace {

using namespace test;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

double in_cost(std::int64_t units) { return static_cast<double>(units) * kCostUnit; }
std::int64_t in_units(double cost) { return std::llround(cost / kCostUnit); }

CurveTally tally_of(const CurveCost& cost, const std::vector<Bone>& bones) {
  CurveTally tally;
  cost.reset(tally);
  for (const Bone& bone : bones) cost.add_bone(bone.from, bone.to, tally);
  return tally;
}

/// Along x from the origin, 4 m long, its parameter even with its length; nothing costs anything.
GuidingCurve straight() {
  GuidingCurve guide;
  guide.curve = {{{{0, 0, 0}, {4.0f / 3, 0, 0}, {8.0f / 3, 0, 0}, {4, 0, 0}}}};
  guide.distance = {0, 0, 0};
  guide.alignment = guide.utilisation = 0;
  guide.segment = 0.5;
  return guide;
}

CurveSettings only(const GuidingCurve& guide) {
  CurveSettings settings;
  settings.curves = {guide};
  return settings;
}

BoneDensity somewhere(double cell, double wanted, double cost) {
  BoneDensity density;
  density.min = Vec3(-1, -1, -1);
  density.max = Vec3(1, 0.875f, 1);
  density.cell = cell;
  density.wanted = wanted;
  density.cost = cost;
  return density;
}

/// The greatest difference of any term, per bone.
double greatest_difference(const CurveTally& tally, const ReferenceCosts& costs, std::size_t bones) {
  const double terms[] = {costs.distance, costs.alignment, costs.utilisation, costs.density};
  double greatest = 0;
  for (std::size_t i = 0; i < kCurveTerms; ++i) {
    greatest = std::max(greatest, std::abs(in_cost(tally.cost[i]) - terms[i]) / static_cast<double>(bones));
  }
  return greatest;
}

TEST(CurveCost, AgreesWithTheReference) {
  double greatest = 0, least_utilisation = 0, greatest_density = 0;
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    RandomStream random = curve_stream(100 + seed);
    CurveSettings settings = random_settings(random, 1 + seed % 4);
    settings.blend = seed % 3 == 0;
    for (GuidingCurve& guide : settings.curves) {
      if (seed % 2 == 0) guide.thickness = {0.5 * random.next_unit(), 0.5 * random.next_unit()};
    }
    if (seed % 4 < 2) settings.density = somewhere(0.35, 10 * random.next_unit(), 7);
    const ReferenceCurves reference(settings);
    const std::vector<Bone> bones = random_skeleton(reference, random, 30);
    const CurveTally tally = tally_of(CurveCost(settings), bones);
    const ReferenceCosts costs = reference.costs(bones);
    greatest = std::max(greatest, greatest_difference(tally, costs, bones.size()));
    least_utilisation = std::min(least_utilisation, costs.utilisation);
    greatest_density = std::max(greatest_density, costs.density);
    EXPECT_NEAR(in_cost(tally.total()), costs.total(), 0.02 * static_cast<double>(bones.size())) << seed;
  }
  EXPECT_LT(greatest, 0.02);
  EXPECT_LT(least_utilisation, -100);
  EXPECT_GT(greatest_density, 10);
}

// What the test above can see: any setting that is a little off.
TEST(CurveCost, WrongCostsAreSeen) {
  RandomStream random = curve_stream(130);
  CurveSettings settings = random_settings(random, 3);
  settings.density = somewhere(0.35, 1, 7);
  for (GuidingCurve& guide : settings.curves) guide.thickness = {0.1, 0.3};
  const ReferenceCurves reference(settings);
  const std::vector<Bone> bones = random_skeleton(reference, random, 30);
  const ReferenceCosts costs = reference.costs(bones);
  ASSERT_LT(greatest_difference(tally_of(CurveCost(settings), bones), costs, bones.size()), 0.02);
  const auto seen = [&](const auto& change) {
    CurveSettings wrong = settings;
    for (GuidingCurve& guide : wrong.curves) change(guide);
    return greatest_difference(tally_of(CurveCost(wrong), bones), costs, bones.size()) > 0.02;
  };
  EXPECT_FALSE(seen([](GuidingCurve&) {}));
  EXPECT_TRUE(seen([](GuidingCurve& g) { g.offset *= 0.99; }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { g.alignment *= 0.99; }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { g.segment *= 0.8; }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { g.utilisation *= 0.98; }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { std::swap(g.thickness[0], g.thickness[1]); }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { std::swap(g.distance[1], g.distance[2]); }));
  EXPECT_TRUE(seen([](GuidingCurve& g) { std::reverse(g.curve.points.begin(), g.curve.points.end()); }));
}

TEST(CurveCost, IsIndependentOfTheOrder) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    RandomStream random = curve_stream(150 + seed);
    CurveSettings settings = random_settings(random, 3);
    settings.density = somewhere(0.3, 2, 3);
    settings.field_cells = seed % 4 == 0 ? 8 : 0;
    const CurveCost cost(settings);
    std::vector<Bone> bones;
    for (int i = 0; i < 400; ++i) {
      const Vec3 from = random_place(random, 1.5);
      bones.push_back(bone_between(from, from + random_place(random, 0.5)));
    }
    const CurveTally tally = tally_of(cost, bones);
    EXPECT_GT(tally.cost[3], 0);
    for (int k = 0; k < 5; ++k) {
      for (std::size_t i = bones.size(); i-- > 1;) {
        std::swap(bones[i], bones[random.below(static_cast<std::uint32_t>(i + 1))]);
      }
      EXPECT_EQ(tally_of(cost, bones), tally);
    }
    bones.pop_back();
    EXPECT_NE(tally_of(cost, bones), tally);
  }
}

TEST(CurveCost, ChargesByTheDistanceOfTheBase) {
  GuidingCurve guide = straight();
  guide.distance = {1, 20, 300};
  const CurveCost cost(only(guide));
  const auto of = [&](const Vec3& from, const Vec3& to) { return tally_of(cost, {bone_between(from, to)}).cost; };
  EXPECT_EQ(of({1, 0, 0}, {1, 7, 0})[0], in_units(1));
  EXPECT_NEAR(in_cost(of({1, 0, 0.5f}, {1, 0, 0})[0]), 1 + 10 + 75, 1e-3);
  EXPECT_NEAR(in_cost(of({1, 1, 0}, {1, 0, 0})[0]), 321, 1e-2);
  EXPECT_NEAR(in_cost(of({4 + 3, 4, 0}, {1, 0, 0})[0]), 1 + 100 + 7500, 0.1);
  EXPECT_EQ(of({1, 1, 0}, {1, 0, 0})[1], 0);
  EXPECT_EQ(of({1, 1, 0}, {1, 0, 0})[2], 0);
  EXPECT_EQ(of({1, 1, 0}, {1, 0, 0})[3], 0);
}

TEST(CurveCost, RewardsAlignmentBeyondTheOffset) {
  GuidingCurve guide = straight();
  guide.alignment = 400;
  guide.offset = 0.6;
  const CurveCost cost(only(guide));
  const auto of = [&](const Vec3& direction) {
    const Vec3 from(1, 0.25f, 0);
    return in_cost(tally_of(cost, {bone_between(from, from + direction)}).cost[1]);
  };
  EXPECT_NEAR(of({1, 0, 0}), -160, 1e-3);
  EXPECT_NEAR(of({0.001f, 0, 0}), -160, 1e-3);
  EXPECT_NEAR(of({0, 0, -3}), 240, 1e-3);
  EXPECT_NEAR(of({-2, 0, 0}), 640, 1e-3);
  EXPECT_NEAR(of({0.6f, 0.8f, 0}), 0, 1e-3);
  guide.offset = 1;
  EXPECT_EQ(tally_of(CurveCost(only(guide)), {bone_between({1, 0, 0}, {2, 0, 0})}).cost[1], 0);
}

TEST(CurveCost, BonesWithoutLengthOrTangentAreNeverAligned) {
  GuidingCurve guide = straight();
  guide.alignment = 400;
  guide.utilisation = 20;
  guide.distance = {5, 0, 0};
  const CurveTally still = tally_of(CurveCost(only(guide)), {bone_between({1.1f, 2, 0}, {1.1f, 2, 0})});
  EXPECT_EQ(still.cost[0], in_units(5));
  EXPECT_EQ(still.cost[1], 0);
  EXPECT_EQ(still.cost[2], in_units(-20));
  guide.curve.points.fill(Vec3(1, 2, 3));
  const CurveCost cost(only(guide));
  EXPECT_EQ(cost.segments(0), 1u);
  const CurveTally tally = tally_of(cost, {bone_between({1, 2, 4}, {1, 2, 3})});
  EXPECT_EQ(tally.cost[0], in_units(5));
  EXPECT_EQ(tally.cost[1], 0);
  EXPECT_EQ(tally.cost[2], in_units(-20));
  EXPECT_EQ(cost.alignment(cost.nearest(Vec3(1, 2, 4)), Vec3(1, 0, 0)), 0);
}

/// The first parameter in the segment.
float begin_of(const CurveCost& cost, std::uint32_t curve, std::uint32_t segment) {
  float low = 0, high = 1;
  for (int i = 0; i < 30; ++i) {
    const float middle = 0.5f * (low + high);
    (cost.segment_at(curve, middle) < segment ? low : high) = middle;
  }
  return high;
}

TEST(CurveCost, SegmentsAreEquallyLong) {
  RandomStream random = curve_stream(180);
  for (int k = 0; k < 30; ++k) {
    CurveSettings settings = random_settings(random, 2);
    const CurveShape shape = kCurveShapes[static_cast<std::size_t>(k) % 7];
    settings.curves[1].curve = random_curve(random, shape);
    // Lengths are summed up less well where the curve turns about at once.
    const bool turns = shape == CurveShape::folded_line || shape == CurveShape::cusp;
    const ReferenceCurves reference(settings);
    const CurveCost cost(settings);
    for (std::uint32_t c = 0; c < 2; ++c) {
      const std::uint32_t segments = cost.segments(c);
      ASSERT_EQ(segments, reference.segments(c));
      ASSERT_LE(reference.length(c) / segments, settings.curves[c].segment * (1 + 1e-6));
      EXPECT_EQ(cost.segment_at(c, 0), 0u);
      EXPECT_EQ(cost.segment_at(c, 1), segments - 1);
      for (std::uint32_t s = 1; s < segments; ++s) {
        const double wanted = reference.length(c) * s / segments;
        EXPECT_NEAR(reference.length_to(c, begin_of(cost, c, s)), wanted, c == 1 && turns ? 1e-3 : 1e-5);
      }
    }
  }
}

TEST(CurveCost, UsesAllSegmentsFromBaseToTip) {
  GuidingCurve guide = straight();  // eight segments of half a metre
  guide.utilisation = 10;
  const CurveCost cost(only(guide));
  ASSERT_EQ(cost.segments(0), 8u);
  const auto used = [&](float from, float to) {
    std::set<std::size_t> segments;
    const CurveTally tally = tally_of(cost, {bone_between({from, 0.2f, 0}, {to, 0, -0.3f})});
    for (std::size_t s = 0; s < tally.uses.size(); ++s) {
      if (tally.uses[s] > 0) segments.insert(s);
    }
    EXPECT_EQ(tally.cost[2], in_units(-10) * static_cast<std::int64_t>(segments.size()));
    return segments;
  };
  using Segments = std::set<std::size_t>;
  EXPECT_EQ(used(0.1f, 0.4f), (Segments{0}));
  EXPECT_EQ(used(0.4f, 0.6f), (Segments{0, 1}));
  EXPECT_EQ(used(0.6f, 2.2f), (Segments{1, 2, 3, 4}));
  EXPECT_EQ(used(2.2f, 0.6f), (Segments{1, 2, 3, 4}));
  EXPECT_EQ(used(-9, -1), (Segments{0}));
  EXPECT_EQ(used(5, 9), (Segments{7}));
  EXPECT_EQ(used(-1, 9).size(), 8u);
}

// The tip counts where it is along the curve of the base, whichever is nearest to it.
TEST(CurveCost, TheCurveOfTheBaseJudgesTheTip) {
  GuidingCurve low = straight(), high = straight();
  for (Vec3& p : high.curve.points) p.y = 1;
  low.utilisation = 10, high.utilisation = 1000;
  CurveSettings settings;
  settings.curves = {high, low};
  const CurveCost cost(settings);
  const CurveTally tally = tally_of(cost, {bone_between({0.1f, 0, 0}, {0.7f, 1, 0})});
  EXPECT_EQ(tally.cost[2], in_units(-20));
  EXPECT_EQ(std::count(tally.uses.begin(), tally.uses.begin() + 8, 0), 8);
  EXPECT_EQ(std::count(tally.uses.begin() + 8, tally.uses.end(), 1), 2);
}

TEST(CurveCost, FurtherUsesAreWorthLessByE) {
  GuidingCurve guide = straight();
  guide.utilisation = 20;
  const CurveCost cost(only(guide));
  CurveTally tally;
  cost.reset(tally);
  std::int64_t before = 0;
  for (int n = 0; n < 300; ++n) {
    cost.add_bone({1.1f, 0, 0}, {1.2f, 0, 0}, tally);
    EXPECT_EQ(tally.cost[2] - before, in_units(-20 * std::exp(-n))) << n;
    before = tally.cost[2];
  }
  EXPECT_NEAR(in_cost(tally.cost[2]), -20 / (1 - std::exp(-1.0)), 1e-4);
  EXPECT_EQ(tally.uses[2], 255);
}

TEST(CurveCost, WithoutWorthNoSegmentIsUsed) {
  const CurveTally tally = tally_of(CurveCost(only(straight())), {bone_between({0, 0, 0}, {4, 0, 0})});
  EXPECT_EQ(tally.uses, std::vector<std::uint8_t>(8));
  EXPECT_EQ(tally.total(), 0);
  EXPECT_TRUE(tally.crowd.empty());
}

TEST(CurveCost, WithinTheThicknessDistanceCostsNothing) {
  GuidingCurve guide = straight();
  guide.distance = {3, 0, 100};
  guide.thickness = {0.2, 1};
  const CurveCost cost(only(guide));
  const auto of = [&](float x, float y) {
    return in_cost(tally_of(cost, {bone_between({x, y, 0}, {x, y, 1})}).cost[0]);
  };
  EXPECT_EQ(of(0, 0.19f), 3);
  EXPECT_EQ(of(2, 0.59f), 3);
  EXPECT_EQ(of(4, 0.99f), 3);
  EXPECT_NEAR(of(0, 1.2f), 103, 0.01);
  EXPECT_NEAR(of(1, 1.4f), 103, 0.01);
  EXPECT_NEAR(of(2.1f, 1.62f), 103, 0.01);
  EXPECT_NEAR(of(4, 2), 103, 0.01);
}

// The radius grows with the length, however unevenly t runs and however long segments are.
TEST(CurveCost, ThicknessIsLinearAlongTheLength) {
  for (const double segment : {0.02, 10.0}) {
    GuidingCurve guide = straight();
    guide.curve = {{{{0, 0, 0}, {0.1f, 0, 0}, {0.4f, 0, 0}, {4, 0, 0}}}};
    guide.segment = segment;
    guide.distance = {0, 1, 0};
    guide.thickness = {0, 2};
    const CurveCost cost(only(guide));
    for (int i = 0; i <= 40; ++i) {
      const float x = 0.1f * static_cast<float>(i);
      const double beyond = in_cost(tally_of(cost, {bone_between({x, 3, 0}, {x, 3, 1})}).cost[0]);
      EXPECT_NEAR(beyond, 3 - x / 2, 1e-3) << x << " " << segment;
    }
  }
}

TEST(CurveCost, CrowdsCostTheSquareOfTheExcess) {
  CurveSettings settings = only(straight());
  settings.density = somewhere(1, 2.5, 4);  // 2 x 2 x 2 cells of which the upper ones reach beyond the region
  const CurveCost cost(settings);
  CurveTally tally;
  cost.reset(tally);
  ASSERT_EQ(tally.crowd.size(), 8u);
  const auto add = [&](const Vec3& middle) {
    cost.add_bone(middle - Vec3(0.5f, 2, 0), middle + Vec3(0.5f, 2, 0), tally);
    return in_cost(tally.cost[3]);
  };
  const Vec3 one(-0.5f, -0.5f, -0.5f), other(0.5f, -0.5f, -0.5f);
  EXPECT_EQ(add(one), 0);
  EXPECT_EQ(add(one), 0);
  EXPECT_EQ(add(one), 4 * 0.25);
  EXPECT_EQ(add(other), 1);
  EXPECT_EQ(add(one), 4 * 2.25);
  EXPECT_EQ(add(other), 9);
  EXPECT_EQ(add(other), 10);
  for (const Vec3& beyond : {Vec3(1.01f, 0, 0), Vec3(0, 0.88f, 0), Vec3(0, 0, -1.01f), Vec3(kInfinite, 0, 0)}) {
    EXPECT_EQ(add(beyond), 10);
  }
  EXPECT_EQ(std::count(tally.crowd.begin(), tally.crowd.end(), 0), 6);
  EXPECT_EQ(add(Vec3(1, 0.875f, 1)), 10);  // the far corner belongs to the region
  EXPECT_EQ(tally.crowd.back(), 1);
  EXPECT_EQ(add(Vec3(-1, -1, -1)), 26);
}

// Sums are exact: what one bone costs is a whole number of units, and taking it off again leaves nothing.
TEST(CurveCost, AccountsAreWholeNumbers) {
  RandomStream random = curve_stream(190);
  const CurveSettings settings = random_settings(random, 2);
  const ReferenceCurves reference(settings);
  const CurveCost cost(settings);
  for (const Bone& bone : random_skeleton(reference, random, 40)) {
    const BoneEffect effect = cost.judge(cost.nearest(bone.from), bone.from, bone.to);
    const ReferencePoint base = reference.nearest(DVec3(bone.from));
    EXPECT_EQ(effect.curve, base.curve);
    EXPECT_NEAR(in_cost(effect.distance), reference.distance_cost(base), 1e-3);
    EXPECT_NEAR(in_cost(effect.alignment), reference.alignment(base, DVec3(bone.to) - DVec3(bone.from)), 0.02);
    EXPECT_EQ(effect.cell, 0xffff);
    CurveTally tally;
    cost.reset(tally);
    cost.add(effect, tally);
    EXPECT_EQ(tally, tally_of(cost, {bone}));
    EXPECT_EQ(tally.total(), effect.distance + effect.alignment + tally.cost[2]);
  }
}

TEST(CurveCost, EveryTermIsBounded) {
  GuidingCurve guide = straight();
  guide.distance = {0, 0, 1e6};
  guide.alignment = 400;
  CurveSettings settings = only(guide);
  settings.density = somewhere(0.5, 1, 1);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {1e30f, -1e38f, kInfinite, not_a_number}) {
    const CurveTally tally = tally_of(CurveCost(settings), {bone_between({x, 0, 0}, {0, 1, 0})});
    EXPECT_EQ(tally.cost[0], in_units(kMostCost)) << x;
    EXPECT_LE(std::abs(tally.cost[1]), in_units(kMostCost)) << x;
    EXPECT_EQ(tally.cost[3], 0) << x;
  }
  settings.curves[0].distance = {0, 0, -1e6};
  EXPECT_EQ(tally_of(CurveCost(settings), {bone_between({1e30f, 0, 0}, {0, 1, 0})}).cost[0], -in_units(kMostCost));
}

TEST(CurveCost, RefusesWhatIsNotValid) {
  CurveSettings settings = only(straight());
  settings.curves[0].offset = 2;
  EXPECT_THROW(CurveCost{settings}, Error);
}

}  // namespace
}  // namespace espalier
