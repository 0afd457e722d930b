#include "derivation/locks.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/lock_map.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

TEST(GenePath, ReadsAndWritesNames) {
  const GeneratorGraph graph = guarded_tree();
  const std::vector<std::uint16_t> path = parse_gene_path(graph, "Trunk/Branch[1]/Leader/Branch[0]");
  EXPECT_EQ(path, (std::vector<std::uint16_t>{1, 2, 0}));
  EXPECT_EQ(format_gene_path(graph, path), "Trunk/Branch[1]/Leader/Branch[0]");
  EXPECT_TRUE(parse_gene_path(graph, "Trunk").empty());
  EXPECT_EQ(format_gene_path(graph, {}), "Trunk");
}

TEST(GenePath, NamesTheStepThatDoesNotExist) {
  const GeneratorGraph graph = guarded_tree();
  const auto message = [&](const std::string& text) -> std::string {
    try {
      parse_gene_path(graph, text);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("Root/Leader"), "gene path \"Root/Leader\": starts with \"Root\", but the start rule is Trunk");
  EXPECT_EQ(message("Trunk/Branch[2]"), "gene path \"Trunk/Branch[2]\": rule Trunk has no slot \"Branch[2]\"");
  EXPECT_EQ(message("Trunk/Leader/"), "gene path \"Trunk/Leader/\": rule Leader has no slot \"\"");
  EXPECT_EQ(message(""), "gene path \"\": starts with \"\", but the start rule is Trunk");
}

TEST(GenePath, LeadsToItsGeneAndBack) {
  int genes = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    const std::optional<Derivation> d = random_derivation(graph, random);
    for (std::uint32_t g = 0; d && g < d->size(); ++g, ++genes) {
      const std::vector<std::uint16_t> path = gene_path(graph, *d, g);
      EXPECT_EQ(find_gene(graph, *d, path), g);
      EXPECT_EQ(parse_gene_path(graph, format_gene_path(graph, path)), path);
    }
  }
  EXPECT_GT(genes, 2000);
}

TEST(GenePath, LeadsNowhereWhereNothingStands) {
  const GeneratorGraph graph = guarded_tree();
  const Derivation d{{{0, 0, 1, 3, 2}, {2, 0, 0, 0, 0}},
                     {SlotState::empty, SlotState::empty, SlotState::filled, SlotState::empty, SlotState::empty,
                      SlotState::empty},
                     {1, 2, 3},
                     0};
  EXPECT_EQ(find_gene(graph, d, {2}), 1u);
  EXPECT_FALSE(find_gene(graph, d, {0}).has_value());
  EXPECT_FALSE(find_gene(graph, d, {2, 2}).has_value());
  EXPECT_FALSE(find_gene(graph, d, {9}).has_value());
}

TEST(LockMap, HoldsTheWayToALockedGeneAndWhatItsScopeSays) {
  const GeneratorGraph graph = guarded_tree();
  RandomStream random = stream(2);
  Derivation d = seedling(graph, random);
  close_open_slots(graph, d, random);
  while (d.size() < 30) ASSERT_TRUE(grow(graph, d, {}, random));
  std::uint32_t gene = 1;  // some gene below the first level, with genes below
  while (gene_path(graph, d, gene).size() < 2 || d.genes[gene].genes_below < 2) ++gene;
  const std::vector<std::uint16_t> path = gene_path(graph, d, gene);
  constexpr std::uint8_t kPinned = LockMap::kPinned, kDraws = LockMap::kDraws, kVariant = LockMap::kVariant;
  constexpr std::uint8_t kSlots = LockMap::kSlots;
  const std::pair<LockScope, std::pair<int, int>> scopes[] = {
      {LockScope::subtree, {kPinned | kDraws | kVariant | kSlots, kPinned | kDraws | kVariant | kSlots}},
      {LockScope::structure, {kPinned | kVariant | kSlots, kPinned | kVariant | kSlots}},
      {LockScope::draws, {kPinned | kDraws | kVariant, 0}}};
  for (const auto& [scope, held] : scopes) {
    LockMap map;
    map.reset(graph, d, {{path, scope}});
    EXPECT_FALSE(map.free());
    for (std::uint32_t g = 0; g < d.size(); ++g) {
      const bool below = g > gene && g <= gene + d.genes[gene].genes_below;
      const bool above = g < gene && gene <= g + d.genes[g].genes_below;
      const int expected = g == gene ? held.first : below ? held.second : above ? kPinned : 0;
      EXPECT_EQ(map.held(g), expected) << "gene " << g;
    }
  }
  LockMap map;
  map.reset(graph, d, {});
  EXPECT_TRUE(map.free());
  EXPECT_EQ(map.held(0), 0);
}

}  // namespace
}  // namespace espalier
