#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "derivation/sample.h"
#include "compiled.h"
#include "grammar/compiler.h"
#include "model/expand.h"

namespace espalier {
namespace {

using test::compiled;

constexpr const char* kChain = R"(grammar chain 1
start A
rule A { base ~ uniform(0, 1)  spawn B }
rule B when depth < 400 {
  r ~ uniform(-0.5, 1.5)
  m ~ uniform(0, 1)
  paint surface("#808080", roughness: r, metal: m)
  size (1, r + 1, m + 1)
  emit box
  detail D(base)
  spawn B
}
detail D(b) { k ~ uniform(0, 1)  paint surface("#404040", glow: b + 0 * k)  emit box }
)";

// Every part's material is the one that its own size tells, rounded to sixteenths; the reference is this arithmetic.
TEST(MadeMaterials, AreTheDrawsRoundedAndClamped) {
  const auto graph = compiled(kChain);
  RandomStream random({5, Purpose::test, 0, 0});
  const Derivation derivation = sample(*graph, random, 10'000).derivation;
  Model model;
  Expander(*graph).expand(derivation, ExpandTo::parts, model);
  ASSERT_GT(model.instances.size(), 300u);
  EXPECT_LE(model.materials.size(), Model::kMostMaterials);
  std::size_t exact = 0;
  std::set<std::pair<int, int>> kinds;
  for (const Instance& instance : model.instances) {
    const float r = instance.model_from_mesh.basis[1].y - 1, m = instance.model_from_mesh.basis[2].z - 1;
    const int step_r = static_cast<int>(std::floor(16 * std::clamp(r, 0.0f, 1.0f) + 0.5f));
    const int step_m = static_cast<int>(std::floor(16 * m + 0.5f));
    kinds.insert({step_r, step_m});
    ASSERT_GE(instance.material, 1);
    if (instance.material < graph->materials.size()) continue;  // the middle one: too many
    ++exact;
    const MadeMaterial& made = model.materials[instance.material - graph->materials.size()];
    const Material material = graph->recipes[made.recipe].material(made.steps);
    EXPECT_NEAR(material.roughness, static_cast<float>(step_r) / 16, 1e-5f);
    EXPECT_NEAR(material.metal, static_cast<float>(step_m) / 16, 1e-5f);
  }
  EXPECT_EQ(exact + model.plain_paints, model.instances.size());
  EXPECT_EQ(model.materials.size(), std::min(kinds.size(), Model::kMostMaterials));
}

TEST(MadeMaterials, BeyondTheMostAreTheMiddleOneAndCounted) {
  const auto graph = compiled(R"(grammar many 1
start A
rule A {
  k ~ uniform(1, 1.1)
  for h in 1..2 {
    for i in 0..16 { for j in 0..16 { paint surface("#808080", k * i / 16, k * j / 16, glow: k * h)  emit box } }
  }
}
)");
  RandomStream random({5, Purpose::test, 0, 1});
  const Derivation derivation = sample(*graph, random, 100).derivation;
  Model model;
  Expander expander(*graph);
  for (int i = 0; i < 3; ++i) expander.expand(derivation, ExpandTo::parts, model);  // nothing is left over
  EXPECT_EQ(model.materials.size(), Model::kMostMaterials);
  EXPECT_GT(model.plain_paints, 0u);
  EXPECT_EQ(model.instances.back().material, graph->recipes.back().middle);
}

TEST(MadeMaterials, AreLeftOutWhereNobodyLooks) {
  const auto graph = compiled(kChain);
  RandomStream random({5, Purpose::test, 0, 3});
  const Derivation derivation = sample(*graph, random, 10'000).derivation;
  Model with, without;
  Expander(*graph).expand(derivation, ExpandTo::full, with);
  Expander(*graph, {.make_materials = false}).expand(derivation, ExpandTo::full, without);
  EXPECT_TRUE(without.materials.empty());
  EXPECT_EQ(without.plain_paints, 0u);
  ASSERT_EQ(with.instances.size(), without.instances.size());
  for (std::size_t i = 0; i < with.instances.size(); ++i) {
    EXPECT_EQ(with.instances[i].model_from_mesh.origin, without.instances[i].model_from_mesh.origin);
    EXPECT_LT(without.instances[i].material, graph->materials.size());
  }
}

TEST(MadeMaterials, ComeFromDetailsToo) {
  const auto graph = compiled(kChain);
  RandomStream random({5, Purpose::test, 0, 2});
  const Derivation derivation = sample(*graph, random, 10'000).derivation;
  Model full, parts;
  Expander expander(*graph);
  expander.expand(derivation, ExpandTo::full, full);
  expander.expand(derivation, ExpandTo::parts, parts);
  EXPECT_EQ(full.instances.size(), 2 * parts.instances.size());
  std::set<std::uint16_t> of_details;
  for (const Instance& instance : full.instances)
    if (instance.layer == Layer::detail) of_details.insert(instance.material);
  EXPECT_EQ(of_details.size(), 1u) << "one value for all";
}

}  // namespace
}  // namespace espalier
