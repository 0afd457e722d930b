#include "derivation/nudge.h"

#include <cmath>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"

namespace espalier {
namespace {

constexpr const char* kGrammar = R"(grammar n 1
start S
rule S { a ~ uniform(0, 1)  b ~ angle()  turn y b  size a  emit box  spawn T  spawn E }
rule T { n ~ integer(1, 4)  size n  emit box }
rule E { emit box }
)";

std::shared_ptr<const GeneratorGraph> graph() {
  const std::string text = kGrammar;
  const CompileResult result = compile_grammar({"n.esp", text, {}});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, "n.esp", text);
  return result.graph;
}

Derivation sampled(const GeneratorGraph& g) {
  RandomStream random({1, Purpose::test});
  return sample(g, random).derivation;
}

TEST(Nudge, MovesOneQuantileOnly) {
  const auto g = graph();
  RandomStream random({2, Purpose::test});
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const Derivation before = sampled(*g);
    Derivation after = before;
    ASSERT_TRUE(nudge(*g, after, {}, random));
    ASSERT_EQ(find_fault(*g, after), "");
    EXPECT_EQ(after.genes, before.genes);
    EXPECT_EQ(after.slots, before.slots);
    int changed = 0;
    for (std::size_t k = 0; k < 3; ++k) changed += after.draws[k] != before.draws[k];
    EXPECT_EQ(changed, 1);
    near += std::abs(static_cast<double>(after.draws[0]) - before.draws[0]) < 0x1p32 / 16;
  }
  EXPECT_GT(near, 1500) << "most steps are small";
}

TEST(Nudge, ReachesEveryDrawAndStepsOverPlateaus) {
  const auto g = graph();
  RandomStream random({3, Purpose::test});
  Derivation d = sampled(*g);
  int times[3] = {}, plateaus[4] = {};
  for (int i = 0; i < 4000; ++i) {
    const Derivation before = d;
    nudge(*g, d, {}, random);
    for (std::size_t k = 0; k < 3; ++k) times[k] += d.draws[k] != before.draws[k];
    if (d.draws[2] == before.draws[2]) continue;
    ++plateaus[d.draws[2] >> 30];
  }
  // Genes are equally likely: S shares its half between two draws.
  EXPECT_NEAR(times[0], 1000, 130);
  EXPECT_NEAR(times[1], 1000, 130);
  EXPECT_NEAR(times[2], 2000, 150);
  for (const int count : plateaus) EXPECT_GT(count, 200);
}

TEST(Nudge, ReflectsAndWraps) {
  const auto g = graph();
  RandomStream random({4, Purpose::test});
  Derivation d = sampled(*g);
  bool wrapped = false;
  for (int i = 0; i < 3000; ++i) {
    d.draws = {0, 0, 0};
    nudge(*g, d, {}, random);
    EXPECT_LE(d.draws[0], 1u << 31) << "continuous quantiles stay on this side of 0";
    wrapped |= d.draws[1] > 1u << 31;
  }
  EXPECT_TRUE(wrapped) << "angles go round";
}

TEST(Nudge, HonoursLocksAndRefusesWhereNothingIsFree) {
  const auto g = graph();
  RandomStream random({5, Purpose::test});
  Derivation d = sampled(*g);
  const Derivation before = d;
  const Locks half = {{{}, LockScope::draws}};
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(nudge(*g, d, half, random));
  EXPECT_EQ(d.draws[0], before.draws[0]);
  EXPECT_EQ(d.draws[1], before.draws[1]);
  EXPECT_NE(d.draws[2], before.draws[2]);
  const Locks all = {{{}, LockScope::subtree}};
  const Derivation held = d;
  EXPECT_FALSE(nudge(*g, d, all, random));
  EXPECT_EQ(d, held);
}

}  // namespace
}  // namespace espalier
