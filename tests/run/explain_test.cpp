#include "run/explain.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using testing::TemporaryFolder;
using testing::write_text;

class Explain : public ::testing::Test {
 protected:
  GrammarReport explained(const std::string& text, std::uint32_t samples, std::uint64_t seed = 1, int threads = 1,
                          const std::map<std::string, std::string>& attributes = {}) {
    write_text(folder_ / "g.esp", text);
    AssimpMeshSource source;
    const auto executor = make_thread_executor(threads);
    return explain_grammar({folder_ / "g.esp", attributes, samples, seed}, source, *executor);
  }
  TemporaryFolder folder_;
};

// By hand: a coin decides whether the box has a lid, another whether the lid has a knob.
constexpr const char* kCoins = R"(grammar coins 1
attr wide in 1..3 by 0.5 = 2 "Size/Wide"
material wood = surface("#806040")
start Chest
rule Chest { size (wide, 1, 1)  emit box  maybe 0.5 spawn Lid else detail Dust }
rule Lid limit 3 when depth < 2 { move y 0.75  size (1, 0.5, 1)  paint wood  emit box  maybe 0.25 spawn Knob }
rule Knob { lean ~ uniform(0deg, 1deg)  move y 1  turn x lean  emit wedge }
detail Dust { emit quad }
)";

TEST_F(Explain, AgreesWithWhatIsCountedByHand) {
  const std::uint32_t n = 20'000;
  const GrammarReport r = explained(kCoins, n);
  ASSERT_EQ(r.rules.size(), 3u);
  EXPECT_DOUBLE_EQ(*r.rules[0].expected, 1);
  EXPECT_DOUBLE_EQ(*r.rules[1].expected, 0.5);
  EXPECT_DOUBLE_EQ(*r.rules[2].expected, 0.125);
  EXPECT_DOUBLE_EQ(*r.expected, 1.625);
  // Four standard deviations of the mean of n coins.
  EXPECT_NEAR(r.rules[1].mean, 0.5, 4 * std::sqrt(0.25 / n));
  EXPECT_NEAR(r.rules[2].mean, 0.125, 4 * std::sqrt(0.125 * 0.875 / n));
  EXPECT_NEAR(r.samples.genes.mean, r.rules[0].mean + r.rules[1].mean + r.rules[2].mean, 1e-9);
  EXPECT_EQ(r.samples.genes.least, 1);
  EXPECT_EQ(r.samples.genes.low, 1);
  EXPECT_EQ(r.samples.genes.high, 3) << "an eighth has a knob";
  EXPECT_EQ(r.samples.levels.most, 3);
  EXPECT_EQ(r.samples.parts.mean, r.samples.genes.mean) << "each gene emits one part";
  EXPECT_NEAR(r.samples.details.mean, 1 - r.rules[1].mean, 1e-9) << "dust where no lid is";
  // Boxes have 12 triangles, a wedge 8, a quad 2.
  const double triangles = 12 * (1 + r.rules[1].mean) + 8 * r.rules[2].mean + 2 * r.samples.details.mean;
  EXPECT_NEAR(r.samples.triangles.mean, triangles, 1e-9);
  EXPECT_NEAR(r.samples.log_prior.least, std::log(0.5 * 0.25), 1e-9);
  EXPECT_NEAR(r.samples.log_prior.most, std::log(0.5), 1e-9);
  EXPECT_EQ(r.samples.size[0].median, 2);
  EXPECT_EQ(r.samples.open + r.samples.thinned + r.samples.dropped + r.samples.bare, 0u);
  ASSERT_EQ(r.derivations.size(), 3u);  // 1, 2, 4 levels
  EXPECT_EQ(r.derivations[0].count, 1);
  EXPECT_EQ(r.derivations[1].count, 2);
  EXPECT_EQ(r.derivations[2].count, 3);
}

TEST_F(Explain, SaysWhatTheRulesHold) {
  const GrammarReport r = explained(kCoins, 1);
  EXPECT_EQ(r.rules[0].optional_slots, 1u);
  EXPECT_EQ(r.rules[0].required_slots, 0u);
  EXPECT_TRUE(r.rules[0].spawned_by.empty());
  EXPECT_EQ(r.rules[1].spawned_by, std::vector<std::string>{"Chest"});
  EXPECT_EQ(r.rules[1].limit, 3u);
  EXPECT_EQ(r.rules[1].guard, "depth < 2");
  EXPECT_EQ(r.rules[2].draws, 1u);
  ASSERT_EQ(r.meshes.size(), 3u);
  EXPECT_EQ(r.meshes[0].name, "box");
  EXPECT_EQ(r.meshes[0].triangles, 12u);
}

TEST_F(Explain, SaysWhatAttributesAreAndWhatTheyAreSetTo) {
  GrammarReport r = explained(kCoins, 1);
  ASSERT_EQ(r.attributes.size(), 1u);
  EXPECT_EQ(r.attributes[0].written, "2");
  EXPECT_EQ(r.attributes[0].range, "1..3 by 0.5");
  EXPECT_EQ(r.attributes[0].label, "Size/Wide");
  r = explained(kCoins, 5, 1, 1, {{"wide", "3"}});
  EXPECT_EQ(r.attributes[0].written, "3");
  EXPECT_EQ(r.samples.size[0].mean, 3);
}

// By hand: E = 1 / (1 - 2 * 0.3) stems, one leaf a stem with 1/2.
TEST_F(Explain, AgreesWithTheSeriesOfARecursion) {
  const GrammarReport r = explained(R"(grammar fork 1
start Stem0
rule Stem0 { spawn Stem }
rule Stem { emit box  move y 1  for side in [-1, 1] { move x side  maybe 0.3 spawn Stem }
  choose { 1: { spawn Leaf } 1: { emit cone } } }
rule Leaf { emit leaf })", 4000);
  EXPECT_NEAR(*r.rules[1].expected, 2.5, 1e-9);
  EXPECT_NEAR(*r.rules[2].expected, 1.25, 1e-9);
  EXPECT_NEAR(*r.expected, 4.75, 1e-9);
  // Var(total progeny) = s^2 / (1 - m)^3 with m = 0.6 and s^2 = 2 * 0.3 * 0.7.
  const double deviation = std::sqrt(0.42 / (0.4 * 0.4 * 0.4) / 4000);
  EXPECT_NEAR(r.rules[1].mean, 2.5, 4 * deviation);
  EXPECT_EQ(r.rules[1].variants, 2u);
  EXPECT_EQ(r.rules[1].required_slots, 1u);
  EXPECT_EQ(r.rules[1].optional_slots, 2u);
}

TEST_F(Explain, CountsSamplesThatDoNotEndOrShowNothing) {
  GrammarReport r = explained(R"(grammar vast 1
start S
rule S when depth < 30 { for i in 0..2 { move x i  maybe 0.9 spawn T } }
rule T when depth < 30 { for i in 0..2 { move x i  maybe 0.9 spawn T } })", 3);
  EXPECT_FALSE(r.expected);
  EXPECT_GE(r.samples.open, 1u);
  EXPECT_EQ(r.samples.bare, 3u);
  EXPECT_TRUE(r.samples.box.empty());
  EXPECT_FALSE(r.grammar.warnings.empty()) << "more than 10^6 genes";
  r = explained("grammar g 1 start S rule S { k ~ uniform(-1, 1)  size k  emit box }", 200);
  EXPECT_GT(r.samples.dropped, 50u);
  EXPECT_EQ(r.samples.dropped, r.samples.bare);
}

TEST_F(Explain, EnoughPartsAreEnough) {
  const GrammarReport r = explained(
      "grammar crowd 1 start S rule S { detail D } detail D { for i in 0..60000 { emit box  move x 1  emit box } }",
      200);
  EXPECT_EQ(r.samples.count, 50u) << "of 120 002 parts each: over 5 000 000 together";
  EXPECT_EQ(r.samples.details.mean, 120'002);
  EXPECT_EQ(explained(kCoins, 300).samples.count, 300u);
}

TEST_F(Explain, ThreadsMakeNoDifferenceAndSeedsDo) {
  const GrammarReport one = explained(kCoins, 300, 1, 1), four = explained(kCoins, 300, 1, 4);
  EXPECT_EQ(one.samples.triangles.mean, four.samples.triangles.mean);
  EXPECT_EQ(one.samples.log_prior.mean, four.samples.log_prior.mean);
  EXPECT_NE(one.samples.log_prior.mean, explained(kCoins, 300, 2).samples.log_prior.mean);
}

TEST_F(Explain, FilesThatAreNoGrammarsAreRefused) {
  EXPECT_THROW(explained("{}", 1), Error);
  AssimpMeshSource source;
  EXPECT_THROW(explain_grammar({folder_ / "none.esp", {}, 1, 1}, source, *make_serial_executor()), Error);
}

TEST(Spread, IsMadeOfSamples) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Spread s = spread_of(values);
  EXPECT_EQ(s.mean, 50.5);
  EXPECT_EQ(s.least, 1);
  EXPECT_EQ(s.low, 5);
  EXPECT_EQ(s.median, 50);
  EXPECT_EQ(s.high, 95);
  EXPECT_EQ(s.most, 100);
  EXPECT_EQ(spread_of({7}).low, 7);
  EXPECT_EQ(spread_of({7}).high, 7);
}

}  // namespace
}  // namespace espalier
