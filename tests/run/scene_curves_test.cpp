#include "run/scene_curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "run/fixtures.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kPoints = "points = [[0, 0, 0], [0, 1, 0], [1, 1, 1], [2, 2, 1]]\n";

std::string scene_text(const std::string& curves) {
  return "espalier = 1\ngrammar = \"tree.esp\"\nbudget.generations = 1\n" + curves;
}

Scene parsed(const std::string& curves) { return parse_scene(scene_text(curves), "tree.toml", ""); }

std::string error_of(const std::string& curves) {
  try {
    parsed(curves);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Lines 4 and 5 are the head and the points of the curve, line 6 is `line`.
std::string error_of_curve(const std::string& line) {
  return error_of("[[curves.curve]]\n" + std::string(kPoints) + line + "\n");
}

std::string error_of_density(const std::string& lines) {
  return error_of("[[curves.curve]]\n" + std::string(kPoints) + "[curves.density]\n" + lines);
}

TEST(SceneCurves, WrittenOutTheyReadBackEqual) {
  const Scene scene = parsed(std::string("[curves]\nweight = 0.25\nblend = true\nfield_cells = 24\n") +
                             "[[curves.curve]]\n" + kPoints +
                             "distance = [-3, 0.1, 250]\nalignment = 33.3\noffset = -0.7\nutilisation = 7\n"
                             "segment = 0.3\nthickness = [0.5, 0.05]\n"
                             "[[curves.curve]]\n" + kPoints + "thickness = 2\n"
                             "[curves.density]\nmin = [-1, 0, -1.5]\nmax = [1, 2, 1]\ncell = 0.25\nwanted = 0\n"
                             "cost = 12.5\n");
  const CurveSettings& settings = scene.curves.settings;
  EXPECT_EQ(scene.curves.weight, 0.25);
  EXPECT_TRUE(settings.blend);
  EXPECT_EQ(settings.field_cells, 24u);
  ASSERT_EQ(settings.curves.size(), 2u);
  const GuidingCurve& first = settings.curves[0];
  EXPECT_EQ(first.curve.points[3], Vec3(2, 2, 1));
  EXPECT_EQ(first.distance, (std::array<double, 3>{-3, 0.1, 250}));
  EXPECT_EQ(first.alignment, 33.3);
  EXPECT_EQ(first.offset, -0.7);
  EXPECT_EQ(first.utilisation, 7);
  EXPECT_EQ(first.segment, 0.3);
  EXPECT_EQ(first.thickness, (std::array<double, 2>{0.5, 0.05}));
  EXPECT_EQ(settings.curves[1].thickness, (std::array<double, 2>{2, 2})) << "one number is both";
  ASSERT_TRUE(settings.density);
  EXPECT_EQ(settings.density->min, Vec3(-1, 0, -1.5f));
  EXPECT_EQ(settings.density->wanted, 0);
  const Scene again = parse_scene(to_toml(scene), "again.toml", "");
  EXPECT_EQ(again.curves, scene.curves);
  EXPECT_EQ(to_toml(again), to_toml(scene));
}

TEST(SceneCurves, WhatIsLeftOutIsAsInTheOriginalEditor) {
  const SceneCurves curves = parsed(std::string("[[curves.curve]]\n") + kPoints).curves;
  const GuidingCurve& curve = curves.settings.curves.at(0);
  EXPECT_EQ(curves.weight, 1);
  EXPECT_FALSE(curves.settings.blend);
  EXPECT_EQ(curve.distance, (std::array<double, 3>{0, 0, 100}));
  EXPECT_EQ(curve.alignment, 400);
  EXPECT_EQ(curve.offset, 0.6);
  EXPECT_EQ(curve.utilisation, 20);
  EXPECT_EQ(curve.segment, 0.2);
  EXPECT_EQ(curve.thickness, (std::array<double, 2>{0, 0}));
  EXPECT_FALSE(curves.settings.density);
}

TEST(SceneCurves, EveryBadValueOfACurveNamesFilePlaceAndKey) {
  const std::pair<const char*, const char*> kBad[] = {
      {"distance = [0, 1]", "tree.toml:6:12: curves.curve.0.distance must be a list of 3 numbers, got a list of 2"},
      {"distance = [0, 0, 1e7]", "tree.toml:6:19: curves.curve.0.distance must be a number from -1000000 to 1000000"},
      {"alignment = -1", "tree.toml:6:13: curves.curve.0.alignment must be a number from 0 to 1000000, got -1"},
      {"offset = 1.5", "tree.toml:6:10: curves.curve.0.offset must be a number from -1 to 1, got 1.5"},
      {"utilisation = \"much\"", "tree.toml:6:15: curves.curve.0.utilisation must be a number"},
      {"segment = 0", "tree.toml:6:11: curves.curve.0.segment must be a number from 1e-06 to 100000, got 0"},
      {"segment = 0.001", "tree.toml:6:11: curves.curve.0.segment must leave at most 1024 segments, got 0.001: 3"},
      {"thickness = [0, -0.1]", "tree.toml:6:17: curves.curve.0.thickness must be a number from 0 to 100000, got -0.1"},
      {"thickness = true", "tree.toml:6:13: curves.curve.0.thickness must be a number or a list of 2 numbers"},
      {"lenght = 3", "tree.toml:6:10: curves.curve.0.lenght is no setting of a scene"},
  };
  for (const auto& [line, error] : kBad) EXPECT_THAT(error_of_curve(line), StartsWith(error)) << line;
}

TEST(SceneCurves, ACurveHasFourPointsThatAreFinite) {
  EXPECT_THAT(error_of("[[curves.curve]]\npoints = [[0, 0, 0], [1, 1, 1]]\n"),
              StartsWith("tree.toml:5:10: curves.curve.0.points must be a list of 4 points [x, y, z], got a list of 2"));
  EXPECT_THAT(error_of("[[curves.curve]]\npoints = [[0, 0], [1, 1, 1], [1, 1, 1], [1, 1, 1]]\n"),
              StartsWith("tree.toml:5:"));
  EXPECT_THAT(error_of("[[curves.curve]]\npoints = [[0, 0, 1e6], [1, 1, 1], [1, 1, 1], [1, 1, 1]]\n"),
              HasSubstr("from -100000 to 100000, got 1000000"));
  EXPECT_THAT(error_of("[[curves.curve]]\noffset = 0\n"),
              HasSubstr("curves.curve.0 must have points: the four control points of a cubic B"));
  EXPECT_THAT(error_of(std::string("[[curves.curve]]\n") + kPoints + "[[curves.curve]]\n" + kPoints + "offset = 7\n"),
              StartsWith("tree.toml:8:10: curves.curve.1.offset must be"));
}

TEST(SceneCurves, EveryBadValueOfTheWholeNamesFilePlaceAndKey) {
  const std::string curve = std::string("[[curves.curve]]\n") + kPoints;
  EXPECT_THAT(error_of("[curves]\nweight = -1\n" + curve), StartsWith("tree.toml:5:10: curves.weight must be"));
  EXPECT_THAT(error_of("[curves]\nblend = 1\n" + curve), StartsWith("tree.toml:5:9: curves.blend must be true or"));
  EXPECT_THAT(error_of("[curves]\nfield_cells = 200\n" + curve),
              StartsWith("tree.toml:5:15: curves.field_cells must be a whole number from 0 to 128, got 200"));
  EXPECT_THAT(error_of("[curves]\nfield_cells = 5\n" + curve),
              StartsWith("tree.toml:5:15: curves.field_cells must be 8 to 128, got 5"));
  EXPECT_THAT(error_of("[curves]\nblend = true\n"), HasSubstr("curves.curve must be there at least once"));
  std::string many;
  for (int i = 0; i < 65; ++i) many += curve;
  EXPECT_THAT(error_of(many), HasSubstr("curves.curve must be at most 64, got 65"));
}

TEST(SceneCurves, EveryBadValueOfADensityNamesFilePlaceAndKey) {
  const std::string box = "min = [0, 0, 0]\nmax = [1, 1, 1]\n";  // lines 7 and 8
  EXPECT_THAT(error_of_density("min = [0, 0, 0]\n"), HasSubstr("curves.density must have min and max"));
  EXPECT_THAT(error_of_density("min = [0, 0, 0]\nmax = [1, 0, 1]\n"),
              StartsWith("tree.toml:8:7: curves.density.max must be above density.min along every axis"));
  EXPECT_THAT(error_of_density(box + "cell = 0\n"), StartsWith("tree.toml:9:8: curves.density.cell must be"));
  EXPECT_THAT(error_of_density(box + "cell = 0.01\n"),
              StartsWith("tree.toml:9:8: curves.density.cell must leave at most 4096 cells, got 0.01: 1000000"));
  EXPECT_THAT(error_of_density(box + "wanted = -1\n"), StartsWith("tree.toml:9:10: curves.density.wanted must be"));
  EXPECT_THAT(error_of_density(box + "cost = 1e9\n"), StartsWith("tree.toml:9:8: curves.density.cost must be"));
  EXPECT_THAT(error_of_density(box + "costs = 1\n"), HasSubstr("curves.density.costs is no setting of a scene"));
}

TEST(SceneCurves, EveryBadValueOfTheGuidedEngineNamesFilePlaceAndKey) {
  const std::string curve = std::string("[[curves.curve]]\n") + kPoints;
  const std::pair<const char*, const char*> kBad[] = {
      {"particles = 1", "engine.guided.particles must be"},
      {"last_particles = 1", "engine.guided.last_particles must be"},
      {"steps = 0", "engine.guided.steps must be"},
      {"heuristic = -1", "engine.guided.heuristic must be"},
      {"heuristic_steps = -1", "engine.guided.heuristic_steps must be"},
      {"temperature = 0", "engine.guided.temperature must be"},
      {"resampling = \"some\"", "engine.guided.resampling must be one of"},
      {"regrow = 1", "engine.guided.regrow must be true or false"},
      {"regrow_particles = 1", "engine.guided.regrow_particles must be"},
      {"regrow_steps = 0", "engine.guided.regrow_steps must be"},
      {"regrowth = 1", "engine.guided.regrowth is no setting"},
  };
  for (const auto& [line, error] : kBad) {
    const std::string text = error_of(std::string("search.engine = \"guided\"\n[engine.guided]\n") + line + "\n" + curve);
    EXPECT_THAT(text, StartsWith("tree.toml:6:")) << line;
    EXPECT_THAT(text, HasSubstr(error)) << line;
  }
  EXPECT_THAT(error_of("search.engine = \"guided\"\n[engine.guided]\nlast_particles = 101\n" + curve),
              StartsWith("tree.toml:5:1: engine.guided.last_particles must be between 2 and 100, got 101"));
}

TEST(SceneCurves, SettingsOfTheGuidedEngineReadBackEqual) {
  const Scene scene = parsed(std::string("search.engine = \"guided\"\n[engine.guided]\nparticles = 300\nlast_particles = 20"
                                         "\nsteps = 77\nheuristic = 0.5\nheuristic_steps = 9\ntemperature = 250\n"
                                         "regrow = false\nregrow_particles = 33\nregrow_steps = 8\n[[curves.curve]]\n") +
                             kPoints);
  const GuidedSettings& guided = scene.search.guided;
  EXPECT_EQ(guided.particles, 300u);
  EXPECT_EQ(guided.temperature, 250);
  EXPECT_FALSE(guided.regrow);
  EXPECT_EQ(parse_scene(to_toml(scene), "again", "").search.guided, guided);
}

TEST(SceneCurves, ASideOfThePicturesReadsBackEqual) {
  const std::string curve = std::string("[[curves.curve]]\n") + kPoints;
  const Scene scene = parsed(curve + "[output]\nazimuth_deg = -30.5\nelevation_deg = 80\n");
  EXPECT_EQ(scene.output.azimuth_deg, -30.5);
  EXPECT_EQ(scene.output.elevation_deg, 80);
  EXPECT_EQ(parse_scene(to_toml(scene), "again", "").output, scene.output);
  EXPECT_THAT(error_of(curve + "[output]\nazimuth_deg = 400\n"), HasSubstr("output.azimuth_deg must be a number"));
  EXPECT_THAT(error_of(curve + "[output]\nelevation_deg = 91\n"), HasSubstr("output.elevation_deg must be a number"));
}

}  // namespace
}  // namespace espalier
