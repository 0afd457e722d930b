#include "run/founders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "derivation/encode.h"
#include "derivation/position.h"
#include "run/derivation_file.h"
#include "run/reproduce.h"
#include "run/resume_runs.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_text;

Derivation best_of(const std::string& run) { return load_derivation(run + "/best.derivation.json", "", {}).derivation; }

/// A subtree as a derivation's text would tell it: edges, variants and slots, and where asked for the draws.
std::string subtree_text(const GeneratorGraph& graph, const Derivation& derivation, const std::string& path, bool draws,
                         bool whole = true) {
  const auto gene = find_gene(graph, derivation, parse_gene_path(graph, path));
  if (!gene) return "there is no such gene";
  GenePath way;
  locate(graph, derivation, *gene, way);
  SubtreeSlice slice = subtree_at(graph, derivation, way.gene);
  if (!whole) {
    const Variant& variant = variant_of(graph, derivation.genes[*gene]);
    slice.genes = 1, slice.slots = 0, slice.draws = static_cast<std::uint32_t>(variant.draws.size());
  }
  std::string text;
  for (std::uint32_t i = 0; i < slice.genes; ++i) {
    const GeneRecord& record = derivation.genes[slice.begin.gene + i];
    text += std::to_string(record.edge) + "." + std::to_string(record.variant) + " ";
  }
  for (std::uint32_t i = 0; i < slice.slots; ++i) {
    text += "OEFA"[static_cast<std::size_t>(derivation.slots[slice.begin.slot + i])];
  }
  for (std::uint32_t i = 0; draws && i < slice.draws; ++i) {
    text += " " + std::to_string(derivation.draws[slice.begin.draw + i]);
  }
  return text;
}

namespace fs = std::filesystem;

class Starting : public ::testing::Test {
 protected:
  Starting() {
    testing::write_resumable(folder_, 25);
    EXPECT_TRUE(run("first", {"limits.genes.max=12", "budget.generations=2"}));
    graph_ = load_derivation(folder_ / "first/best.derivation.json", "", {}).grammar.graph;
  }

  bool run(const std::string& out, const std::vector<std::string>& settings) {
    AssimpMeshSource source;
    return run_scene(load_scene(folder_ / "scene.toml", {settings, {}}), {folder_ / out, nullptr, nullptr}, source);
  }
  std::string error_of(const std::vector<std::string>& settings) {
    try {
      run("failed", settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  /// The path of a gene that has some below it.
  std::string some_path() const {
    const Derivation first = best_of(folder_ / "first");
    for (std::uint32_t g = 2; g < first.size(); ++g) {
      if (first.genes[g].genes_below >= 2) return format_gene_path(*graph_, gene_path(*graph_, first, g));
    }
    ADD_FAILURE() << "no gene has two below it";
    return "";
  }

  const std::string start_ = "start.derivation=first/best.derivation.json";
  TemporaryFolder folder_;
  std::shared_ptr<const GeneratorGraph> graph_;
};

class StartingEngines : public Starting, public ::testing::WithParamInterface<std::string_view> {};

TEST_P(StartingEngines, KeepWhatIsLocked) {
  const std::string path = some_path(), engine = "search.engine=" + std::string(GetParam());
  const Derivation first = best_of(folder_ / "first");
  struct Case {
    std::string suffix;
    bool draws, whole;
  };
  const auto executor = make_serial_executor();
  AssimpMeshSource source;
  const Case cases[] = {{"", true, true}, {":draws", true, false}, {":structure", false, true}};
  for (const auto& [suffix, draws, whole] : cases) {
    const SceneOverrides overrides = {{engine, start_, "start.locks=[\"" + path + suffix + "\"]", "seed=9"}, {}};
    const auto setup = set_up(load_scene(folder_ / "scene.toml", overrides), source);
    SearchSession session(*setup, *executor);
    const std::string kept = subtree_text(*graph_, first, path, draws, whole);
    for (int step = 0; step < 60; ++step) {
      session.step();
      for (const Individual& one : session.engine().population()) {
        ASSERT_EQ(subtree_text(*graph_, one.derivation, path, draws, whole), kept) << suffix << " at step " << step;
      }
    }
    const SearchResult result = session.finish("steps");
    EXPECT_EQ(subtree_text(*graph_, result.best.derivation, path, draws, whole), kept) << suffix;
    for (const Individual& one : result.alternatives) {
      EXPECT_EQ(subtree_text(*graph_, one.derivation, path, draws, whole), kept) << suffix;
    }
    EXPECT_FALSE(result.best.derivation == first) << "the rest is searched over";
  }
  ASSERT_TRUE(run("out", {engine, start_, "start.locks=[\"" + path + ":structure\"]"}));
  EXPECT_THAT(read_text(folder_ / "out/run.toml"), HasSubstr("locks = [\"" + path + ":structure\"]"));
  const ReproduceReport report = reproduce(folder_ / "out/best.glb", "", source, *executor);
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
}

INSTANTIATE_TEST_SUITE_P(Run, StartingEngines, ::testing::ValuesIn(testing::kGrowingEngines),
                         [](const auto& engine) { return std::string(engine.param); });

TEST_F(Starting, TheBestIsNeverWorseThanTheStart) {
  ASSERT_TRUE(run("out", {start_, "budget.generations=1"}));
  const auto score = [&](const char* file) {
    return nlohmann::json::parse(read_text(folder_ / file))["score"].get<double>();
  };
  EXPECT_GE(score("out/result.json"), score("first/result.json"));
  EXPECT_EQ(read_text(folder_ / "out/inputs/start/best.derivation.json"),
            read_text(folder_ / "first/best.derivation.json"));
}

TEST_F(Starting, AContinuedRunKeepsItsLocks) {
  const std::vector<std::string> settings = {start_, "start.locks=[\"" + some_path() + "\"]",
                                             "output.checkpoint_seconds=100"};
  ASSERT_TRUE(run("whole", settings));
  std::vector<std::string> shorter = settings;
  shorter.push_back("budget.generations=9");
  ASSERT_TRUE(run("out", shorter));
  AssimpMeshSource source;
  ASSERT_TRUE(resume_run({.folder = folder_ / "out", .budget = {.generations = 25}}, {}, source));
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(Starting, WhatCannotBeStartedFromIsSaidWhy) {
  EXPECT_THAT(error_of({"start.derivation=nowhere.derivation.json"}),
              HasSubstr("nowhere.derivation.json: cannot read"));
  EXPECT_THAT(error_of({"start.derivation=pile.esp"}), HasSubstr("pile.esp: derivation: "));
  EXPECT_THAT(error_of({start_, "limits.genes.max=5", "search.initial_length=3"}),
              HasSubstr("limits.genes allows 2 to 5, it has "));
  EXPECT_THAT(error_of({start_, "limits.height.max=0.5"}), HasSubstr("a hard limit does not accept it: "));
  const Derivation first = best_of(folder_ / "first");
  Derivation open = first;
  for (SlotState& slot : open.slots) slot = slot == SlotState::empty ? SlotState::open : slot;
  write_text(folder_ / "open.derivation.json", encode(*graph_, open));
  EXPECT_THAT(error_of({"start.derivation=open.derivation.json"}), HasSubstr("it is not finished"));
}

TEST_F(Starting, LocksThatHoldNothingAreNamed) {
  EXPECT_THAT(error_of({start_, "start.locks=[\"Pile/Brick\"]"}), HasSubstr("rule Pile has no slot \"Brick\""));
  std::string path = "Pile";
  for (int i = 0; i < 13; ++i) path += i == 0 ? "/Block" : "/Block[0]";
  EXPECT_THAT(error_of({start_, "start.locks=[\"" + path + "\"]"}),
              HasSubstr("leads to no gene: nothing stands in slot Block[0] of Pile/Block"));
  EXPECT_THAT(error_of({start_, "start.locks=[\"Pile:all\"]"}), HasSubstr("start.locks must end with :subtree"));
  EXPECT_THAT(error_of({start_, "start.locks=\"Pile\""}), HasSubstr("start.locks must be a list of texts"));
  EXPECT_THAT(error_of({start_, "start.lock=[]"}), HasSubstr("did you mean start.locks?"));
  EXPECT_THAT(error_of({"start.locks=[\"Pile\"]"}), HasSubstr("start.derivation must be the path of"));
}

TEST_F(Starting, AnotherGrammarsModelIsAdapted) {
  std::string grammar = read_text(folder_ / "pile.esp");
  grammar.replace(grammar.find("vec(0.7)"), 8, "vec(0.69)");
  write_text(folder_ / "pile.esp", grammar);
  EXPECT_TRUE(run("out", {start_}));
}

TEST_F(Starting, OfManyThoseThatFitAreTaken) {
  const Derivation first = best_of(folder_ / "first");
  std::string lines = to_line(*graph_, first) + "\n";
  for (const auto& entry : fs::directory_iterator(folder_ / "first/alternatives")) {
    if (!entry.path().string().ends_with(".json")) continue;
    lines += to_line(*graph_, load_derivation(entry.path().string(), "", {}).derivation) + "\n";
  }
  Derivation open = first;
  for (SlotState& slot : open.slots) slot = slot == SlotState::empty ? SlotState::open : slot;
  write_text(folder_ / "many.derivations.jsonl", lines + to_line(*graph_, open) + "\n");
  AssimpMeshSource source;
  const SceneOverrides many = {{"start.derivation=many.derivations.jsonl"}, {}};
  const auto setup = set_up(load_scene(folder_ / "scene.toml", many), source);
  ASSERT_EQ(setup->founders.size(), 2u);
  EXPECT_EQ(setup->founders[0].derivation, first);
  EXPECT_GE(setup->founders[0].score, setup->founders[1].score);
  EXPECT_THAT(setup->warnings.back(), HasSubstr("1 of 3 models are left out; of the first, it is not finished"));
  write_text(folder_ / "many.derivations.jsonl", lines + "{\n");
  EXPECT_THAT(error_of(many.settings), HasSubstr("many.derivations.jsonl:3: derivation: "));
  write_text(folder_ / "many.derivations.jsonl", "\n");
  EXPECT_THAT(error_of(many.settings), HasSubstr("holds no derivation"));
}

TEST(SceneStart, IsWrittenAndReadAgain) {
  const std::string text = "espalier = 1\ngrammar = \"g.esp\"\nbudget.seconds = 1\n[[volume.mesh]]\nfile = \"m.obj\"\n"
                           "[start]\nderivation = \"a \\\"b\\\".json\"\n"
                           "locks = [\"A/B[2]\", \"A:draws\", \"A/C:structure\", \"A/D:subtree\"]\n";
  const Scene scene = parse_scene(text, "s.toml", "");
  ASSERT_EQ(scene.start.locks.size(), 4u);
  EXPECT_EQ(scene.start.locks[0], (SceneLock{"A/B[2]", LockScope::subtree}));
  EXPECT_EQ(scene.start.locks[1], (SceneLock{"A", LockScope::draws}));
  EXPECT_EQ(scene.start.locks[2], (SceneLock{"A/C", LockScope::structure}));
  EXPECT_EQ(parse_scene(to_toml(scene), "w", "").start, scene.start);
}

// Where all is locked nothing is ever scored again: a budget of evaluations would never be spent.
TEST_F(Starting, WhereAllIsLockedTheSearchEnds) {
  const std::string root = format_gene_path(*graph_, {});
  for (const char* engine : {"ga", "rjmcmc"}) {
    ASSERT_TRUE(run("end", {"start.derivation=first/best.derivation.json", "start.locks=[\"" + root + "\"]",
                            "search.engine=" + std::string(engine), "budget={evaluations = 1000000}"}))
        << engine;
    const auto result = nlohmann::json::parse(read_text(folder_ / "end/result.json"));
    EXPECT_EQ(result["stopped_by"], "nothing left to try") << engine;
    EXPECT_LT(result["steps"], 5000) << engine;
    EXPECT_EQ(best_of(folder_ / "end"), best_of(folder_ / "first")) << engine;
  }
  // The hybrid's engines score a population whenever they take over.
  ASSERT_TRUE(run("end", {"start.derivation=first/best.derivation.json", "start.locks=[\"" + root + "\"]",
                          "search.engine=hybrid", "engine.hybrid.turn=100", "budget={evaluations = 1500}"}));
}

}  // namespace
}  // namespace espalier
