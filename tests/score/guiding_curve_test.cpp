#include "score/guiding_curve.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

CurveSettings three_curves() {
  CurveSettings settings;
  settings.curves.resize(3);
  for (GuidingCurve& guide : settings.curves) guide.curve = {{{{0, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 2, 1}}}};
  settings.density = BoneDensity{};
  return settings;
}

/// What is wrong with the settings after the change; empty if nothing is.
template <class Change>
std::string fault_after(const Change& change) {
  CurveSettings settings = three_curves();
  change(settings);
  try {
    validate(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The same for one of the curves.
template <class Change>
std::string curve_fault(const Change& change) {
  return fault_after([&](CurveSettings& s) { change(s.curves[2]); });
}

template <class Change>
std::string density_fault(const Change& change) {
  return fault_after([&](CurveSettings& s) { change(*s.density); });
}

TEST(GuidingCurveSettings, DefaultsAreValid) { EXPECT_EQ(fault_after([](CurveSettings&) {}), ""); }

TEST(GuidingCurveSettings, ErrorsNameCurveSettingAndValue) {
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.offset = 1.5; }), "curve.2.offset must be -1 to 1, got 1.5");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.segment = -0.25; }), "curve.2.segment must be above 0, got -0.25");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.alignment = -3; }), "curve.2.alignment must be 0 to 1000000, got -3");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.utilisation = 1e7; }),
            "curve.2.utilisation must be 0 to 1000000, got 10000000");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.thickness[1] = -1; }),
            "curve.2.thickness must be 0 to 100000, got -1");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.distance[1] = -2e6; }),
            "curve.2.distance must be -1000000 to 1000000, got -2000000");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.curve.points[3].z = 2e5f; }),
            "curve.2.points must be -100000 to 100000, got 200000");
}

TEST(GuidingCurveSettings, TheFirstFaultIsTold) {
  const std::string fault = fault_after([](CurveSettings& s) { s.curves[1].offset = 3, s.curves[2].offset = 4; });
  EXPECT_EQ(fault, "curve.1.offset must be -1 to 1, got 3");
}

TEST(GuidingCurveSettings, EveryCurveIsLookedAt) {
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_EQ(fault_after([&](CurveSettings& s) { s.curves[i].alignment = -1; }),
              "curve." + std::to_string(i) + ".alignment must be 0 to 1000000, got -1");
  }
}

TEST(GuidingCurveSettings, BoundsAreAllowed) {
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.offset = -1, g.thickness = {0, 1e5}, g.alignment = 0; }), "");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.offset = 1, g.utilisation = 1e6, g.distance = {-1e6, 0, 1e6}; }), "");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.segment = 1e300; }), "");
  EXPECT_EQ(curve_fault([](GuidingCurve& g) { g.curve.points.fill(Vec3(1e5f)); }), "");  // no more than a point
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.curves.resize(64, s.curves[0]), s.field_cells = 8; }), "");
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.field_cells = 128; }), "");
}

TEST(GuidingCurveSettings, WhatIsNoNumberIsRefusedEverywhere) {
  EXPECT_THAT(curve_fault([](GuidingCurve& g) { g.offset = kNotANumber; }), HasSubstr("curve.2.offset"));
  EXPECT_THAT(curve_fault([](GuidingCurve& g) { g.alignment = kNotANumber; }), HasSubstr("curve.2.alignment"));
  EXPECT_THAT(curve_fault([](GuidingCurve& g) { g.utilisation = kNotANumber; }), HasSubstr("curve.2.utilisation"));
  EXPECT_THAT(curve_fault([](GuidingCurve& g) { g.segment = kNotANumber; }), HasSubstr("curve.2.segment"));
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_THAT(curve_fault([&](GuidingCurve& g) { g.distance[i] = kNotANumber; }), HasSubstr("curve.2.distance"));
  }
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_THAT(curve_fault([&](GuidingCurve& g) { g.thickness[i] = kNotANumber; }), HasSubstr("curve.2.thickness"));
  }
  for (std::size_t i = 0; i < 12; ++i) {
    const auto nan_point = [&](GuidingCurve& g) { g.curve.points[i / 3][static_cast<int>(i % 3)] = kNotANumber; };
    EXPECT_THAT(curve_fault(nan_point), HasSubstr("curve.2.points"));
  }
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.min.y = kNotANumber; }), HasSubstr("density.min"));
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.max.z = kNotANumber; }), HasSubstr("density.max"));
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.cell = kNotANumber; }), HasSubstr("density.cell"));
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.wanted = kNotANumber; }), HasSubstr("density.wanted"));
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.cost = kNotANumber; }), HasSubstr("density.cost"));
}

TEST(GuidingCurveSettings, LimitsTheNumberOfCurvesAndSegments) {
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.curves.clear(); }), "there must be 1 to 64 guiding curves, got 0");
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.curves.resize(65, s.curves[0]); }),
            "there must be 1 to 64 guiding curves, got 65");
  const double length = length_to(three_curves().curves[0].curve, 1);
  EXPECT_EQ(curve_fault([&](GuidingCurve& g) { g.segment = length / 1023.9; }), "");
  EXPECT_EQ(curve_fault([&](GuidingCurve& g) { g.segment = length / 1999.5; }).substr(0, 53),
            "curve.2.segment must leave at most 1024 segments, got");
  EXPECT_THAT(curve_fault([&](GuidingCurve& g) { g.segment = length / 1999.5; }), HasSubstr(": 2000 of them"));
}

TEST(GuidingCurveSettings, LimitsTheField) {
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.field_cells = 7; }), "field_cells must be 8 to 128, got 7");
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.field_cells = 129; }), "field_cells must be 8 to 128, got 129");
  EXPECT_EQ(fault_after([](CurveSettings& s) { s.curves.resize(64, s.curves[0]), s.field_cells = 100; }),
            "field_cells must be smaller with so many curves, got 100 with 64");
}

TEST(GuidingCurveSettings, LimitsTheDensity) {
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.cell = 0; }), "density.cell must be above 0 and finite, got 0");
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.cell = kEndless; }),
            "density.cell must be above 0 and finite, got inf");
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.wanted = -1; }), "density.wanted must be 0 to 1000000000, got -1");
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.cost = -1; }), "density.cost must be 0 to 1000000, got -1");
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.min.x = -2e5f; }), "density.min must be -100000 to 100000, got -200000");
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.max.y = d.min.y; }), HasSubstr("density.max must be above"));
  EXPECT_EQ(density_fault([](BoneDensity& d) { d.cell = 1.0 / 16; }), "");
  EXPECT_THAT(density_fault([](BoneDensity& d) { d.cell = 1.0 / 17; }),
              AllOf(HasSubstr("density.cell must leave at most 4096 cells"), HasSubstr("4913 of them")));
}

}  // namespace
}  // namespace espalier
