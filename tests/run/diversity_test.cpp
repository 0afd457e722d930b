#include "run/diversity.h"

#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

#include "derivation/moves.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

std::shared_ptr<const GeneratorGraph> pile_graph() {
  return compile_grammar({"pile.esp", testing::kPileGrammar, {}}).graph;
}

Derivation grown(const GeneratorGraph& graph, std::uint32_t individual, std::size_t genes) {
  RandomStream random({5, Purpose::test, 0, individual, 0});
  Derivation d = seedling(graph, random);
  close_open_slots(graph, d, random);
  while (d.size() < genes && grow(graph, d, {}, random)) {}
  return d;
}

constexpr Bounds kBox = {Vec3(-2, 0, -1), Vec3(2, 8, 1)};

Instance box_at(const Vec3& centre, const Vec3& size) {
  Instance instance;
  for (int i = 0; i < 3; ++i) instance.model_from_mesh.basis[i] *= size[i];
  instance.model_from_mesh.origin = centre;
  return instance;
}

ModelSketch sketch_of(const std::vector<Instance>& instances) {
  const auto graph = pile_graph();
  const ModelSketcher sketcher(*graph, {Vec3(0), Vec3(32, 32, 32)}, true);  // cells of 1
  Model model;
  model.instances = instances;
  ModelSketch sketch;
  sketcher.draw(model, sketch);
  return sketch;
}

std::size_t cells_of(const ModelSketch& sketch) {
  std::size_t count = 0;
  for (const std::uint64_t word : sketch.bits) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

TEST(ModelSketch, TouchesTheCellsOfAPart) {
  EXPECT_EQ(cells_of(sketch_of({})), 0u);
  EXPECT_EQ(cells_of(sketch_of({box_at(Vec3(4, 4, 4), Vec3(3.98f, 1.98f, 1.98f))})), 16u);
  // However thin, a part is seen.
  EXPECT_EQ(cells_of(sketch_of({box_at(Vec3(4.5f, 4.5f, 4.5f), Vec3(2.9f, 1e-4f, 1e-4f))})), 3u);
  EXPECT_EQ(cells_of(sketch_of({box_at(Vec3(-40, 4, 4), Vec3(2))})), 0u);
}

TEST(ModelSketch, DistanceIsOneMinusTheSharedPart) {
  const Instance a = box_at(Vec3(4, 4, 4), Vec3(3.98f)), b = box_at(Vec3(6, 4, 4), Vec3(3.98f)),
                 c = box_at(Vec3(20, 4, 4), Vec3(3.98f));
  EXPECT_EQ(distance(sketch_of({}), sketch_of({})), 0);
  EXPECT_EQ(distance(sketch_of({a}), sketch_of({a, a})), 0);
  EXPECT_NEAR(distance(sketch_of({a}), sketch_of({b})), 1 - 32 / 96., 1e-12);
  EXPECT_EQ(distance(sketch_of({a}), sketch_of({c})), 1);
}

TEST(ModelSketch, HugePartsCostBoundedTime) {
  EXPECT_EQ(cells_of(sketch_of({box_at(Vec3(16), Vec3(1e9f))})), 32u * 32 * 32);
}

TEST(DiverseArchive, MembersAreSortedFarApartAndHoldTheBest) {
  const auto graph = pile_graph();
  DiverseArchive archive(ModelSketcher(*graph, kBox, true), 5, 0.4);
  RandomStream random({8, Purpose::test});
  double best = -1;
  for (std::uint32_t round = 0; round < 30; ++round) {
    std::vector<Individual> population;
    for (std::uint32_t i = 0; i < 10; ++i) {
      population.push_back({grown(*graph, round * 10 + i, 4 + i), random.next_unit()});
    }
    std::sort(population.begin(), population.end(), [](auto& a, auto& b) { return a.score > b.score; });
    best = std::max(best, population[0].score);
    archive.offer(population);
    const auto& members = archive.members();
    ASSERT_FALSE(members.empty());
    EXPECT_LE(members.size(), 5u);
    EXPECT_EQ(members[0].score, best);
    ModelSketcher check(*graph, kBox, true);
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        ModelSketch a, b;
        check.draw(members[i].derivation, a), check.draw(members[j].derivation, b);
        EXPECT_GE(distance(a, b), 0.4);
        EXPECT_LE(members[i].score, members[j].score);
      }
    }
  }
  EXPECT_EQ(archive.members().size(), 5u);
  EXPECT_EQ(archive.apart_from(archive.members()[0].derivation).size(), 4u);
}

TEST(DiverseArchive, ABetterNeighbourReplacesAWorseOneAndTurnsItAway) {
  const auto graph = pile_graph();
  DiverseArchive archive(ModelSketcher(*graph, kBox, true), 5, 0.999);  // only strangers are far enough
  const Derivation a = grown(*graph, 1, 12), b = grown(*graph, 2, 12);
  archive.offer(std::vector<Individual>{{a, 1}});
  archive.offer(std::vector<Individual>{{b, 2}});
  ASSERT_EQ(archive.members().size(), 1u);
  EXPECT_EQ(archive.members()[0].derivation, b);
  archive.offer(std::vector<Individual>{{a, 1.5}});
  ASSERT_EQ(archive.members().size(), 1u);
  EXPECT_TRUE(archive.apart_from(b).empty());
}

TEST(DiverseArchive, OfNoSizeKeepsNothing) {
  const auto graph = pile_graph();
  DiverseArchive archive(ModelSketcher(*graph, kBox, true), 0, 0.5);
  archive.offer(std::vector<Individual>{{grown(*graph, 1, 5), 1}});
  EXPECT_TRUE(archive.members().empty());
}

}  // namespace
}  // namespace espalier
