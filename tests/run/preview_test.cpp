#include "run/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run/drawing_fixtures.h"
#include "run/scene_scorer.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::drawing_scene;
using testing::TemporaryFolder;
using testing::write_drawing;
using testing::write_text;

const std::string kAll = std::string(testing::kTowerVolume) + testing::kPinhole + testing::kParallel +
                         testing::kFloor + testing::kWall;

Preview preview_of(const TemporaryFolder& folder, const std::string& targets, std::uint64_t seed = 1) {
  write_drawing(folder);
  AssimpMeshSource source;
  Scene scene = parse_scene(drawing_scene(targets), "scene.toml", folder.path());
  scene.seed = seed;
  return make_preview(scene, source);
}

TEST(Preview, TellsWhatTheSceneAsksFor) {
  const TemporaryFolder folder;
  const Preview preview = preview_of(folder, kAll);
  const std::string text = preview_text(preview);
  EXPECT_THAT(text, AllOf(HasSubstr("pile, seed 1: at best "), HasSubstr("tower.obj: "), HasSubstr(" cells of "),
                          HasSubstr("120 x 90 pixels, 5400 wanted, 5400 to be left free, 0 do not matter"),
                          HasSubstr("pinhole at "), HasSubstr("50 degrees from edge to edge"),
                          HasSubstr("parallel rays from (0, 2, 9) towards (0, 2, 0), 8 m from edge to edge"),
                          HasSubstr("shadow of a sun along (0.4, -1, 0.2)"), HasSubstr("weight 0.5"),
                          HasSubstr("shadow of a lamp at (-6, 2, 0.5)"), HasSubstr("sample 4: ")));
  const auto json = nlohmann::json::parse(preview_json(preview, "a/b.png"));
  ASSERT_EQ(json["targets"].size(), 5u);
  EXPECT_EQ(json["targets"][0]["kind"], "volume");
  EXPECT_EQ(json["targets"][2]["size"], nlohmann::json({80, 120}));
  EXPECT_EQ(json["samples"].size(), kPreviewSamples);
  EXPECT_EQ(json["picture"], "a/b.png");
  EXPECT_EQ(json["probes"], 256);
}

TEST(Preview, ScoresItsSamplesAsASearchWould) {
  const TemporaryFolder folder;
  const Preview preview = preview_of(folder, kAll);
  const auto executor = make_serial_executor();
  SceneScorer scorer(preview.setup->graph(), preview.setup->objective, *executor);
  for (const PreviewSample& sample : preview.samples) {
    const Derivation* one = &sample.derivation;
    double score = 0;
    scorer.score({&one, 1}, {&score, 1});
    EXPECT_EQ(sample.explanation.score, score);
  }
  EXPECT_NE(preview.samples[0].derivation, preview.samples[1].derivation);
}

TEST(Preview, TheSameSceneGivesTheSameSheet) {
  const TemporaryFolder folder;
  const auto one = make_serial_executor(), many = make_thread_executor(4);
  const Picture picture = preview_picture(preview_of(folder, kAll), *one);
  EXPECT_EQ(picture.rgb, preview_picture(preview_of(folder, kAll), *many).rgb);
  EXPECT_NE(picture.rgb, preview_picture(preview_of(folder, kAll, 2), *one).rgb);
  EXPECT_EQ(picture.rgb.size(), std::size_t{3} * picture.width * picture.height);
}

TEST(Preview, WarnsOfSamplesThatTheCameraDoesNotSee) {
  const TemporaryFolder folder;
  EXPECT_THAT(preview_of(folder, testing::kParallel).warnings, IsEmpty());
  const Preview away = preview_of(
      folder, "[[silhouette]]\nimage = \"drawing.png\"\n[silhouette.camera]\neye = [0, 500, 900]\nat = [0, 500, 0]\n");
  EXPECT_THAT(away.warnings, Contains(HasSubstr("4 of 4 samples never reach the frame")));
  EXPECT_THAT(away.warnings, Contains(HasSubstr("does the camera look")));
  EXPECT_EQ(away.reach.silhouettes[0], 0);
}

TEST(Preview, SaysWhyASampleIsRejected) {
  const TemporaryFolder folder;
  const Preview preview = preview_of(folder, "[limits.height]\nmax = 0.01\n" + std::string(testing::kParallel));
  EXPECT_THAT(preview_text(preview), HasSubstr("score rejected: "));
  const auto executor = make_serial_executor();
  EXPECT_GT(preview_picture(preview, *executor).width, 1000u);
  EXPECT_TRUE(nlohmann::json::parse(preview_json(preview, ""))["samples"][0]["explanation"]["score"].is_null());
}

TEST(Preview, ManyTargetsAreCutAndSaySo) {
  const TemporaryFolder folder;
  std::string targets;
  for (int i = 0; i < 14; ++i) targets += "[[silhouette]]\nimage = \"drawing.png\"\nsize = [8, 6]\n";
  const auto executor = make_serial_executor();
  const Preview many = preview_of(folder, targets);
  const Picture sheet = preview_picture(many, *executor);
  EXPECT_LT(sheet.height, 8000u);
  EXPECT_EQ(nlohmann::json::parse(preview_json(many, ""))["targets"].size(), 14u);
}

TEST(Preview, HugeModelsAreProbedLess) {
  const TemporaryFolder folder;
  write_drawing(folder);
  write_text(folder / "huge.esp",
             "grammar huge 1\nstart A\nrule A {\n  for i in 0..4000 { move x 0.001 emit box }\n"
             "  spawn B\n}\nrule B { for i in 0..4000 { move y 0.001 emit box } maybe 0.9 spawn B }\n");
  AssimpMeshSource source;
  Scene scene = parse_scene(drawing_scene(testing::kParallel), "scene.toml", folder.path());
  scene.grammar = "huge.esp";
  const Probes probes = grow_probes(*set_up(scene, source)->grammar.graph, scene, true);
  EXPECT_LT(probes.models, 256u);
  EXPECT_LT(probes.instances.size(), 3'100'000u) << "2 000 000 and a model more";
}

}  // namespace
}  // namespace espalier
