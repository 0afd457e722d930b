#include "grammar/compiler.h"

#include <gtest/gtest.h>

#include "compiled.h"

namespace espalier {
namespace {

using test::compiled;

CompileResult compile(const std::string& text, std::map<std::string, std::string> attributes = {}) {
  return compile_grammar({"test.esp", text, std::move(attributes)});
}

std::string first_code(const std::string& text) {
  const CompileResult result = compile(text);
  EXPECT_FALSE(result.graph);
  return result.diagnostics.items().empty() ? "" : result.diagnostics.items().front().code;
}

constexpr const char* kBranching = R"(grammar b 1
start S
rule S { for k in 0..2 { maybe 0.5 spawn A(k) }  maybe 0.25 spawn A(7) }
rule A(k) when depth < 4 {
  spin ~ uniform(vec(0), vec(1))
  choose {
    1: { a ~ integer(1, 6)  move x a + k  maybe 0.5 spawn A(k) }
    3: { choose { 1: { emit box } 1: { t ~ angle()  turn y t  emit cone } } }
  }
  resize spin  emit box
  maybe 0.1 spawn B
}
rule B limit 3 { emit sphere }
)";

TEST(Compiler, OneEdgePerSpawnOfTheTextOneSlotPerTurn) {
  const auto graph = compiled(kBranching);
  const Rule& start = graph->rules[graph->start()];
  ASSERT_EQ(start.slots.size(), 4u);
  EXPECT_EQ(start.slots[0].edge, start.slots[2].edge);
  EXPECT_NE(start.slots[0].edge, start.slots[3].edge);
  EXPECT_EQ(start.slots[3].name, "A[3]");
  EXPECT_EQ(graph->edges[start.slots[0].edge].name, "S/A");
  EXPECT_EQ(graph->edges[start.slots[3].edge].name, "S/A#2");
  EXPECT_DOUBLE_EQ(graph->edges[start.slots[3].edge].probability.at({}), 0.25);
  EXPECT_FALSE(graph->edges[start.slots[3].edge].required);
}

TEST(Compiler, OneVariantPerCombinationOfChoices) {
  const auto graph = compiled(kBranching);
  const Rule& rule = graph->rules[1];
  ASSERT_EQ(rule.variants.size(), 3u);
  EXPECT_EQ(rule.variants[0].name, "1");
  EXPECT_EQ(rule.variants[1].name, "2,1");
  EXPECT_EQ(rule.variants[2].name, "2,2");
  EXPECT_DOUBLE_EQ(rule.variants[0].probability.at({}), 0.25);
  EXPECT_DOUBLE_EQ(rule.variants[2].probability.at({}), 0.375);
  // Draws in text order: spin.x .y .z, a, t; each variant has its own.
  ASSERT_EQ(rule.draws.size(), 5u);
  EXPECT_EQ(rule.draws[1].name, "A.spin.y");
  EXPECT_EQ(rule.draws[3].shape, DrawShape::discrete);
  EXPECT_EQ(rule.draws[3].values, 6u);
  EXPECT_EQ(rule.draws[4].shape, DrawShape::circular);
  EXPECT_EQ(rule.variants[0].draws, (std::vector<std::uint16_t>{0, 1, 2, 3}));
  EXPECT_EQ(rule.variants[1].draws, (std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_EQ(rule.variants[2].draws, (std::vector<std::uint16_t>{0, 1, 2, 4}));
  EXPECT_EQ(rule.variants[0].slots, (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(rule.variants[1].slots, (std::vector<std::uint16_t>{1}));
}

TEST(Compiler, GuardsAndLimits) {
  const auto graph = compiled(kBranching);
  EXPECT_TRUE(graph->rules[1].guarded);
  EXPECT_NE(graph->rules[1].guard.at({3, {}}), 0);
  EXPECT_EQ(graph->rules[1].guard.at({4, {}}), 0);
  EXPECT_EQ(graph->rules[2].limit, 3u);
}

TEST(Compiler, AttributesAreConstantsOfAGraph) {
  const std::string text = "grammar a 1\nattr wide in 1..5 = 2\nstart S\nrule S { size wide  emit box }\n";
  const CompileResult plain = compile(text), wider = compile(text, {{"wide", "3"}});
  ASSERT_TRUE(plain.graph && wider.graph);
  EXPECT_EQ(wider.graph->attributes[0].value, 3);
  EXPECT_NE(plain.graph->source_hash, wider.graph->source_hash);
  EXPECT_FALSE(compile(text, {{"wide", "9"}}).graph) << "out of range";
  EXPECT_FALSE(compile(text, {{"narrow", "1"}}).graph) << "unknown";
}

TEST(Compiler, ArithmeticFoldsIntoOperands) {
  const auto graph = compiled("grammar f 1\nstart S\nrule S { a ~ uniform(0, 1)  move z 3 * (a / 2 - 1) + a  emit box }\n");
  const Program& program = graph->rules[0].variants[0].program;
  int arithmetic = 0;
  for (const Op& op : program.ops) {
    arithmetic += op.code == OpCode::unary || op.code == OpCode::binary || op.code == OpCode::ternary;
    if (op.code != OpCode::move_axis) continue;
    EXPECT_FLOAT_EQ(op.x.coefficient, 2.5f);
    EXPECT_FLOAT_EQ(op.x.bias, -3);
  }
  EXPECT_EQ(arithmetic, 0);
}

TEST(Compiler, EqualMeshesAndMaterialsAreMadeOnce) {
  const auto graph = compiled(R"(grammar m 1
material red = surface("#ff0000", roughness: 0.2)
mesh a = cone(top: 0.5, sides: 8)
mesh b = "bark.obj"
start S
rule S { paint red  emit a  emit cone(top: 0.1, sides: 8)  emit box  emit b  emit b as is  emit box }
)");
  EXPECT_EQ(graph->meshes.size(), 4u) << "cone of 8 sides, box, file, file as is";
  ASSERT_EQ(graph->materials.size(), 2u);
  EXPECT_EQ(graph->materials[1].name, "red");
  EXPECT_FLOAT_EQ(graph->materials[1].color.x, 1);
  EXPECT_FLOAT_EQ(graph->materials[1].roughness, 0.2f);
}

TEST(Compiler, WhatItRefusesHasACode) {
  EXPECT_EQ(first_code("grammar s 1\nmesh a = \"x.obj\"\nstart S\nrule S { m ~ pick(a, box)  emit m as is }\n"), "E0907");
}

}  // namespace
}  // namespace espalier
