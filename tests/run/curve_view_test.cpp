// What is drawn and told of guiding curves: marks, words, pictures of a run, preview and report.

#include "run/curve_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/camera.h"
#include "run/curve_fixtures.h"
#include "run/outcome_pictures.h"
#include "run/preview.h"
#include "run/report_targets.h"
#include "run/run.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::kUpright;
using testing::set_up_sticks;
using testing::skeleton;
using testing::TemporaryFolder;

RenderSettings front(std::uint32_t width = 120, std::uint32_t height = 90) {
  RenderSettings look;
  look.width = width, look.height = height, look.samples = 4;
  look.azimuth_deg = look.elevation_deg = 0;
  return look;
}

/// Pixels that are more blue than red by so much, or the other way round: the colours of used and unused segments.
std::size_t count_hue(const Picture& picture, bool blue) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const int difference = picture.rgb[i + 2] - picture.rgb[i];
    count += blue ? difference > 60 : difference < -60;
  }
  return count;
}

TEST(CurveMarks, SegmentsAreUsedByWhatTheBonesReach) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, kUpright);
  const MarkedCurves none = mark_curves(*setup->curves, {});
  EXPECT_THAT(none.uses, ElementsAre(std::vector<std::uint8_t>(6, 0)));
  EXPECT_TRUE(none.bones.empty());
  // Up, up again, and one far aside that runs across.
  const Model model = skeleton({{{0, 0.1f, 0}, {0, 0.9f, 0}}, {{0, 0.6f, 0}, {0, 0.9f, 0}}, {{2, 2.6f, 0}, {3, 2.6f, 0}}});
  const MarkedCurves marked = mark_curves(*setup->curves, model);
  EXPECT_THAT(marked.uses, ElementsAre(ElementsAre(1, 2, 0, 0, 0, 1)));
  EXPECT_THAT(marked.bones, ElementsAre(CurveMark::follows, CurveMark::follows, CurveMark::strays));
  const auto rows = legend_of(marked, setup->curves->cost().settings());
  EXPECT_EQ(rows[0].text, "used: 3 segments, 50 % of the curves");
  EXPECT_EQ(rows[1].text, "not used: 3 segments");
  EXPECT_EQ(rows[2].text, "follows: 2 bones, 67 % of all");
  EXPECT_THAT(rows[3].text, HasSubstr("strays: 1 bone,"));
  EXPECT_EQ(legend_of(none, setup->curves->cost().settings()).at(0).text, "1 curve, 6 segments");
}

TEST(CurveMarks, AreWhatTheScoreCounts) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, std::string(kUpright) + kUpright + "alignment = 50\n");
  Expander expander(setup->graph());
  Model model;
  expander.expand(grow_probe(setup->graph(), setup->scene, 3), ExpandTo::full, model);
  const MarkedCurves marked = mark_curves(*setup->curves, model);
  CurveTally tally;
  tally_bones(setup->curves->cost(), model, tally);
  std::vector<std::uint8_t> joined;
  for (const auto& curve : marked.uses) joined.insert(joined.end(), curve.begin(), curve.end());
  EXPECT_EQ(joined, tally.uses);
  EXPECT_EQ(marked.bones.size(), model.bones.size());
}

TEST(CurveMarks, WordsHoldEverySetting) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(
      folder, std::string("[curves]\nblend = true\nfield_cells = 16\n") + kUpright +
                  "distance = [1, 2, 3]\nalignment = 4\noffset = -0.5\nthickness = [0.25, 1.5]\n"
                  "[curves.density]\nmin = [-1, 0, -1]\nmax = [1, 3, 1]\nwanted = 7\ncost = 8\n");
  const CurveTarget& target = *setup->curves;
  EXPECT_EQ(curve_in_words(target, 0), "curve 1: 3 m in 6 segments of 0.5 m");
  EXPECT_EQ(settings_in_words(target.cost().settings().curves[0]),
            "distance 1 + 2 d + 3 d^2, alignment 4 beyond -0.5, utilisation 100, thickness 0.25 to 1.5 m");
  EXPECT_THAT(extras_in_words(target.cost().settings()),
              ElementsAre(HasSubstr("blended"), HasSubstr("16 cells"),
                          AllOf(HasSubstr("at most 7 bones per m3 from (-1, 0, -1) to (1, 3, 1)"), HasSubstr("8 per"))));
}

TEST(CurveView, ShowsUsedAndUnusedSegmentsInTheirColours) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, kUpright);
  const auto executor = make_serial_executor();
  const CurveStage stage = curve_stage(*setup);
  const Picture alone = curve_view(stage, front(240, 180), *executor);
  EXPECT_GT(count_hue(alone, false), 60u);
  EXPECT_EQ(count_hue(alone, true), 0u);
  const Picture half = curve_view(stage, skeleton({{{0, 0, 0}, {0, 1.4f, 0}}}), {}, front(), *executor);
  EXPECT_GT(count_hue(half, true), 20u);
  EXPECT_GT(count_hue(half, false), 20u);
  const Picture all = curve_view(stage, skeleton({{{0, 0, 0}, {0, 3, 0}}}), {}, front(), *executor);
  EXPECT_EQ(count_hue(all, false), 0u);
}

/// A wall right before the camera: curve and bones must shine through.
TEST(CurveView, NothingHidesACurve) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, kUpright);
  const auto executor = make_serial_executor();
  Model wall;
  Instance box;
  box.model_from_mesh = {Mat3(Vec3(6, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 0.1f)), Vec3(0, 1.5f, 1)};
  wall.instances = {box};
  const Surfaces surfaces = setup->graph().materials;
  const Picture bare = render(wall, setup->meshes, surfaces, {}, front(), *executor);
  EXPECT_EQ(count_hue(bare, false), 0u);
  EXPECT_GT(count_hue(curve_view(curve_stage(*setup), wall, surfaces, front(), *executor), false), 30u);
}

/// Neither the curve nor a model far from it leaves the picture: its outermost pixels are the backdrop's.
TEST(CurveView, CurveAndModelAreSeenWhole) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, kUpright);
  const auto executor = make_serial_executor();
  Model far;
  Instance ball;
  ball.model_from_mesh = {Mat3(1), Vec3(9, -4, 2)};
  far.instances = {ball};
  Material red;
  red.color = {0.8f, 0, 0};
  const Surfaces surfaces = std::vector<Material>(4, red);
  for (const float azimuth : {0.0f, 70.0f, 200.0f}) {
    RenderSettings look = front();
    look.azimuth_deg = azimuth, look.elevation_deg = 20;
    const CurveDrawing drawing(curve_stage(*setup), far, mark_curves(*setup->curves, far));
    const CameraPlace place = drawing.place(look);
    const Camera camera = placed_camera(place.eye, glm::dvec3(*place.at) - glm::dvec3(place.eye),
                                        long_lens(look.width, look.height), place.up);
    std::vector<Vec3> corners = {{0, 0, 0}, {0, 3, 0}};
    for (int k = 0; k < 8; ++k)
      corners.push_back(Vec3(9, -4, 2) + 0.5f * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    float widest = 0;
    for (const Vec3& corner : corners) {
      const Vec3 seen = camera.picture_point(corner);
      EXPECT_LT(std::max(std::fabs(seen.x), std::fabs(seen.y)), 0.9f);
      EXPECT_GT(seen.z, 0);
      widest = std::max({widest, std::fabs(seen.x), std::fabs(seen.y)});
    }
    EXPECT_GT(widest, 0.6f) << "and no smaller than need be";
    EXPECT_GT(count_hue(curve_view(curve_stage(*setup), far, surfaces, look, *executor), false), 20u);
  }
}

TEST(CurveView, TheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, std::string(kUpright) + "thickness = [0.4, 0.1]\n");
  const auto one = make_serial_executor(), many = make_thread_executor(4);
  const Model model = skeleton({{{0, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 1, 0}}});
  EXPECT_EQ(curve_view(curve_stage(*setup), model, {}, front(), *one).rgb,
            curve_view(curve_stage(*setup), model, {}, front(), *many).rgb);
}

TEST(CurveView, ThicknessAndDensityAreGhosts) {
  const TemporaryFolder folder;
  const auto plain = set_up_sticks(folder, kUpright);
  const auto thick = set_up_sticks(folder, std::string(kUpright) + "thickness = [0.5, 0.1]\n[curves.density]\n"
                                           "min = [-2, 0, -1]\nmax = [2, 4, 1]\n");
  const CurveDrawing bare(curve_stage(*plain), {}, mark_curves(*plain->curves, {}));
  EXPECT_TRUE(bare.ghosts().empty());
  const CurveDrawing drawing(curve_stage(*thick), {}, mark_curves(*thick->curves, {}));
  ASSERT_EQ(drawing.ghosts().size(), 2u);
  const Bounds box = bounds(drawing.ghosts()[1]);
  EXPECT_EQ(box.min, Vec3(-2, 0, -1));
  EXPECT_EQ(box.max, Vec3(2, 4, 1));
  const auto executor = make_serial_executor();
  EXPECT_NE(curve_view(curve_stage(*plain), front(), *executor).rgb,
            curve_view(curve_stage(*thick), front(), *executor).rgb);
}

TEST(ThicknessTube, IsClosedAndAsWideAsTheThickness) {
  GuidingCurve guide;
  guide.curve.points = {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 2, 0), Vec3(0, 3, 0)};
  EXPECT_TRUE(thickness_tube(guide).triangles.empty());
  guide.thickness = {0.5, 0.2};
  const Mesh tube = thickness_tube(guide);
  EXPECT_EQ(open_edges(tube), 0u);
  const Bounds box = bounds(tube);
  EXPECT_NEAR(box.min.y, -0.5, 1e-4);
  EXPECT_NEAR(box.max.y, 3.2, 1e-4);
  EXPECT_NEAR(box.max.x, 0.5, 0.01);
  // A frustum and two half balls.
  const double expected = 3.14159 * (3.0 / 3 * (0.25 + 0.1 + 0.04) + 2.0 / 3 * (0.125 + 0.008));
  EXPECT_NEAR(volume(tube), expected, 0.03 * expected);
  guide.curve.points = {Vec3(0, 0, 0), Vec3(2, 1, 0), Vec3(-2, 2, 1), Vec3(1, 3, 2)};
  guide.thickness = {0.3, 0};
  EXPECT_EQ(open_edges(thickness_tube(guide)), 0u) << "that ends in a point";
  EXPECT_GT(volume(thickness_tube(guide)), 0.1) << "its faces look outwards";
}

TEST(LayOver, MixesByAlphaAndKeepsWhatIsTransparent) {
  Picture below{1, 1, {100, 100, 100}, {}};
  const Picture lines{1, 1, {200, 0, 0}, {128}};
  lay_over(below, lines);
  EXPECT_NEAR(below.rgb[0], 150, 1);
  EXPECT_TRUE(below.alpha.empty());
  Picture clear{1, 1, {0, 0, 0}, {0}};
  lay_over(clear, lines);
  EXPECT_EQ(clear.rgb, (std::vector<std::uint8_t>{200, 0, 0}));
  EXPECT_EQ(clear.alpha, (std::vector<std::uint8_t>{128}));
  Picture same{1, 1, {7, 8, 9}, {}};
  lay_over(same, {1, 1, {200, 0, 0}, {0}});
  EXPECT_EQ(same.rgb, (std::vector<std::uint8_t>{7, 8, 9}));
}

TEST(CurveOutcome, IsAPictureOfTheRunAndOfItsReport) {
  const TemporaryFolder folder;
  const auto setup = set_up_sticks(folder, kUpright);
  EXPECT_THAT(outcome_names(*setup), ElementsAre("curves.png"));
  const auto executor = make_serial_executor();
  const Model model = skeleton({{{0, 0, 0}, {0, 1.4f, 0}}, {{0, 1.4f, 0}, {1, 1.4f, 0}}});
  const Surfaces surfaces = setup->graph().materials;
  OutcomeLook look;
  look.view = {160, 120}, look.view_samples = 4;
  const OutcomePicture drawn = draw_outcome({*setup, model, surfaces}, "curves.png", look, *executor);
  EXPECT_EQ(drawn.kind, OutcomeKind::curves);
  EXPECT_EQ(drawn.caption, "curves, 2 bones");
  EXPECT_EQ(drawn.picture.width, 160u);
  EXPECT_EQ(drawn.legend.size(), 4u);
  EXPECT_GT(with_words(drawn).height, 120u) << "the legend is below";
  const ReportPicture told = report_picture(drawn);
  EXPECT_EQ(told.title, "Curves and bones");
  const auto targets = target_pictures(*setup, front(), *executor);
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].title, "Guiding curve");
  EXPECT_THAT(targets[0].caption, AllOf(HasSubstr("3 m in 6 segments"), HasSubstr("utilisation 100")));
}

TEST(CurvePreview, TellsAndShowsWhatTheCurvesAskFor) {
  const TemporaryFolder folder;
  testing::write_text(folder / "sticks.esp", testing::kStickGrammar);
  AssimpMeshSource source;
  const std::string targets = std::string("[curves]\nweight = 2\nblend = true\n") + kUpright + kUpright;
  const Preview preview = make_preview(parse_scene(testing::stick_scene(targets), "scene.toml", folder.path()), source);
  EXPECT_THAT(preview_text(preview),
              AllOf(HasSubstr("curve 1: 3 m in 6 segments of 0.5 m\n  distance 0 + 0 d + 100 d^2, alignment 400 beyond"),
                    HasSubstr("curve 2: "), HasSubstr("curves: tangents are blended"), HasSubstr("curves: weight 2"),
                    HasSubstr("sticks, seed 2\n"), Not(HasSubstr("at best"))));
  const auto json = nlohmann::json::parse(preview_json(preview, "p.png"));
  ASSERT_EQ(json["targets"].size(), 1u);
  const auto& target = json["targets"][0];
  EXPECT_EQ(target["kind"], "curves");
  EXPECT_EQ(target["curves"].size(), 2u);
  EXPECT_EQ(target["curves"][0]["segments"], 6);
  EXPECT_EQ(target["curves"][0]["points"][3], nlohmann::json({0, 3, 0}));
  EXPECT_EQ(target["weight"], 2);
  EXPECT_TRUE(target["density"].is_null());
  EXPECT_TRUE(json["samples"][0]["explanation"]["percent"].is_null());
  const auto executor = make_serial_executor();
  const Picture sheet = preview_picture(preview, *executor);
  EXPECT_GT(sheet.height, 300u) << "a row of pictures";
  EXPECT_GT(count_hue(sheet, false), 500u);
}

struct CurveRunEnd final : RunObserver {
  void step(const StepReport&) override {}
  void finished(const RunEnd& the_end) override { end = the_end; }
  RunEnd end;
};

TEST(CurveRun, LeavesACurvesPictureAndTellsNoShareOfTheBest) {
  const TemporaryFolder folder;
  testing::write_text(folder / "sticks.esp", testing::kStickGrammar);
  testing::write_text(folder / "scene.toml", testing::stick_scene(kUpright));
  CurveRunEnd told;
  AssimpMeshSource source;
  RunOptions options;
  options.out = folder / "out", options.observer = &told;
  ASSERT_TRUE(run_scene(load_scene(folder / "scene.toml", {}), options, source));
  const auto files = testing::read_tree(folder / "out");
  ASSERT_TRUE(files.contains("curves.png"));
  EXPECT_THAT(files.at("report.html"), AllOf(HasSubstr("Guiding curve"), HasSubstr("Curves and bones"),
                                             Not(HasSubstr("of at most"))));
  const auto result = nlohmann::json::parse(files.at("result.json"));
  EXPECT_TRUE(result.at("percent").is_null());
  EXPECT_FALSE(told.end.percent.has_value());
  EXPECT_THAT(summary(told.end), Not(HasSubstr("of at most")));
}

}  // namespace
}  // namespace espalier
