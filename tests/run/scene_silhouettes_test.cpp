#include "run/scene_silhouettes.h"

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/sample.h"
#include "io/image.h"
#include "io/mesh_import.h"
#include "run/fixtures.h"
#include "run/probes.h"
#include "run/run.h"
#include "run/setup.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::kPileGrammar;
using testing::TemporaryFolder;
using testing::write_text;

std::string scene_with(const std::string& silhouette) {
  return "espalier = 1\ngrammar = \"pile.esp\"\nbudget.generations = 3\nsearch.population = 20\nsearch.elitism = 2\n" +
         silhouette;
}

constexpr const char* kFront = R"([[silhouette]]
image = "tower.png"
size = [40, 30]
form = "smootherstep"
view = "parts"
want = 2
avoid = 0.5
weight = 3
[silhouette.camera]
distance = 10
azimuth_deg = 90
elevation_deg = 0
at = [0, 2, 0]
tall = 6
[[silhouette]]
image = "tower.png"
[silhouette.shadow]
lamp = [0, 9, 0]
tall = 7
)";

/// Black in the middle third, white around.
void write_tower(const TemporaryFolder& folder) {
  write_text(folder / "pile.esp", kPileGrammar);
  std::vector<std::uint8_t> rgb;
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 80; ++column) rgb.insert(rgb.end(), 3, column >= 27 && column < 53 ? 0 : 255);
  write_png(folder / "tower.png", 80, 60, rgb, {});
}

std::unique_ptr<Setup> set_up_in(const TemporaryFolder& folder, const std::string& text) {
  AssimpMeshSource source;
  return set_up(parse_scene(text, "scene.toml", folder.path()), source);
}

TEST(SceneSilhouettes, WrittenOutTheyReadBackEqual) {
  const Scene scene = parse_scene(scene_with(kFront), "s", "");
  ASSERT_EQ(scene.silhouettes.size(), 2u);
  const SceneSilhouette& front = scene.silhouettes[0];
  EXPECT_EQ(front.form, SilhouetteForm::smootherstep);
  EXPECT_EQ(front.view, VolumeView::parts);
  EXPECT_NEAR(front.camera.eye.x, 10, 1e-5);
  EXPECT_NEAR(front.camera.eye.z, 0, 1e-5);
  EXPECT_EQ(front.camera.tall, 6);
  ASSERT_TRUE(scene.silhouettes[1].shadow);
  EXPECT_TRUE(scene.silhouettes[1].shadow->lamp);
  const Scene again = parse_scene(to_toml(scene), "again", "");
  EXPECT_EQ(again.silhouettes, scene.silhouettes);
  EXPECT_EQ(to_toml(again), to_toml(scene));
}

std::string error_of(const std::string& text) {
  try {
    parse_scene(scene_with(text), "s.toml", "");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneSilhouettes, BadOnesAreNamed) {
  EXPECT_THAT(error_of(""), HasSubstr("volume must be given, or [[silhouette]]"));
  EXPECT_THAT(error_of("[[silhouette]]\nsize = [3, 3]\n"), HasSubstr("silhouette.0.image must be the path"));
  const std::string start = "[[silhouette]]\nimage = \"a.png\"\n";
  EXPECT_THAT(error_of(start + "want_image = \"b.png\"\n"), HasSubstr("silhouette.0.image must not stand beside"));
  EXPECT_THAT(error_of("[[silhouette]]\navoid_image = \"\"\n"), HasSubstr("silhouette.0.avoid_image must be the path"));
  EXPECT_THAT(error_of(start + "want = -1\n"), HasSubstr("silhouette.0.want"));
  EXPECT_THAT(error_of(start + "size = [0, 3]\n"), HasSubstr("silhouette.0.size"));
  EXPECT_THAT(error_of(start + "[silhouette.camera]\nfov_deg = 30\n"), HasSubstr("must have eye"));
  EXPECT_THAT(error_of(start + "[silhouette.camera]\neye = [1, 2, 3]\nfit = true\n"), HasSubstr("camera.eye must not"));
  EXPECT_THAT(error_of(start + "[silhouette.shadow]\ntall = 3\n"), HasSubstr("either sun"));
  EXPECT_THAT(error_of(start + "[silhouette.camera]\nfit = true\n[silhouette.shadow]\nsun = [0, -1, 0]\n"),
              HasSubstr("must not stand beside"));
  EXPECT_THAT(error_of(start + "zoom = 3\n"), HasSubstr("zoom"));
}

/// A weight for every pixel of 4 x 2, by rows from the bottom.
void write_weights(const TemporaryFolder& folder, const std::string& name, const std::vector<float>& values) {
  std::string bytes = "Pf\n4 2\n-1\n";
  const std::size_t header = bytes.size();
  bytes.resize(header + 4 * values.size());
  std::memcpy(bytes.data() + header, values.data(), 4 * values.size());
  write_text(folder / name, bytes);
}

TEST(SceneSilhouettes, WantedAndAvoidedMayBeTwoImages) {
  const TemporaryFolder folder;
  write_tower(folder);
  write_weights(folder, "keep-off.pfm", {0, 0, 0, 3, 0, 0, 0, 3});
  const std::string two = "[[silhouette]]\nwant_image = \"tower.png\"\navoid_image = \"keep-off.pfm\"\nsize = [8, 6]\n";
  const Scene scene = parse_scene(scene_with(two), "s", "");
  EXPECT_EQ(parse_scene(to_toml(scene), "again", ""), scene);
  const auto setup = set_up_in(folder, scene_with(two));
  const SceneSilhouette& settled = setup->scene.silhouettes[0];
  EXPECT_EQ(settled.image, "");
  EXPECT_EQ(settled.want_image, "inputs/targets/tower.png");
  EXPECT_EQ(settled.avoid_image, "inputs/targets/keep-off.pfm");
  EXPECT_EQ(setup->inputs.files().size(), 3u) << "grammar and both images";
  const SilhouetteSettings& target = setup->silhouettes[0]->settings();
  EXPECT_EQ(target.avoid, 3) << "the greatest weight of a file counts as what it is";
  EXPECT_EQ(target.image.at(7, 3), -WeightImage::kFull);
  EXPECT_EQ(target.image.at(0, 3), 0);
  EXPECT_EQ(target.image.at(3, 3), WeightImage::kFull / 3);
}

TEST(SceneSilhouettes, ARunWithWeightsCanBeReproduced) {
  const TemporaryFolder folder;
  write_tower(folder);
  write_weights(folder, "w.pfm", {-1, 2, 2, -1, -1, 2, 2, -1});
  write_text(folder / "scene.toml", scene_with("[[silhouette]]\nimage = \"w.pfm\"\n[silhouette.camera]\neye = [0, 2, 9]\n"
                                               "at = [0, 2, 0]\ntall = 6\n"));
  AssimpMeshSource source;
  const auto first = set_up(load_scene(folder / "scene.toml"), source);
  EXPECT_EQ(first->objective.optimum(), 8) << "four pixels of weight 2";
  first->inputs.write(folder / "run");
  write_text(folder / "run/run.toml", to_toml(first->scene));
  const auto again = set_up(load_scene(folder / "run/run.toml"), source);
  EXPECT_EQ(again->silhouettes[0]->settings().image.degrees, first->silhouettes[0]->settings().image.degrees);
  EXPECT_EQ(again->objective.optimum(), 8);
}

TEST(SceneSilhouettes, CamerasThatFitAreSettledAndSeeTheModels) {
  const TemporaryFolder folder;
  write_tower(folder);
  const auto setup = set_up_in(folder, scene_with("[[silhouette]]\nimage = \"tower.png\"\n"));
  ASSERT_EQ(setup->silhouettes.size(), 1u);
  EXPECT_FALSE(setup->scene.silhouettes[0].camera.fit) << "written out, so that a run can be repeated";
  EXPECT_EQ(setup->scene.silhouettes[0].image, "inputs/targets/tower.png");
  EXPECT_TRUE(warn_of_reach(*setup, find_reach(*setup)).empty());
  const auto scratch = setup->silhouettes[0]->make_scratch();
  const Probes probes = grow_probes(setup->graph(), setup->scene, true);
  EXPECT_EQ(probes.models, 256u);
  EXPECT_GT(setup->silhouettes[0]->counts(probes.instances, *scratch).covered, 100u);
}

TEST(SceneSilhouettes, ACameraThatLooksAwayIsWarnedOf) {
  const TemporaryFolder folder;
  write_tower(folder);
  const auto setup = set_up_in(
      folder,
      scene_with(
          "[[silhouette]]\nimage = \"tower.png\"\n[silhouette.camera]\neye = [0, 500, 900]\nat = [0, 500, 0]\n"));
  EXPECT_THAT(warn_of_reach(*setup, find_reach(*setup)), ::testing::ElementsAre(HasSubstr("does the camera look")));
}

TEST(SceneSilhouettes, MissingAndMeaninglessImagesAreNamed) {
  const TemporaryFolder folder;
  write_tower(folder);
  write_png(folder / "grey.png", 2, 1, std::vector<std::uint8_t>{255, 255, 255, 128, 128, 128}, {});
  try {
    set_up_in(folder, scene_with("[[silhouette]]\nimage = \"none.png\"\n"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("none.png"));
  }
}

TEST(SceneSilhouettes, ARunFindsTheTowerAndIsExplained) {
  const TemporaryFolder folder;
  write_tower(folder);
  const auto setup = set_up_in(folder, scene_with(kFront));
  EXPECT_EQ(setup->objective.optimum(), 3 * 2 + setup->silhouettes[1]->optimum());
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  RandomStream random({1, Purpose::test});
  Derivation derivation = seedling(setup->graph(), random);
  ASSERT_TRUE(close_open_slots(setup->graph(), derivation, random));
  const Explanation told = scorer.explain(derivation);
  double sum = 0;
  for (const Term& term : told.terms) sum += term.value;
  EXPECT_NEAR(sum, told.score, 1e-9 * std::max(1.0, std::abs(told.score)));
  EXPECT_THAT(told.words, HasSubstr("of what is wanted covered"));
}

}  // namespace
}  // namespace espalier
