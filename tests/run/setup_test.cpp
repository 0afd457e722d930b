#include "run/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/sample.h"
#include "io/mesh_import.h"
#include "run/fixtures.h"
#include "run/probes.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::pile_scene;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

std::unique_ptr<Setup> set_up_in(const TemporaryFolder& folder, const std::vector<std::string>& settings = {}) {
  AssimpMeshSource source;
  return set_up(load_scene(folder / "scene.toml", {settings, {}}), source);
}

std::string error_of(const TemporaryFolder& folder, const std::vector<std::string>& settings = {}) {
  try {
    set_up_in(folder, settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> names_of(const InputFiles& inputs) {
  std::vector<std::string> names;
  for (const InputFile& file : inputs.files()) names.push_back(file.name);
  return names;
}

TEST(SetUp, TheGridAroundTheTargetsBecomesASetting) {
  const TemporaryFolder folder;
  write_pile(folder);
  const auto setup = set_up_in(folder, {"volume.cells=5000"});
  ASSERT_TRUE(setup->scene.volume.grid);
  EXPECT_EQ(setup->scene.volume.grid->min, setup->volume->grid().min);
  EXPECT_EQ(setup->scene.volume.grid->max, setup->volume->grid().max);
  EXPECT_NE(to_toml(setup->scene).find("[volume.grid]"), std::string::npos);
}

TEST(PlaceMesh, ScalesThenTurnsThenMoves) {
  Mesh mesh;
  mesh.positions = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.triangles = {{0, 1, 2}};
  SceneMesh placing;
  placing.scale = Vec3(2, 3, 4);
  placing.rotation_deg = Vec3(0, 90, 0);  // x to -z, z to x
  placing.position = Vec3(10, 20, 30);
  const Mesh placed = place_mesh(mesh, placing);
  const Vec3 expected[] = {Vec3(10, 20, 28), Vec3(10, 23, 30), Vec3(14, 20, 30)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(placed.positions[i][k], expected[i][k], 1e-5);
  }
}

TEST(PlaceMesh, TurnsAboutXFirst) {
  Mesh mesh;
  mesh.positions = {Vec3(0, 1, 0)};
  SceneMesh placing;
  placing.rotation_deg = Vec3(90, 0, 90);  // y to z; z stays under the turn about z
  const Mesh placed = place_mesh(mesh, placing);
  EXPECT_NEAR(placed.positions[0].z, 1, 1e-6);
}

TEST(PlaceMesh, AMirrorKeepsTheOutsideOutside) {
  Mesh mesh;
  mesh.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  ASSERT_GT(volume(mesh), 0);
  SceneMesh placing;
  placing.scale = Vec3(-2, 1, 1);
  EXPECT_NEAR(volume(place_mesh(mesh, placing)), 2 * volume(mesh), 1e-6);
}

TEST(Setup, BuildsTheObjectiveAndCopiesTheInputs) {
  const TemporaryFolder folder;
  write_pile(folder);
  const auto setup = set_up_in(folder);
  EXPECT_EQ(setup->graph().name, "pile");
  EXPECT_EQ(setup->objective.size(), 2u);  // volume and limits
  EXPECT_THAT(names_of(setup->inputs), ElementsAre("inputs/pile.esp", "inputs/targets/tower.obj"));
  EXPECT_EQ(setup->scene.grammar, "inputs/pile.esp");
  EXPECT_EQ(setup->scene.volume.meshes[0].file, "inputs/targets/tower.obj");
  EXPECT_THAT(setup->warnings, IsEmpty());
  EXPECT_GT(setup->objective.optimum(), 0);
}

TEST(Setup, LimitsSeeWhatTheVolumeSees) {
  const TemporaryFolder folder;
  write_pile(folder);
  EXPECT_EQ(set_up_in(folder)->objective.target(1).view(), TargetView::genes);
  const std::vector<std::string> parts = {"limits.height.max=3", "volume.view=parts"};
  EXPECT_EQ(set_up_in(folder, parts)->objective.target(1).view(), TargetView::parts);
  EXPECT_EQ(set_up_in(folder, {"limits.height.max=3"})->objective.target(1).view(), TargetView::full);
}

TEST(Setup, MeshFilesWithoutVolumeAreWarnedOfWhereVolumeIsLimited) {
  const TemporaryFolder folder;
  write_pile(folder);
  std::string leaky = testing::box_obj(0, 0, 0, 1, 1, 1);
  leaky.erase(leaky.rfind("f "));
  write_text(folder / "leaky.obj", leaky);
  write_text(folder / "pile.esp", "grammar g 1\nmesh leaky = \"leaky.obj\"\nstart G\n"
                                  "rule G { k ~ uniform(1, 2)  size k  emit leaky }\n");
  EXPECT_THAT(set_up_in(folder)->warnings, IsEmpty());
  EXPECT_THAT(set_up_in(folder, {"limits.volume.max=3"})->warnings,
              ElementsAre(HasSubstr("leaky.obj: is not closed, so it counts 0 m3 in limits.volume")));
}

TEST(Setup, TheSameTargetTwiceIsStoredOnceAndNamesakesApart) {
  const TemporaryFolder folder;
  write_pile(folder);
  write_text(folder / "other/tower.obj", testing::box_obj(0, 0, 0, 1, 1, 1));
  const auto setup = set_up_in(folder, {"volume.mesh.1.file=meshes/tower.obj", "volume.mesh.2.file=other/tower.obj"});
  EXPECT_THAT(names_of(setup->inputs),
              ElementsAre("inputs/pile.esp", "inputs/targets/tower.obj", "inputs/targets/tower-2.obj"));
  EXPECT_EQ(setup->scene.volume.meshes[1].file, "inputs/targets/tower.obj");
  EXPECT_EQ(setup->scene.volume.meshes[2].file, "inputs/targets/tower-2.obj");
}

TEST(Setup, MeshesThatTheGrammarNamesKeepTheirPlaceBesideIt) {
  const TemporaryFolder folder;
  write_text(folder / "grammars/trees/g.esp",
             "grammar g 1\nmesh twig = \"../../meshes/twig.obj\"\nmesh near = \"near.obj\"\nstart G\n"
             "rule G { emit twig  maybe 0.5 spawn H }\nrule H { k ~ uniform(1, 2)  size k  emit near }\n");
  write_text(folder / "meshes/twig.obj", testing::box_obj(0, 0, 0, 1, 1, 1));
  write_text(folder / "grammars/trees/near.obj", testing::box_obj(0, 0, 0, 2, 1, 1));
  write_text(folder / "meshes/tower.obj", testing::box_obj(-1, 0, -1, 1, 4, 1));
  write_text(folder / "scene.toml", pile_scene());
  const auto setup = set_up_in(folder, {"grammar=grammars/trees/g.esp"});
  EXPECT_THAT(names_of(setup->inputs),
              ::testing::UnorderedElementsAre("inputs/grammars/trees/g.esp", "inputs/meshes/twig.obj",
                                              "inputs/grammars/trees/near.obj", "inputs/targets/tower.obj"));
  // The copy works where it lies.
  const TemporaryFolder copy;
  setup->inputs.write(copy.path());
  Scene scene = setup->scene;
  scene.folder = copy.path();
  AssimpMeshSource source;
  EXPECT_EQ(set_up(scene, source)->inputs.hashes(), setup->inputs.hashes());
}

TEST(Setup, OpenMeshesAreWarnedOf) {
  const TemporaryFolder folder;
  write_pile(folder);
  std::string box = testing::box_obj(-1, 0, -0.5, 1, 4, 0.5);
  box.erase(box.rfind("f "));
  write_text(folder / "meshes/tower.obj", box);
  const auto setup = set_up_in(folder);
  ASSERT_EQ(setup->warnings.size(), 1u);
  EXPECT_THAT(setup->warnings[0], ::testing::AllOf(HasSubstr("tower.obj"), HasSubstr("4")));
}

TEST(Setup, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  write_pile(folder);
  EXPECT_THAT(error_of(folder, {"grammar=none.esp"}), HasSubstr("none.esp"));
  EXPECT_THAT(error_of(folder, {"volume.mesh.0.file=none.obj"}), HasSubstr("none.obj"));
  write_text(folder / "bad.esp", "grammar bad 1\nstart S\nrule S { emit nothing }\n");
  EXPECT_THAT(error_of(folder, {"grammar=bad.esp"}), HasSubstr("bad.esp:3:"));
  write_text(folder / "empty.obj", "");
  EXPECT_THAT(error_of(folder, {"volume.mesh.0.file=empty.obj"}), HasSubstr("empty.obj"));
  write_text(folder / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(error_of(folder, {"volume.mesh.0.file=nan.obj"}), HasSubstr("nan.obj"));
}

TEST(SceneScorer, ScoresTheSameOnOneAndManyWorkers) {
  const TemporaryFolder folder;
  write_pile(folder);
  const auto setup = set_up_in(folder);
  const auto serial = make_serial_executor(), threads = make_thread_executor(3);
  SceneScorer one(setup->graph(), setup->objective, *serial), many(setup->graph(), setup->objective, *threads);
  std::vector<Derivation> derivations;
  std::vector<const Derivation*> batch;
  for (std::uint32_t i = 0; i < 50; ++i) {
    RandomStream random({1, Purpose::test, 0, i, 0});
    derivations.push_back(sample(setup->graph(), random).derivation);
  }
  for (const Derivation& d : derivations) batch.push_back(&d);
  std::vector<double> a(50), b(50);
  one.score(batch, a);
  many.score(batch, b);
  EXPECT_EQ(a, b);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(one.explain(derivations[i]).score, a[i]);
}

std::vector<std::string> reach_warnings(Setup& setup) { return warn_of_reach(setup, find_reach(setup)); }

TEST(Reach, WarnsOfATargetThatTheGrammarDoesNotGetTo) {
  const TemporaryFolder folder;
  write_pile(folder);
  EXPECT_THAT(reach_warnings(*set_up_in(folder)), IsEmpty());
  const auto far = reach_warnings(*set_up_in(folder, {"volume.mesh.0.position=[0, 0, 50]"}));
  ASSERT_EQ(far.size(), 1u);
  EXPECT_THAT(far[0], ::testing::AllOf(HasSubstr("tower.obj: all of it"), HasSubstr("256 models")));
  const auto large = reach_warnings(*set_up_in(folder, {"volume.mesh.0.scale=[1, 1, 20]"}));
  ASSERT_EQ(large.size(), 1u);
  EXPECT_THAT(large[0], HasSubstr(" % of it"));
  // What shall be avoided may well be out of reach.
  const auto avoided = set_up_in(folder, {"volume.mesh.0.position=[0, 0, 50]", "volume.mesh.0.fill=-1"});
  EXPECT_THAT(reach_warnings(*avoided), IsEmpty());
}

}  // namespace
}  // namespace espalier
