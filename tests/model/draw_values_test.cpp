// The values that are told for a gene against what its geometry shows.
#include "model/draw_values.h"

#include <gtest/gtest.h>

#include "compiled.h"
#include "derivation/sample.h"
#include "derivation/sweep.h"
#include "grammar/compiler.h"
#include "model/expand.h"

namespace espalier {
namespace {

using test::compiled;

Vec3 scale_of(const Instance& i) {
  return {glm::length(i.model_from_mesh.basis[0]), glm::length(i.model_from_mesh.basis[1]),
          glm::length(i.model_from_mesh.basis[2])};
}

RandomStream stream(std::uint32_t i) { return RandomStream({7, Purpose::test, 0, i, 0}); }

// Every gene of A shows: its k; integer, loguniform and normal; two gaps; what pick and chance choose.
constexpr const char* kText = R"(grammar g 1
start S
rule S { base ~ uniform(1, 2)  mirror x { move x 5  spawn A(base) } }
rule A(least) when depth < 6 {
  k ~ uniform(vec(0.5), (1, 2, 3))
  n ~ integer(2, 5)
  tall ~ loguniform(0.1, 10)
  wide ~ normal(1, 0.2, 0.5, 1.5)
  more ~ uniform(least, 2 * least)
  ink ~ pick(box, 2: cone(top: 0.5), sphere)
  fat ~ chance(0.3)
  { size k  emit box }
  { size (n, tall, wide)  emit box }
  for i in 0..1 { gap ~ uniform(0.1, 0.2)  { size (gap, more, 1)  emit box } }
  { size 1  emit ink }
  { size 1  emit fat ? wedge : quad }
  maybe 0.8 spawn A(more)
})";

TEST(DrawValues, AreWhatTheGeometryShows) {
  const auto graph = compiled(kText);
  Expander expander(*graph);
  Model model;
  std::size_t genes = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    RandomStream random = stream(i);
    const Derivation d = sample(*graph, random).derivation;
    const auto values = draw_values(*graph, d);
    ASSERT_EQ(values.size(), d.draws.size());
    expander.expand(d, ExpandTo::parts, model);
    GeneSweep sweep;
    sweep.begin(*graph, d);
    while (sweep.next()) {
      if (sweep.rule().name != "A") continue;
      std::vector<Instance> shown;
      for (const Instance& one : model.instances)
        if (one.gene == sweep.position().gene && shown.size() < 6) shown.push_back(one);
      ASSERT_EQ(shown.size(), 6u);
      const auto* v = &values[sweep.position().draw];
      for (int k = 0; k < 11; ++k) ASSERT_TRUE(v[k]) << k;
      ++genes;
      for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(*v[c], scale_of(shown[0])[c]);
      for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(*v[3 + c], scale_of(shown[1])[c]);
      EXPECT_FLOAT_EQ(*v[6], scale_of(shown[2]).y);
      EXPECT_FLOAT_EQ(*v[9], scale_of(shown[2]).x);
      EXPECT_FLOAT_EQ(*v[10], scale_of(shown[3]).x);
      constexpr MeshKind kInks[] = {MeshKind::box, MeshKind::cone, MeshKind::sphere};
      EXPECT_EQ(kInks[static_cast<int>(*v[7])], graph->meshes[shown[4].mesh].kind);
      EXPECT_EQ(*v[8] == 0, graph->meshes[shown[5].mesh].kind == MeshKind::wedge);
    }
  }
  EXPECT_GT(genes, 50u);
}

TEST(DrawValues, AreMissingWhereAGeneIsNeverRun) {
  const auto graph = compiled(R"(grammar g 1
start S
rule S { k ~ uniform(-2, -1)  size k  spawn A }
rule A { tall ~ uniform(1, 2)  size tall  emit box })");
  RandomStream random = stream(0);
  const auto values = draw_values(*graph, sample(*graph, random).derivation);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_TRUE(values[0]);
  EXPECT_FALSE(values[1]);
}

TEST(DrawValues, OfAChanceThatIsNotConstantAreMissing) {
  const auto graph = compiled(R"(grammar g 1
start S
rule S { p ~ uniform(0, 1)  fat ~ chance(p)  emit fat ? box : cone })");
  RandomStream random = stream(0);
  const auto values = draw_values(*graph, sample(*graph, random).derivation);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_TRUE(values[0]);
  EXPECT_FALSE(values[1]);
}

}  // namespace
}  // namespace espalier
