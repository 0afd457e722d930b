#include "score/curve_finder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "score/random_curves.h"

namespace espalier {
namespace {

using namespace test;

CurveSettings settings_of(const std::vector<CubicBezier>& curves, bool blend = false) {
  CurveSettings settings;
  settings.blend = blend;
  for (const CubicBezier& curve : curves) settings.curves.emplace_back().curve = curve;
  return settings;
}

double at_share(std::vector<double> values, double share) {
  const std::size_t i = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values.end());
  return values[i];
}

using FindPoint = std::function<CurvePoint(const CurveFinder& finder, const CubicBezier& curve, const Vec3& p)>;

CurvePoint found(const CurveFinder& finder, const CubicBezier&, const Vec3& p) { return finder.nearest(p); }

struct FinderErrors {
  double distance = 0;           // greatest, m per metre between point and origin, and one more
  std::vector<double> t, angle;  // where no other valley is as near
};

/// Against the reference, from points up to so many metres away. Curves are a metre or so large.
FinderErrors errors_of(const FindPoint& find, CurveShape shape, double reach, int curves, int points) {
  RandomStream random = curve_stream(static_cast<std::uint32_t>(shape));
  FinderErrors errors;
  for (int k = 0; k < curves; ++k) {
    const CubicBezier curve = random_curve(random, shape);
    const ReferenceCurves reference(settings_of({curve}));
    const CurveFinder finder({curve}, false);
    for (int i = 0; i < points; ++i) {
      const Vec3 p = random_place(random, reach);
      const ReferencePoint truth = reference.closest(0, DVec3(p));
      const CurvePoint point = find(finder, curve, p);
      EXPECT_TRUE(point.curve == 0 && point.t >= 0 && point.t <= 1) << point.t;
      const double there = glm::length(reference.point(0, point.t) - DVec3(p));
      const double error = std::max(std::abs(there - truth.distance), std::abs(point.distance - truth.distance));
      const double scale = 1 + glm::length(DVec3(p));
      errors.distance = std::max(errors.distance, error / scale);
      if (truth.rival - truth.distance < 1e-3 * scale) continue;
      errors.t.push_back(std::abs(point.t - truth.t));
      errors.angle.push_back(glm::length(DVec3(point.tangent) - truth.tangent));
    }
  }
  return errors;
}

TEST(CurveFinder, FindsTheClosestPointOfEveryKindOfCurve) {
  for (const CurveShape shape : kCurveShapes) {
    SCOPED_TRACE(static_cast<int>(shape));
    const bool stands = shape == CurveShape::standing_start || shape == CurveShape::standing_end;
    for (const double reach : {1.0, 3.0}) {
      // Newton's method is slow where the curve stands still, and about the centre of its bend.
      EXPECT_LT(errors_of(found, shape, reach, 60, 20).distance, stands ? 1e-4 : 2e-5) << reach;
    }
  }
}

// Floats hold a distance to 6e-8 of itself, and coordinates too.
TEST(CurveFinder, FindsItFromFarAway) {
  for (const CurveShape shape : kCurveShapes) {
    SCOPED_TRACE(static_cast<int>(shape));
    for (const double reach : {100.0, 1e4, 1e5}) EXPECT_LT(errors_of(found, shape, reach, 40, 10).distance, 1e-6);
  }
}

// Parameters are as good, but near the centre of the curve's bend, where many are nearly as near.
TEST(CurveFinder, ParametersAndTangentsAreAsGood) {
  for (const double reach : {1.0, 3.0, 100.0}) {
    const FinderErrors errors = errors_of(found, CurveShape::wild, reach, 150, 20);
    EXPECT_GT(errors.t.size(), 2500u);
    EXPECT_LT(at_share(errors.t, 0.5), 1e-7);
    EXPECT_LT(at_share(errors.t, 0.99), 1e-6);
    EXPECT_LT(at_share(errors.t, 1), 0.02);
    EXPECT_LT(at_share(errors.angle, 0.99), 1e-5);
    EXPECT_LT(at_share(errors.angle, 1), 0.15);
  }
}

// What the tests above can see: finders that look at x and y alone, at chords alone, at one start, or stop too soon.
TEST(CurveFinder, WrongFindersAreSeen) {
  const auto worst = [](const FindPoint& find) { return errors_of(find, CurveShape::wild, 1, 60, 20).distance; };
  const auto by_samples = [&](int samples, bool flat) {
    return [=](const CurveFinder&, const CubicBezier& curve, const Vec3& p) {
      CurvePoint best;
      best.distance = std::numeric_limits<float>::infinity();
      double least = best.distance;
      for (int i = 0; i <= samples; ++i) {
        const double t = static_cast<double>(i) / samples;
        DVec3 away = point_at(curve, t) - DVec3(p);
        const double distance = glm::length(away);
        if (flat) away.z = 0;
        if (glm::length(away) >= least) continue;
        least = glm::length(away);
        best.t = static_cast<float>(t);
        best.distance = static_cast<float>(distance);
      }
      return best;
    };
  };
  EXPECT_GT(worst(by_samples(1000, true)), 0.1);
  EXPECT_GT(worst(by_samples(100, false)), 1e-4);
  const auto downhill = [&](int turns) {
    return [=](const CurveFinder&, const CubicBezier& curve, const Vec3& p) {
      double t = 0.5;
      for (int turn = 0; turn < turns; ++turn) {
        const DVec3 away = point_at(curve, t) - DVec3(p), along = derivative_at(curve, t);
        t = std::clamp(t - glm::dot(away, along) / glm::dot(along, along), 0.0, 1.0);
      }
      CurvePoint point;
      point.t = static_cast<float>(t);
      point.distance = static_cast<float>(glm::length(point_at(curve, t) - DVec3(p)));
      return point;
    };
  };
  EXPECT_GT(worst(downhill(100)), 0.1);
}

TEST(CurveFinder, TangentsAreUnitVectors) {
  RandomStream random = curve_stream(20);
  for (const CurveShape shape : kCurveShapes) {
    SCOPED_TRACE(static_cast<int>(shape));
    for (int k = 0; k < 100; ++k) {
      const CubicBezier curve = random_curve(random, shape);
      const CurveFinder alone({curve}, false), blended({curve, random_curve(random)}, true);
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = i == 0 ? curve.points[0] : i == 1 ? curve.points[3] : random_place(random, 1.5);
        const float length = glm::length(alone.nearest(p).tangent);
        EXPECT_NEAR(length, shape == CurveShape::point ? 0 : 1, 1e-6);
        if (shape == CurveShape::point && i < 2) continue;  // nothing is nearer, and it has none
        EXPECT_NEAR(glm::length(blended.nearest(p).tangent), 1, 1e-6);
      }
    }
  }
}

// Where control points coincide the derivative is no more than rounding.
TEST(CurveFinder, TangentsAtStandingEndsLeadOnAlongTheCurve) {
  RandomStream random = curve_stream(21);
  for (const CurveShape shape : {CurveShape::standing_start, CurveShape::standing_end}) {
    for (int k = 0; k < 300; ++k) {
      const CubicBezier curve = random_curve(random, shape);
      const ReferenceCurves reference(settings_of({curve}));
      const Vec3 end = curve.points[shape == CurveShape::standing_start ? 0 : 3];
      const CurvePoint at = CurveFinder({curve}, false).nearest(end);
      EXPECT_LT(glm::length(DVec3(at.tangent) - reference.tangent(0, at.t)), 0.05) << static_cast<int>(shape);
    }
  }
}

TEST(CurveFinder, FindsTheNearestCurve) {
  RandomStream random = curve_stream(22);
  int ties = 0, looked = 0;
  std::map<std::uint32_t, int> chosen;
  for (int k = 0; k < 60; ++k) {
    std::vector<CubicBezier> curves;
    for (std::uint32_t n = 2 + random.below(7); n > 0; --n) curves.push_back(random_curve(random, kCurveShapes[random.below(8)]));
    const ReferenceCurves reference(settings_of(curves));
    const CurveFinder finder(curves, false);
    EXPECT_EQ(finder.size(), curves.size());
    for (int i = 0; i < 20; ++i, ++looked) {
      const Vec3 p = random_place(random, i % 4 == 0 ? 10 : 1.5);
      const ReferencePoint truth = reference.nearest(DVec3(p));
      const CurvePoint point = finder.nearest(p);
      ASSERT_NEAR(point.distance, truth.distance, 1e-4);
      ++chosen[point.curve];
      EXPECT_EQ(point.t, finder.parameter_on(point.curve, p));
      if (truth.rival - truth.distance < 1e-4) ++ties;
      else EXPECT_EQ(point.curve, truth.curve);
    }
  }
  EXPECT_LT(ties, looked / 20);
  EXPECT_GE(chosen.size(), 8u);
}

TEST(CurveFinder, OfEquallyNearCurvesTakesTheFirst) {
  RandomStream random = curve_stream(23);
  for (int k = 0; k < 50; ++k) {
    const CubicBezier a = random_curve(random), b = random_curve(random);
    const Vec3 p = random_place(random, 2);
    const std::uint32_t one = CurveFinder({a, b}, false).nearest(p).curve;
    EXPECT_EQ(CurveFinder({a, b, a, b}, false).nearest(p).curve, one);
    EXPECT_EQ(CurveFinder({b, a, b, a}, false).nearest(p).curve, 1 - one);
  }
}

/// The greatest leap of the tangent on the way from one point to another.
double greatest_leap(const CurveFinder& finder, const Vec3& from, const Vec3& to, int steps, int& seams) {
  double greatest = 0;
  CurvePoint before = finder.nearest(from);
  for (int i = 1; i <= steps; ++i) {
    const CurvePoint here = finder.nearest(from + (to - from) * (static_cast<float>(i) / static_cast<float>(steps)));
    greatest = std::max(greatest, double{glm::length(here.tangent - before.tangent)});
    seams += here.curve != before.curve;
    before = here;
  }
  return greatest;
}

TEST(CurveFinder, BlendingHidesTheSeam) {
  RandomStream random = curve_stream(24);
  int seams = 0, pairs = 0;
  while (pairs < 40) {
    // Lines have one valley each, so that the tangent leaps nowhere else.
    const CubicBezier a = random_curve(random, CurveShape::line), b = random_curve(random, CurveShape::line);
    const Vec3 along_a = glm::normalize(a.points[3] - a.points[0]), along_b = glm::normalize(b.points[3] - b.points[0]);
    const float apart = glm::length(along_a - along_b);
    if (apart < 0.5f || apart > 1.8f) continue;  // no seam to see, or no way between
    ++pairs;
    const Vec3 from = a.points[0], to = b.points[3];
    int here = 0;
    EXPECT_GT(greatest_leap(CurveFinder({a, b}, false), from, to, 2000, here), 0.45);
    EXPECT_LT(greatest_leap(CurveFinder({a, b}, true), from, to, 2000, here), 0.1);
    seams += here;
  }
  EXPECT_GE(seams, 2 * pairs);
}

TEST(CurveFinder, BlendsByDistance) {
  const CubicBezier along_x{{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}};
  const CubicBezier along_z{{{{1, 4, -1}, {1, 4, 0}, {1, 4, 1}, {1, 4, 2}}}};
  const CurveFinder finder({along_x, along_z}, true);
  const auto tangent_at = [&](float y) { return finder.nearest({1, y, 0}).tangent; };
  EXPECT_EQ(tangent_at(0), Vec3(1, 0, 0));
  EXPECT_EQ(tangent_at(4), Vec3(0, 0, 1));
  EXPECT_NEAR(glm::length(tangent_at(2) - glm::normalize(Vec3(1, 0, 1))), 0, 1e-6);
  EXPECT_NEAR(glm::length(tangent_at(1) - glm::normalize(Vec3(3, 0, 1))), 0, 1e-6);
  EXPECT_NEAR(glm::length(tangent_at(3) - glm::normalize(Vec3(1, 0, 3))), 0, 1e-6);
  EXPECT_EQ(finder.nearest({1, 1, 0}).curve, 0u);
  EXPECT_EQ(finder.nearest({1, 3, 0}).curve, 1u);
  EXPECT_NEAR(finder.nearest({1, 1, 0}).distance, 1, 1e-6);
}

TEST(CurveFinder, BlendsTheTwoNearestAsTheReferenceDoes) {
  RandomStream random = curve_stream(25);
  int compared = 0, steady = 0;
  for (int k = 0; k < 20; ++k) {
    std::vector<CubicBezier> curves;
    for (int i = 0; i < 3; ++i) curves.push_back(gentle_curve(random));
    const ReferenceCurves reference(settings_of(curves, true));
    const CurveFinder finder(curves, true);
    for (int i = 0; i < 20; ++i) {
      const DVec3 p(random_place(random, 2));
      if (!is_steady(reference, p)) continue;
      const CurvePoint point = finder.nearest(Vec3(p));
      const double apart = glm::length(DVec3(point.tangent) - reference.nearest(p).tangent);
      compared += apart < 1e-3;
      ++steady;
    }
  }
  EXPECT_GT(steady, 300);
  EXPECT_GT(compared, steady * 98 / 100);  // the second curve may be near a tie of its own
}

TEST(CurveFinder, OneCurveIsNotBlended) {
  RandomStream random = curve_stream(26);
  const CubicBezier curve = random_curve(random);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = random_place(random, 2);
    EXPECT_EQ(CurveFinder({curve}, true).nearest(p).tangent, CurveFinder({curve}, false).nearest(p).tangent);
  }
}

}  // namespace
}  // namespace espalier
