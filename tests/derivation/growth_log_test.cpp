#include "derivation/growth_log.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "growing.h"
#include "random_derivation.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// Where buds stand, told without numbers of the pool.
std::vector<std::pair<std::uint32_t, std::uint16_t>> open_places(const GrowthPool& pool, const GrowingDerivation& tree) {
  std::vector<ShootId> history;
  pool.history(tree, history);
  std::vector<std::pair<std::uint32_t, std::uint16_t>> places;
  for (const BudId bud : tree.open) places.push_back({owner_in(pool, history, bud), pool.bud(bud).slot});
  return places;
}

/// Both are the same, and stay so for some steps.
void expect_twins(const GeneratorGraph& graph, GrowthPool& pool, GrowingDerivation a, GrowthPool& other_pool,
                  GrowingDerivation b, std::uint64_t seed) {
  RandomStream random = stream(seed), same = random;
  for (int k = 0; k < 8; ++k) {
    const Derivation packed = pool.pack(a);
    ASSERT_EQ(packed, other_pool.pack(b)) << "seed " << seed << " step " << k;
    ASSERT_EQ(find_fault(graph, packed), "");
    ASSERT_EQ(open_places(pool, a), open_places(other_pool, b));
    EXPECT_EQ(a.genes, b.genes);
    const GrowthStep step = pool.grow(a, random, 300, [](ShootId) {});
    ASSERT_EQ(step, other_pool.grow(b, same, 300, [](ShootId) {}));
  }
}

void check_restored(const GeneratorGraph& graph, GrowthPool& pool, const GrowingDerivation& tree, std::uint64_t seed) {
  const GrowthLog log = log_of(pool, tree);
  GrowthPool fresh(graph);
  const GrowingDerivation restored = restore(graph, log, fresh);
  EXPECT_EQ(restored.detail_seed, tree.detail_seed);
  expect_twins(graph, pool, tree, fresh, restored, seed);
}

TEST(GrowthLog, WhatIsRestoredGrowsOnAsBefore) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    RandomStream random = stream(seed + 7000);
    const GeneratorGraph graph = random_graph(random);
    GrowthPool pool(graph);
    std::vector<GrowingDerivation> trees;
    for (int i = 0; i < 3; ++i) trees.push_back(pool.begin(random));
    for (int k = 0; k < 6; ++k) {
      for (GrowingDerivation& tree : trees) pool.grow(tree, random, 40, [](ShootId) {});
    }
    for (const GrowingDerivation& tree : trees) check_restored(graph, pool, tree, seed);
  }
}

TEST(GrowthLog, RestoresWhatWasCutBackAndWhatMoved) {
  int entries = 0;
  for (const char* name : {"guided-tree.esp", "plant.esp", "spaceship.esp", "snake.esp"}) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    GrowthPool pool(*graph);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      RandomStream random = stream(seed);
      GrowingDerivation tree = pool.begin(random), other = pool.begin(random);
      for (int round = 0; round < 3; ++round) {
        for (int k = 0; k < 15; ++k) {
          pool.grow(tree, random, 200, [](ShootId) {});
          pool.grow(other, random, 200, [](ShootId) {});
        }
        std::vector<ShootId> history;
        std::vector<std::uint32_t> parents, kept;
        pool.history(tree, history);
        pool.parents(history, parents);
        std::vector<std::uint8_t> cut(history.size());
        for (std::uint8_t& c : cut) c = random.chance(0.1);
        tree = pool.cut_back(tree, history, parents, cut, kept);
        check_restored(*graph, pool, tree, seed);
        pool.grow(tree, random, 200, [](ShootId) {});
        GrowthRenumbering renumbering;
        std::vector<GrowingDerivation*> living = {&tree};
        if (round != 1) living.push_back(&other);
        pool.keep_only(living, renumbering);
        if (round == 1) other = pool.begin(random);
        check_restored(*graph, pool, tree, seed + 50);
        entries += static_cast<int>(log_of(pool, tree).entries.size());
      }
    }
  }
  EXPECT_GT(entries, 1000);
}

TEST(GrowthLog, RestoresBesideOthers) {
  const auto graph = compile_shipped("guided-tree.esp");
  GrowthPool pool(*graph);
  RandomStream random = stream(3);
  GrowingDerivation tree = pool.begin(random), other = pool.begin(random);
  for (int k = 0; k < 30; ++k) {
    pool.grow(tree, random, 200, [](ShootId) {});
    pool.grow(other, random, 200, [](ShootId) {});
  }
  const Derivation of_other = pool.pack(other);
  const GrowingDerivation again = restore(*graph, log_of(pool, tree), pool);
  EXPECT_NE(again.last, tree.last);
  EXPECT_EQ(pool.pack(other), of_other);
  GrowthPool fresh(*graph);
  const GrowingDerivation alone = restore(*graph, log_of(pool, tree), fresh);
  expect_twins(*graph, pool, again, fresh, alone, 5);
}

// Limits are counted anew.
TEST(GrowthLog, RestoresWhatLimitsLeave) {
  GraphBuilder b("limited");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.maybe(root, leaf, 0.9, 8);
  b.limit(leaf, 4);
  const GeneratorGraph graph = b.build();
  GrowthPool pool(graph), fresh(graph);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random = stream(seed);
    GrowingDerivation tree = pool.begin(random);
    pool.grow(tree, random, 3, [](ShootId) {});
    GrowingDerivation again = restore(graph, log_of(pool, tree), fresh);
    fresh.grow(again, random, 100, [](ShootId) {});
    EXPECT_EQ(find_fault(graph, fresh.pack(again)), "");
    EXPECT_EQ(again.genes, 5u);
  }
}

/// Root: an optional twig, a required leaf, a twig that may not stand (absent). Twigs have a draw and an optional leaf.
GeneratorGraph small_graph() {
  GraphBuilder b("small");
  const RuleId root = b.rule("Root", 1), twig = b.rule("Twig", 2), leaf = b.rule("Leaf"), never = b.rule("Never");
  b.maybe(root, twig, 0.5);
  b.spawn(root, leaf);
  b.maybe(root, never, 0.5);
  b.maybe(root, leaf, 0.5);
  b.maybe(twig, leaf, 0.5);
  b.maybe(twig, leaf, 0);
  b.guard(never, depth_below(0));
  b.limit(leaf, 2);
  b.variant(leaf, 1, {}, {});
  b.variant(leaf, 0, {}, {});
  return b.build();
}

/// Root with a twig in slot 0, whose first leaf is empty; a leaf in slot 1; slot 3 and the twig's second slot are open.
GrowthLog small_log() {
  GrowthLog log;
  log.detail_seed = 77;
  log.entries = {{0, 0, true, 0, 0}, {0, 0, true, 1, 0}, {0, 1, true, 2, 0}, {1, 0, false, 0, 0}};
  log.draws = {5, 6, 7};
  log.open = {{0, 3}, {1, 1}};
  return log;
}

std::string fault_of(const GrowthLog& log) {
  const GeneratorGraph graph = small_graph();
  GrowthPool pool(graph);
  try {
    restore(graph, log, pool);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class Change>
std::string fault_after(const Change& change) {
  GrowthLog log = small_log();
  change(log);
  return fault_of(log);
}

TEST(GrowthLog, TheSmallLogIsWhole) {
  const GeneratorGraph graph = small_graph();
  GrowthPool pool(graph);
  const GrowingDerivation tree = restore(graph, small_log(), pool);
  const Derivation packed = pool.pack(tree);
  EXPECT_EQ(find_fault(graph, packed), "");
  EXPECT_EQ(packed.size(), 3u);
  EXPECT_EQ(packed.draws, (std::vector<std::uint32_t>{5, 6, 7}));
  EXPECT_EQ(packed.detail_seed, 77u);
  using enum SlotState;
  EXPECT_EQ(packed.slots, (std::vector<SlotState>{filled, filled, absent, open, empty, open}));
}

TEST(GrowthLog, RefusesDamage) {
  using Log = GrowthLog;
  EXPECT_THAT(fault_of(GrowthLog{}), HasSubstr("must begin with the start gene"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[0].edge = 1; }), HasSubstr("must begin with the start gene"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[0].filled = false; }), HasSubstr("must begin with the start gene"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[0].variant = 1; }), HasSubstr("a variant must be"));
  // Slots of nothing, of what comes later, of what is empty, and beyond the last.
  const char* no_gene = "a slot must be of a gene that came before";
  EXPECT_THAT(fault_after([](Log& l) { l.entries[3].above = 9; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[1].above = 1; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[1].above = 2; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[3].slot = 2; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.open[0].slot = 4; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.open[1].entry = 3; }), HasSubstr(no_gene));
  EXPECT_THAT(fault_after([](Log& l) { l.open[1].entry = 4; }), HasSubstr(no_gene));
  // Twice.
  const char* twice = "a slot must be decided or open, and once";
  EXPECT_THAT(fault_after([](Log& l) { l.entries.push_back(l.entries[3]); }), HasSubstr(twice));
  EXPECT_THAT(fault_after([](Log& l) { l.open[0].slot = 0; }), HasSubstr(twice));
  EXPECT_THAT(fault_after([](Log& l) { l.open.push_back(l.open[0]); }), HasSubstr(twice));
  // Absent and required slots.
  const char* absent = "a slot that is absent must not be named";
  EXPECT_THAT(fault_after([](Log& l) { l.open[0].slot = 2; }), HasSubstr(absent));
  EXPECT_THAT(fault_after([](Log& l) { l.entries.push_back({0, 2, true, 3, 0}); }), HasSubstr(absent));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[2].filled = false; }), HasSubstr("a required slot must not be empty"));
  // Genes that cannot be what they say.
  EXPECT_THAT(fault_after([](Log& l) { l.entries[2].edge = 4; }), HasSubstr("a gene must be of its slot's rule"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[1].edge = 99; }), HasSubstr("a gene must be of its slot's rule"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[2].variant = 2; }), HasSubstr("a variant must be"));
  EXPECT_THAT(fault_after([](Log& l) { l.entries[2].variant = 1; }), HasSubstr("probability 0"));
  EXPECT_THAT(fault_after([](Log& l) { l.open.pop_back(), l.entries.push_back({1, 1, true, 6, 0}); }),
              HasSubstr("probability 0"));
  // One leaf too many.
  EXPECT_THAT(fault_after([](Log& l) {
    l.open.clear();
    l.entries[3] = {1, 0, true, 5, 0};
    l.entries.push_back({0, 3, true, 4, 0});
  }), HasSubstr("a rule must keep its limit"));
  // Draws.
  EXPECT_THAT(fault_after([](Log& l) { l.draws.pop_back(); }), HasSubstr("every draw must be there"));
  EXPECT_THAT(fault_after([](Log& l) { l.draws.push_back(1); }), HasSubstr("there must be no more draws"));
  // Optional slots that are neither decided nor open: growth asks for all.
  EXPECT_THAT(fault_after([](Log& l) { l.open.clear(); }), HasSubstr("an optional slot must be decided or open"));
}

/// Some number of the log is another one.
void damage(GrowthLog& log, RandomStream& random) {
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  const auto other = [&](auto& number) { number = static_cast<std::decay_t<decltype(number)>>(random.below(12)); };
  GrowthLog::Entry& entry = log.entries[random.below(size(log.entries))];
  switch (random.below(10)) {
    case 0: return other(entry.above);
    case 1: return other(entry.slot);
    case 2: entry.filled = !entry.filled; return;
    case 3: return other(entry.edge);
    case 4: return other(entry.variant);
    case 5: log.entries.pop_back(); return;
    case 6: std::swap(entry, log.entries[random.below(size(log.entries))]); return;
    case 7: log.draws.resize(random.below(size(log.draws) + 3)); return;
    case 8:
      if (!log.open.empty()) other(log.open[random.below(size(log.open))].entry);
      return;
    default:
      if (!log.open.empty()) other(log.open[random.below(size(log.open))].slot);
  }
}

// Whatever is damaged, what is restored is something that can have grown.
TEST(GrowthLog, NoDamageMakesAnInvalidDerivation) {
  int refused = 0, taken = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomStream random = stream(seed + 20000);
    const GeneratorGraph graph = random_graph(random);
    GrowthPool pool(graph);
    GrowingDerivation tree = pool.begin(random);
    for (int k = 0; k < 4; ++k) pool.grow(tree, random, 25, [](ShootId) {});
    GrowthLog log = log_of(pool, tree);
    for (std::uint32_t k = 1 + random.below(2); k > 0 && !log.entries.empty(); --k) damage(log, random);
    GrowthPool fresh(graph);
    try {
      GrowingDerivation restored = restore(graph, log, fresh);
      ++taken;
      ASSERT_EQ(find_fault(graph, fresh.pack(restored)), "") << "seed " << seed;
      for (int k = 0; k < 5; ++k) fresh.grow(restored, random, 60, [](ShootId) {});
      ASSERT_EQ(find_fault(graph, fresh.pack(restored)), "") << "seed " << seed;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 800);
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace espalier
