#include "score/curve_field.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "score/curve_cost.h"
#include "score/random_curves.h"

namespace espalier {
namespace {

using namespace test;

std::vector<CubicBezier> beziers(const CurveSettings& settings) {
  std::vector<CubicBezier> curves;
  for (const GuidingCurve& guide : settings.curves) curves.push_back(guide.curve);
  return curves;
}

/// Curves with a field over them.
struct Charted {
  CurveSettings settings;
  CurveFinder finder;
  CurveField field;

  Charted(const CurveSettings& s) : settings(s), finder(beziers(s), s.blend), field(settings, finder) {}
};

CurveSettings gentle(RandomStream& random, std::size_t curves, std::uint32_t cells, bool blend = false) {
  CurveSettings settings = random_settings(random, curves);
  settings.field_cells = cells;
  settings.blend = blend;
  return settings;
}

Vec3 place_in(const Bounds& box, RandomStream& random) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = box.min[axis] + static_cast<float>(random.next_unit()) * box.size()[axis];
  }
  return p;
}

/// A step of so many cells to any side leads to another curve, or to another part of the curve.
bool is_near_seam(const Charted& charted, const CurvePoint& at, const Vec3& p, float cells) {
  const float step = cells * charted.field.cell();
  for (int side = 0; side < 6; ++side) {
    Vec3 q = p;
    q[side / 2] += side % 2 ? step : -step;
    const CurvePoint there = charted.finder.nearest(q);
    if (there.curve != at.curve) return true;
    const CubicBezier& curve = charted.settings.curves[at.curve].curve;
    if (glm::length(point_at(curve, there.t) - point_at(curve, at.t)) > 4 * step) return true;
  }
  return false;
}

struct FieldErrors {
  std::vector<double> distance, angle;  // cells; degrees

  void add(double d, double a) { distance.push_back(d), angle.push_back(a); }
};

double share_of(std::vector<double> values, double share) {
  const std::size_t i = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values.end());
  return values[i];
}

/// All, and those that are further than a cell from seams and two from curves.
struct Measured {
  FieldErrors all, away;
};

Measured errors_of(std::uint32_t cells, std::uint32_t sets, int points) {
  Measured measured;
  for (std::uint32_t k = 0; k < sets; ++k) {
    RandomStream random = curve_stream(400 + k);
    const Charted charted(gentle(random, 5, cells));
    for (int i = 0; i < points; ++i) {
      const Vec3 p = place_in(charted.field.box(), random);
      const CurvePoint truth = charted.finder.nearest(p), read = charted.field.nearest(p);
      const double distance = std::abs(double{read.distance} - truth.distance) / charted.field.cell();
      const double angle = std::acos(std::clamp(double{glm::dot(read.tangent, truth.tangent)}, -1.0, 1.0)) * 57.2958;
      measured.all.add(distance, angle);
      const bool close = truth.distance < 2 * charted.field.cell();
      if (!close && !is_near_seam(charted, truth, p, 1)) measured.away.add(distance, angle);
    }
  }
  return measured;
}

// The figures of curve_field.h.
TEST(CurveField, ErrorsAreAsStated) {
  const Measured measured = errors_of(32, 6, 1500);
  EXPECT_LT(share_of(measured.all.distance, 0.5), 0.03);
  EXPECT_LT(share_of(measured.all.distance, 0.95), 0.12);
  EXPECT_LT(share_of(measured.all.distance, 1), 0.87);
  EXPECT_LT(share_of(measured.all.angle, 0.5), 0.1);
  EXPECT_LT(share_of(measured.all.angle, 0.95), 25);
  EXPECT_GT(measured.away.distance.size(), measured.all.distance.size() / 2);
  EXPECT_LT(share_of(measured.away.distance, 0.5), 0.03);
  EXPECT_LT(share_of(measured.away.distance, 0.95), 0.06);
  EXPECT_LT(share_of(measured.away.angle, 0.5), 0.05);
  EXPECT_LT(share_of(measured.away.angle, 0.95), 1.5);
  // They are there: the field is not the finder.
  EXPECT_GT(share_of(measured.all.distance, 0.5), 1e-3);
  EXPECT_GT(share_of(measured.all.angle, 0.95), 1);
}

TEST(CurveField, ErrorsFallWithTheSquareOfTheCell) {
  const Measured coarse = errors_of(16, 4, 1000), fine = errors_of(32, 4, 1000);
  const double of_coarse = 2 * share_of(coarse.away.distance, 0.5), of_fine = share_of(fine.away.distance, 0.5);
  EXPECT_LT(of_fine, 0.35 * of_coarse);  // in lengths: 0.25 by theory
  EXPECT_GT(of_fine, 0.15 * of_coarse);
}

TEST(CurveField, IsTheFinderAtItsNodes) {
  RandomStream random = curve_stream(420);
  const Charted charted(gentle(random, 3, 12));
  const Bounds& box = charted.field.box();
  int nodes = 0;
  for (int x = 0; x <= 12; ++x) {
    for (int y = 0; y <= 12; ++y) {
      const Vec3 p = box.min + charted.field.cell() * Vec3(static_cast<float>(x), static_cast<float>(y), 3);
      if (p.x > box.max.x || p.y > box.max.y) continue;
      const CurvePoint truth = charted.finder.nearest(p), read = charted.field.nearest(p);
      EXPECT_NEAR(read.distance, truth.distance, 1e-5);
      EXPECT_NEAR(glm::length(read.tangent - truth.tangent), 0, 1e-4);
      EXPECT_EQ(read.curve, truth.curve);
      EXPECT_NEAR(read.t, truth.t, 1e-4);
      for (std::uint32_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(charted.field.parameter_on(c, p), charted.finder.parameter_on(c, p), 1e-4);
      }
      ++nodes;
    }
  }
  EXPECT_GT(nodes, 40);
}

TEST(CurveField, BeyondTheGridItIsExact) {
  RandomStream random = curve_stream(421);
  for (const bool blend : {false, true}) {
    const Charted charted(gentle(random, 3, 8, blend));
    const Bounds& box = charted.field.box();
    int outside = 0, inside_differs = 0;
    for (int i = 0; i < 600; ++i) {
      const Vec3 p = box.centre() + random_place(random, 1) * box.size();
      const CurvePoint truth = charted.finder.nearest(p), read = charted.field.nearest(p);
      bool same = read.curve == truth.curve && read.t == truth.t && read.distance == truth.distance &&
                  read.tangent == truth.tangent;
      for (std::uint32_t c = 0; c < 3; ++c) {
        same = same && charted.field.parameter_on(c, p) == charted.finder.parameter_on(c, p);
      }
      const bool inside = p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
                          p.y <= box.max.y && p.z <= box.max.z;
      EXPECT_TRUE(inside || same);
      outside += !inside;
      inside_differs += inside && !same;
    }
    EXPECT_GT(outside, 100);
    EXPECT_GT(inside_differs, 50);
  }
}

TEST(CurveField, ReachesAQuarterOfTheExtentBeyondTheCurves) {
  RandomStream random = curve_stream(422);
  for (int k = 0; k < 20; ++k) {
    const CurveSettings settings = gentle(random, 2, 8 + random.below(10));
    const Charted charted(settings);
    Bounds curves;
    for (const GuidingCurve& guide : settings.curves) {
      for (const Vec3& p : guide.curve.points) curves.add(p);
    }
    const Vec3 size = curves.size();
    const float largest = std::max({size.x, size.y, size.z});
    EXPECT_NEAR(charted.field.cell(), 1.5f * largest / static_cast<float>(settings.field_cells), 1e-5);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(charted.field.box().min[axis], curves.min[axis] - largest / 4, 1e-5);
      EXPECT_GE(charted.field.box().max[axis], curves.max[axis] + largest / 4 - 1e-4);
      EXPECT_LE(charted.field.box().max[axis], curves.max[axis] + largest / 4 + charted.field.cell() + 1e-4);
    }
  }
}

TEST(CurveField, ParametersStayInRangeAndTangentsUnit) {
  RandomStream random = curve_stream(423);
  for (const CurveShape shape : kCurveShapes) {
    CurveSettings settings = gentle(random, 2, 9);
    settings.curves[0].curve = random_curve(random, shape);
    const Charted charted(settings);
    for (int i = 0; i < 300; ++i) {
      const CurvePoint read = charted.field.nearest(place_in(charted.field.box(), random));
      EXPECT_TRUE(read.t >= 0 && read.t <= 1) << read.t;
      EXPECT_GE(read.distance, 0);
      const float length = glm::length(read.tangent);
      EXPECT_TRUE(std::abs(length - 1) < 1e-5f || length == 0) << length;
    }
  }
}

// Through CurveCost: bones cost nearly the same, though not quite.
TEST(CurveField, CostsAreNearTheExactOnes) {
  RandomStream random = curve_stream(424);
  CurveSettings settings = gentle(random, 3, 0);
  const CurveCost exact(settings);
  settings.field_cells = 48;
  const CurveCost by_field(settings);
  CurveTally a, b;
  exact.reset(a), by_field.reset(b);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = random_place(random, 1.2), to = from + random_place(random, 0.3);
    exact.add_bone(from, to, a), by_field.add_bone(from, to, b);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = static_cast<double>(a.cost[i]), y = static_cast<double>(b.cost[i]);
    EXPECT_NE(x, y);
    EXPECT_NEAR(y / x, 1, 0.03) << i;
  }
}

}  // namespace
}  // namespace espalier
