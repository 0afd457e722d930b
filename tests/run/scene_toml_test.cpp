#include "run/scene_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

constexpr const char* kLeast = R"(espalier = 1
grammar = "g.esp"
[budget]
seconds = 2.5
[[volume.mesh]]
file = "m.obj"
)";

constexpr const char* kFull = R"(espalier = 1
grammar = "g.esp"
seed = 99
threads = 3
[attributes]
height = 2.5
leafy = true
count = 3
fork = "25deg"
[budget]
seconds = 20.0
evaluations = 5000
generations = 40
[search]
engine = "ga"
preset = "ga-2016"
population = 60
elitism = 6
initial_length = [20, 80]
mutation = 0.4
grow = 2
cut = 1
alter = 0.5
first = "random"
second = "roulette"
tournament_size = 4
crossover = "edge"
retries = 5
replace_probability = 0.25
reuse_scores = true
[limits.genes]
min = 5
max = 120
from = 50
to = 100
weight = 0.1
[limits.height]
max = 6.5
from = 4
to = 6.5
weight = 0.25
[limits.balance]
min = 0.1
from = 0.5
to = 0
weight = 2
[limits.triangles]
max = 20000
[volume]
form = "smootherstep-separate"
view = "parts"
overlap = "hits"
overlap_weight = 1.5
outside_weight = -2
cells = 1000
[volume.grid]
min = [-1, -2, -3]
max = [1, 2, 3.5]
cells = [10, 20, 30]
[[volume.mesh]]
file = "m.obj"
fill = 2
spill = 15
position = [0.1, 0, -1]
scale = 0.5
rotation_deg = [0, 90, 0]
[[volume.mesh]]
file = "n.obj"
fill = -1
scale = [1, 2, -3]
[output]
keep = 3
distance = 0.2
picture = [640, 480]
)";

std::string error_of(const std::string& text, const SceneOverrides& overrides = {}) {
  try {
    parse_scene(text, "s.toml", "", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// kLeast with a line put before (top level) or behind.
std::string with_line(const std::string& table, const std::string& line) {
  return std::string(kLeast) + "[" + table + "]\n" + line + "\n";
}

TEST(Scene, TheLeastSceneHasTheDefaults) {
  const Scene scene = parse_scene(kLeast, "s.toml", "dir");
  EXPECT_EQ(scene.grammar, "g.esp");
  EXPECT_EQ(scene.folder, "dir");
  EXPECT_EQ(scene.seed, 1u);
  EXPECT_EQ(scene.budget.seconds, 2.5);
  EXPECT_FALSE(scene.budget.evaluations);
  EXPECT_EQ(scene.search, SceneSearch{});
  EXPECT_EQ(scene.output, SceneOutput{});
  ASSERT_EQ(scene.volume.meshes.size(), 1u);
  SceneMesh mesh;
  mesh.file = "m.obj";
  EXPECT_EQ(scene.volume.meshes[0], mesh);
  EXPECT_FALSE(scene.volume.grid);
}

TEST(Scene, EverySettingIsRead) {
  const Scene s = parse_scene(kFull, "s.toml", "");
  EXPECT_EQ(s.seed, 99u);
  EXPECT_EQ(s.threads, 3);
  const std::map<std::string, std::string> attributes = {
      {"height", "2.5"}, {"leafy", "true"}, {"count", "3"}, {"fork", "25deg"}};
  EXPECT_EQ(s.attributes, attributes);
  EXPECT_EQ(s.budget, (SceneBudget{20.0, 5000, 40}));
  const GaSettings& ga = s.search.ga;
  EXPECT_EQ(ga.population, 60u);
  EXPECT_EQ(ga.initial_length_min, 20u);
  EXPECT_EQ(ga.initial_length_max, 80u);
  EXPECT_EQ(ga.grow, 2);
  EXPECT_EQ(ga.first, SelectionScheme::random);
  EXPECT_EQ(ga.crossover, Compatibility::edge);
  EXPECT_EQ(ga.retries, 5u);
  EXPECT_TRUE(ga.reuse_scores);
  EXPECT_EQ(ga.genes, (GeneLimits{5, 120}));
  EXPECT_EQ(s.limits.of[Measure::genes], (Limit{.from = 50, .to = 100, .weight = 0.1}));
  EXPECT_EQ(s.limits.of[Measure::height], (Limit{.max = 6.5, .from = 4, .to = 6.5, .weight = 0.25}));
  EXPECT_EQ(s.limits.of[Measure::balance], (Limit{.min = 0.1, .from = 0.5, .to = 0, .weight = 2}));
  EXPECT_EQ(s.limits.of[Measure::triangles], (Limit{.max = 20000}));
  EXPECT_EQ(s.limits.of[Measure::depth], Limit{});
  EXPECT_EQ(s.volume.form, VolumeForm::smootherstep_separate);
  EXPECT_EQ(s.volume.overlap, OverlapCount::hits);
  EXPECT_EQ(s.volume.outside_weight, -2);
  EXPECT_EQ(s.volume.grid->cells[2], 30u);
  EXPECT_EQ(s.volume.meshes[0].scale, Vec3(0.5f));
  EXPECT_EQ(s.volume.meshes[0].spill, 15);
  EXPECT_EQ(s.volume.meshes[1].scale, Vec3(1, 2, -3));
  EXPECT_FALSE(s.volume.meshes[1].spill);
  EXPECT_EQ(s.output.picture[1], 480u);
}

TEST(Scene, WrittenOutItReadsBackEqual) {
  for (const char* text : {kLeast, kFull}) {
    Scene scene = parse_scene(text, "s.toml", "");
    const Scene again = parse_scene(to_toml(scene), "again", "");
    scene.threads = 0;  // no part of what a scene means
    EXPECT_EQ(again, scene) << to_toml(scene);
    EXPECT_EQ(to_toml(again), to_toml(scene));
  }
}

TEST(Scene, LengthPresetsAreDefaultsOfTheRampOnGenes) {
  const auto scene = [](const std::string& limits) { return parse_scene(kLeast + limits, "s.toml", ""); };
  const Scene early = scene("[limits]\npreset = \"length-2016\"\n");
  EXPECT_EQ(early.limits.of[Measure::genes], (Limit{.from = 40, .to = 100, .weight = 0.2}));
  const Scene late = scene("[limits]\npreset = \"length-2017\"\n[limits.genes]\nmin = 2\nmax = 60\nweight = 0.3\n");
  EXPECT_EQ(late.limits.of[Measure::genes], (Limit{.from = 2, .to = 60, .weight = 0.3}));
  for (const Scene& s : {early, late}) EXPECT_EQ(parse_scene(to_toml(s), "again", ""), s) << to_toml(s);
}

struct Bad {
  const char* table;
  const char* line;
  const char* expected;  // part of the message
};

// Every message starts with file and place, then key, rule, value.
const Bad kBad[] = {
    {"search", "populaton = 5",
     "s.toml:8:13: search.populaton is no setting of a scene; did you mean search.population?"},
    {"serch", "population = 5", "serch is no setting of a scene; did you mean search?"},
    {"zzzzzzzzzzzz", "a = 1", "zzzzzzzzzzzz is no setting of a scene"},
    {"search", "population = 1", "s.toml:8:14: search.population must be a whole number from 2 to 1000000, got 1"},
    {"search", "population = 2.5", "must be a whole number from 2 to 1000000, got 2.5"},
    {"search", "population = -3", "got -3"},
    {"search", "population = \"many\"", "got \"many\""},
    {"search", "elitism = 150", "s.toml:7:1: search.elitism must be between 0 and 149, got 150"},
    {"search", "mutation = nan", "search.mutation must be a number from 0 to 1, got nan"},
    {"search", "mutation = inf", "got inf"},
    {"search", "mutation = true", "must be a number, got true"},
    {"search", "first = \"wheel\"",
     "search.first must be one of \"roulette\", \"tournament\", \"random\", got \"wheel\""},
    {"search", "engine = \"smc2\"", "search.engine must be one of"},
    {"search", "preset = \"ga-1\"", "s.toml:8:10: search.preset must be one of ga-2017"},
    {"search", "initial_length = [20]", "search.initial_length must be a list of 2 whole numbers, got a list of 1"},
    {"search", "initial_length = [80, 20]", "initial_length (its upper end) must be between 80"},
    {"search", "grow = 0\ncut = 0\nalter = 0", "search.grow + cut + alter"},
    {"limits.genes", "min = 50\nmax = 20", "limits.genes.max must be at least limits.genes.min = 50, got 20"},
    {"limits.genes", "from = 5\nto = 5\nweight = 1",
     "s.toml:9:6: limits.genes.to must differ from limits.genes.from = 5, got 5"},
    {"limits.genes", "from = 5\nto = 8", "s.toml:8:8: limits.genes.from needs limits.genes.weight beside it"},
    {"limits.height", "from = 5\nweight = 1", "s.toml:9:10: limits.height.weight needs limits.height.to beside it"},
    {"limits.height", "min = 5\nmax = 4",
     "s.toml:9:7: limits.height.max must be at least limits.height.min = 5, got 4"},
    {"limits.height", "max = -1", "limits.height.max must be a number from 0 to 1000000000, got -1"},
    {"limits.depth", "max = 2.5", "limits.depth.max must be a whole number from 0 to 1000000, got 2.5"},
    {"limits.balance", "min = 1.5", "limits.balance.min must be a number from 0 to 1, got 1.5"},
    {"limits.heigth", "max = 1", "limits.heigth is no setting of a scene; did you mean limits.height?"},
    {"limits", "height = 3", "limits.height must be a table, got 3"},
    {"limits", "preset = \"length-2018\"", "limits.preset must be one of \"length-2016\", \"length-2017\", got"},
    {"limits.genes", "max = 10", "search.initial_length must overlap the gene limits 4 to 10, got 50 to 50"},
    {"limits.width", "max = 10", "limits.width is no setting"},
    {"volume.grid", "min = [0,0,0]\nmax = [1,1,1]", "volume.grid must have cells"},
    {"volume.grid", "min = [0,0,0]\nmax = [1,0,1]\ncells = [1,1,1]",
     "must be greater than volume.grid.min along y, got 0 and 0"},
    {"volume.grid", "min = [0,0,0]\nmax = [1,1,1]\ncells = [1,1]",
     "must be a list of 3 whole numbers, got a list of 2"},
    {"volume.grid", "min = [0,0,0]\nmax = [1,1,1]\ncells = [4000,4000,4000]",
     "must multiply to at most 64000000, got 64000000000"},
    {"volume.grid", "min = [0,0]\nmax = [1,1,1]\ncells = [1,1,1]",
     "volume.grid.min must be [x, y, z], got a list of 2"},
    {"output", "refresh_seconds = -1", "output.refresh_seconds must be a number from 0 to 1000000, got -1"},
    {"output", "keep = 100", "output.keep must be a whole number from 0 to 99, got 100"},
    {"output", "picture = [10, 10]", "output.picture must be a whole number from 16 to 8192, got 10"},
    {"attributes", "a = 1979-05-27", "attributes.a must be a number, true, false or a text, got a date or time"},
    {"attributes", "a = nan", "attributes.a must be a number"},
};

TEST(Scene, BadSettingsNamePlaceKeyRuleAndValue) {
  for (const Bad& bad : kBad) {
    EXPECT_THAT(error_of(with_line(bad.table, bad.line)), HasSubstr(bad.expected)) << bad.table << ": " << bad.line;
    EXPECT_THAT(error_of(with_line(bad.table, bad.line)), HasSubstr("s.toml:"));
  }
}

TEST(Scene, WhatMustBeThereIsAskedFor) {
  EXPECT_THAT(error_of(""), HasSubstr("espalier must be 1, the version"));
  EXPECT_THAT(error_of("espalier = 2"), HasSubstr("espalier must be a whole number from 1 to 1, got 2"));
  EXPECT_THAT(error_of("espalier = 1"), HasSubstr("grammar must be the path of a grammar"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\""), HasSubstr("volume must be given"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\"\n[volume]\n"),
              HasSubstr("volume.mesh must name at least one mesh"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\"\n[volume]\nmesh = 3\n"), HasSubstr("written [[volume.mesh]]"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\"\n[[volume.mesh]]\nfill = 1\n"),
              HasSubstr("volume.mesh.0.file must be the path of a mesh"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\"\n[[volume.mesh]]\nfile = \"m\"\n"),
              HasSubstr("budget must give seconds, evaluations or generations"));
  EXPECT_THAT(error_of("espalier = 1\ngrammar = \"g\"\nvolume = 7"), HasSubstr("volume must be a table, got 7"));
}

TEST(Scene, MeshesAreCheckedToo) {
  const auto error_with = [](const std::string& line) { return error_of(std::string(kLeast) + line + "\n"); };
  EXPECT_THAT(error_with("scale = [1, 0, 1]"), HasSubstr("s.toml:7:9: volume.mesh.0.scale must not be 0"));
  EXPECT_THAT(error_with("scale = \"big\""), HasSubstr("volume.mesh.0.scale must be a number or [x, y, z]"));
  EXPECT_THAT(error_with("position = [1, 2, nan]"), HasSubstr("volume.mesh.0.position must be a number"));
  EXPECT_THAT(error_with("spil = 1"), HasSubstr("did you mean volume.mesh.0.spill?"));
}

TEST(Scene, OverridesComeLast) {
  const Scene s = parse_scene(kFull, "s.toml", "",
                              {{"seed=5", "search.population=77", "volume.mesh.0.file=other.obj", "output.keep=1",
                                "budget={evaluations = 10}"},
                               {"height=3", "fork=10deg"}});
  EXPECT_EQ(s.seed, 5u);
  EXPECT_EQ(s.search.ga.population, 77u);
  EXPECT_EQ(s.volume.meshes[0].file, "other.obj");
  EXPECT_EQ(s.output.keep, 1u);
  EXPECT_FALSE(s.budget.seconds);
  EXPECT_EQ(s.budget.evaluations, 10u);
  EXPECT_EQ(s.attributes.at("height"), "3");
  EXPECT_EQ(s.attributes.at("fork"), "10deg");
}

TEST(Scene, AnEngineHasSettingsOfItsOwn) {
  const auto ga = [](const std::string& tables, const SceneOverrides& overrides = {}) {
    return parse_scene(kLeast + tables, "s.toml", "", overrides).search.ga;
  };
  const std::string both =
      "[search]\npopulation = 200\nelitism = 5\n[engine.ga]\npreset = \"ga-local\"\npopulation = 40\n";
  GaSettings expected = ga_preset("ga-local");
  expected.population = 40, expected.elitism = 5;
  EXPECT_EQ(ga(both), expected) << "what is said for one engine wins over what is said for all";
  EXPECT_EQ(ga(both, {{"search.population=77"}, {}}).population, 77u) << "and the command line over both";
  EXPECT_EQ(ga(both, {{"engine.ga.population=78"}, {}}).population, 78u);
  EXPECT_EQ(ga(both, {{"search.preset=ga-2017-city"}, {}}).mutation, 0.4);
  EXPECT_EQ(ga("[engine.ga]\njoin = true\n").join, true);
}

TEST(Scene, SettingsWrittenForAnEngineTakeTheSameOverrides) {
  const Scene scene = parse_scene(kFull, "s.toml", "");
  const std::string written = to_toml(scene);
  EXPECT_THAT(written, HasSubstr("[engine.ga]\npreset = \"ga-2016\"\n"));
  EXPECT_EQ(parse_scene(written, "w", "", {{"search.population=77", "search.engine=ga"}, {}}).search.ga.population,
            77u);
}

TEST(Scene, BadSettingsOfEnginesAreNamed) {
  EXPECT_THAT(error_of(with_line("engine.gaa", "population = 5")),
              HasSubstr("s.toml:7:1: engine.gaa is no engine; there is \"ga\", \"smc\""));
  EXPECT_THAT(error_of(with_line("engine.ga", "population = 1")),
              HasSubstr("s.toml:8:14: engine.ga.population must be a whole number from 2 to 1000000, got 1"));
  EXPECT_THAT(error_of(with_line("engine.ga", "populaton = 9")), HasSubstr("did you mean engine.ga.population?"));
  EXPECT_THAT(error_of(with_line("engine.ga", "engine = \"ga\"")), HasSubstr("engine.ga.engine is no setting"));
  EXPECT_THAT(error_of(with_line("engine.ga", "elitism = 150")),
              HasSubstr("engine.ga.elitism must be between 0 and 149"));
  EXPECT_THAT(error_of(with_line("engine.ga", "preset = \"x\"")),
              HasSubstr("s.toml:8:10: engine.ga.preset must be one of"));
  EXPECT_THAT(error_of(with_line("engine", "ga = 3")), HasSubstr("engine.ga must be a table, got 3"));
  EXPECT_THAT(
      error_of(kLeast, {{"search.engine=smc2"}, {}}),
      HasSubstr("search.engine must be one of \"ga\", \"smc\", \"sosmc\", \"rjmcmc\", \"hybrid\", \"guided\", \"genesis\", got \"smc2\""));
}

TEST(Scene, BadOverridesSayWhereTheyCameFrom) {
  EXPECT_THAT(error_of(kLeast, {{"search.population=1"}, {}}),
              HasSubstr("s.toml (set on the command line): search.population must be a whole number"));
  EXPECT_THAT(error_of(kLeast, {{"search.populatoin=9"}, {}}), HasSubstr("did you mean search.population?"));
  EXPECT_THAT(error_of(kLeast, {{}, {"height"}}), HasSubstr("-D must be NAME=VALUE, got \"height\""));
}

TEST(Scene, FilesThatAreNoScenesAreRefused) {
  const TemporaryFolder folder;
  const auto load_error = [](const std::string& path) -> std::string {
    try {
      load_scene(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(load_error(folder / "none.toml"), HasSubstr("none.toml"));
  EXPECT_THAT(load_error(folder.path()), HasSubstr(folder.path()));
  write_text(folder / "binary.toml", std::string("espalier = 1\n\0\x01\x02", 16));
  EXPECT_THAT(load_error(folder / "binary.toml"), HasSubstr("must be text, got binary data"));
  write_text(folder / "huge.toml", std::string((16u << 20) + 1, '#'));
  EXPECT_THAT(load_error(folder / "huge.toml"), HasSubstr("huge.toml"));
  write_text(folder / "cut.toml", std::string(kFull).substr(0, 333));
  EXPECT_NE(load_error(folder / "cut.toml"), "no error");
}

}  // namespace
}  // namespace espalier
