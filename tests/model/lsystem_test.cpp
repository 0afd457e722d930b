// Imported L-systems grow what string rewriting and a turtle draw.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "grammar/lsystem_import.h"
#include "model/expand.h"
#include "model/reference_turtle.h"

namespace espalier {
namespace {

using reference::Line;

std::string text_of(const std::string& name) {
  std::ifstream in(std::filesystem::path(ESPALIER_SOURCE_DIR) / "tests/grammar/lsystems" / (name + ".lsys"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Imported {
  lsystem::System system;
  std::shared_ptr<const GeneratorGraph> graph;
  Derivation derivation;
  Model model;
};

Imported import(const std::string& source, std::uint64_t seed = 1) {
  Diagnostics diagnostics;
  Imported result;
  const auto system = lsystem::parse(source, diagnostics);
  const auto text = import_lsystem(source, {"test", "test.lsys", {}}, diagnostics);
  EXPECT_TRUE(system && text) << render(diagnostics, "test.lsys", source);
  if (!system || !text) return result;
  result.system = *system;
  const CompileResult compiled = compile_grammar({"test.esp", *text, {}});
  EXPECT_TRUE(compiled.diagnostics.items().empty()) << render(compiled.diagnostics, "test.esp", *text);
  result.graph = compiled.graph;
  RandomStream random(StreamKey{seed});
  SampleResult sampled = sample(*result.graph, random, 200'000);
  EXPECT_FALSE(sampled.truncated);
  result.derivation = std::move(sampled.derivation);
  Expander(*result.graph).expand(result.derivation, ExpandTo::full, result.model);
  EXPECT_FALSE(result.model.truncated);
  EXPECT_EQ(result.model.dropped, 0u);
  return result;
}

std::vector<Line> lines_of_parts(const Model& model) {
  std::vector<Line> result;
  for (const Instance& i : model.instances) {
    const glm::dvec3 half = 0.5 * glm::dvec3(i.model_from_mesh.basis[1]), middle(i.model_from_mesh.origin);
    result.push_back({middle - half, middle + half});
  }
  return result;
}

std::vector<Line> lines_of_bones(const Model& model) {
  std::vector<Line> result;
  for (const Bone& b : model.bones) result.push_back({glm::dvec3(b.from), glm::dvec3(b.to)});
  return result;
}

/// Segments that stand for runs of several steps, as `F -> FF` makes them, step by step.
std::vector<Line> in_steps(const std::vector<Line>& lines, double step) {
  std::vector<Line> result;
  for (const Line& line : lines) {
    const double count = std::max(1.0, std::round(glm::length(line.to - line.from) / step));
    for (double i = 0; i < count; ++i)
      result.push_back({glm::mix(line.from, line.to, i / count), glm::mix(line.from, line.to, (i + 1) / count)});
  }
  return result;
}

double distance(const Line& a, const Line& b) {
  return std::max(glm::length(a.from - b.from), glm::length(a.to - b.to));
}

/// Each line has a partner of its own within 1e-4.
void expect_same(std::vector<Line> found, const std::vector<Line>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (const Line& w : wanted) {
    const auto best = std::min_element(found.begin(), found.end(),
                                       [&](const Line& a, const Line& b) { return distance(a, w) < distance(b, w); });
    ASSERT_LT(distance(*best, w), 1e-4) << w.from.x << " " << w.from.y << " " << w.from.z << " of " << wanted.size();
    *best = found.back();
    found.pop_back();
  }
}

std::vector<Line> drawn(const lsystem::System& system) {
  const reference::LSystem reference(system);
  reference::Word word = reference.axiom();
  for (int i = 0; i < system.iterations; ++i) word = reference.rewrite(word);
  return reference.walk(word);
}

class Deterministic : public ::testing::TestWithParam<const char*> {};

TEST_P(Deterministic, GrowsWhatTheTurtleDraws) {
  const Imported imported = import(text_of(GetParam()));
  ASSERT_TRUE(imported.graph);
  const std::vector<Line> wanted = drawn(imported.system);
  ASSERT_GT(wanted.size(), 10u);
  expect_same(lines_of_parts(imported.model), wanted);
  if (imported.graph->details.empty()) expect_same(lines_of_bones(imported.model), wanted);
}

INSTANTIATE_TEST_SUITE_P(LSystems, Deterministic,
                         ::testing::Values("koch_island", "koch_snow", "dragon", "bracketed", "bush", "hilbert3d",
                                           "tree_guards", "tree_uneven", "row_of_trees", "counting", "ages"),
                         [](const auto& test) { return std::string(test.param); });

TEST(LSystems, StraightGrowthIsOneSegmentForEachRun) {
  const Imported imported = import(text_of("plant"));
  EXPECT_EQ(imported.model.bones.size(), 2u * (1 + 3 + 9 + 27 + 81));
  expect_same(in_steps(lines_of_bones(imported.model), imported.system.step), drawn(imported.system));
}

TEST(LSystems, ChoicesAreVariants) {
  std::set<std::size_t> sizes;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Imported imported = import(text_of("stochastic"), seed);
    std::size_t gene = 0;  // the start rule's; genes lie in the order in which the reference asks
    const auto choose = [&](const std::vector<std::size_t>& productions) {
      const GeneRecord& record = imported.derivation.genes.at(++gene);
      return productions.at(record.variant);
    };
    const reference::LSystem reference(imported.system);
    // The stem's own growth is no choice and makes no genes.
    const auto word = reference.rewrite_deep(reference.axiom(), imported.system.iterations, choose);
    EXPECT_EQ(gene + 1, imported.derivation.genes.size());
    expect_same(in_steps(lines_of_bones(imported.model), imported.system.step), reference.walk(word));
    sizes.insert(imported.model.bones.size());
  }
  EXPECT_GT(sizes.size(), 1u);
}

TEST(LSystems, TurnsGoTheBooksWay) {
  for (const char* turn : {"+", "-", "&", "^", "\\", "/", "|", "+(30)", "^(20)/(50)", "&&+", "\\\\-^"}) {
    const Imported imported = import(std::string("axiom: F") + turn + "F[&F]+F\nangle: 25\n");
    expect_same(lines_of_bones(imported.model), drawn(imported.system));
  }
}

TEST(LSystems, GrowthOfTurtleSymbols) {
  for (const char* rules :
       {"F(l) -> F(l * 1.1)\n", "F -> FfF\n", "f -> ff\n", "+(a) -> +(a * 0.9)\n", "F -> FFF\nf -> ff\n"}) {
    const Imported imported = import(std::string("axiom: A\niterations: 4\nangle: 25\nA -> F(0.5)f+(20)[-F]fFA\n") + rules);
    expect_same(in_steps(lines_of_bones(imported.model), imported.system.step), drawn(imported.system));
  }
}

TEST(LSystems, WidthsFollowTheBrackets) {
  const Imported imported = import("axiom: F[!F!F]F!(0.5)F\nwidth: 0.2\nthinner: 0.5\n");
  std::vector<float> widths;
  for (const Instance& i : imported.model.instances) widths.push_back(glm::length(i.model_from_mesh.basis[0]));
  const std::vector<float> wanted = {0.2f, 0.1f, 0.05f, 0.2f, 0.5f};
  ASSERT_EQ(widths.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(widths[i], wanted[i], 1e-6) << i;
}

}  // namespace
}  // namespace espalier
