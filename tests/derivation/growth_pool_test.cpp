#include "derivation/growth_pool.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "base/error.h"
#include "chi_square.h"
#include "derivation/encode.h"
#include "enumerate.h"
#include "growing.h"
#include "random_derivation.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using namespace test;

constexpr std::uint32_t kNoEnd = 1'000'000;

/// How often each outcome of so many steps of growth came up.
template <class Grow>
std::map<std::string, int> outcomes(const GeneratorGraph& graph, int tries, const Grow& grow) {
  std::map<std::string, int> counts;
  for (int i = 0; i < tries; ++i) ++counts[key_of(graph, grow(i))];
  return counts;
}

/// Pearson's test that two samples of equal size come from one distribution; outcomes that are rare are pooled.
void expect_same_distribution(const std::map<std::string, int>& a, const std::map<std::string, int>& b) {
  std::map<std::string, std::pair<double, double>> both;
  for (const auto& [key, count] : a) both[key].first += count;
  for (const auto& [key, count] : b) both[key].second += count;
  double chi2 = 0, rare_a = 0, rare_b = 0;
  int cells = 0;
  const auto add = [&](double x, double y) {
    if (x + y == 0) return;
    chi2 += (x - y) * (x - y) / (x + y);
    ++cells;
  };
  for (const auto& [key, counts] : both) {
    if (counts.first + counts.second < 10) {
      rare_a += counts.first, rare_b += counts.second;
    } else {
      add(counts.first, counts.second);
    }
  }
  add(rare_a, rare_b);
  ASSERT_GE(cells, 2);
  EXPECT_LT(chi2, chi_square_bound(cells - 1)) << "with " << cells - 1 << " degrees of freedom";
}

/// Whether some rules make something is a matter of chance.
GeneratorGraph random_making_graph(RandomStream& random) {
  GeneratorGraph graph = random_graph(random);
  for (Rule& rule : graph.rules) {
    if (random.chance(0.5)) continue;
    Op emit;
    emit.code = OpCode::emit;
    for (Variant& variant : rule.variants) variant.program.ops.push_back(emit);
  }
  return graph;
}

GeneratorGraph tiny_graph() {
  GraphBuilder b("tiny");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig"), leaf = b.rule("Leaf");
  b.guard(twig, depth_below(3));
  b.maybe(root, twig, 0.6, 2);
  b.maybe(twig, twig, 0.3);
  b.spawn(twig, leaf);
  b.variant(leaf, 0.5, {}, {});
  b.variant(leaf, 0.5, {}, {});
  return b.build();
}

/// Optional and required slots compete for what limits leave; some genes make something.
GeneratorGraph limited_graph() {
  GraphBuilder b("limited");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig"), leaf = b.rule("Leaf"), stalk = b.rule("Stalk");
  b.maybe(root, twig, 0.7, 2);
  b.spawn(root, stalk);
  b.maybe(twig, leaf, 0.5, 2);
  b.spawn(twig, leaf);
  b.spawn(stalk, leaf);
  b.limit(leaf, 3);
  GeneratorGraph graph = b.build();
  Op bone;
  bone.code = OpCode::bone;
  graph.rules[leaf].variants[0].program.ops.push_back(bone);
  return graph;
}

/// At depth 2 no alternative of a leaf weighs anything.
GeneratorGraph weightless_graph() {
  GraphBuilder b("weightless");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig"), leaf = b.rule("Leaf");
  b.maybe(root, leaf, 0.5);
  b.spawn(root, twig, 2);
  b.maybe(twig, leaf, 0.5);
  b.spawn(twig, leaf);
  b.maybe(twig, twig, 0.3);
  b.guard(twig, depth_below(3));
  b.variant(leaf, by_depth(2, 0.5, 0), {}, {});
  b.variant(leaf, by_depth(2, 0.5, 0), {}, {});
  return b.build();
}

TEST(GrowthPool, GrowsToThePrior) {
  const GeneratorGraph graph = tiny_graph();
  std::map<std::string, double> prior;
  const Enumeration enumeration(graph);
  for (const Enumerated& one : enumeration.all()) prior[one.key] += one.probability;
  RandomStream random = stream(1);
  GrowthPool pool(graph);
  const auto counts = outcomes(graph, 20000, [&](int) {
    pool.clear();
    GrowingDerivation growing = pool.begin(random);
    while (pool.grow(growing, random, kNoEnd, [](ShootId) {}) == GrowthStep::grown) {}
    EXPECT_TRUE(growing.open.empty());
    return pool.pack(growing);
  });
  expect_distribution(prior, counts);
}

// As grow_open_slot in random order, lenient, after every number of steps: from the seed to the end.
TEST(GrowthPool, EveryStepIsDistributedAsOneOfGrowOpenSlot) {
  for (const GeneratorGraph& graph : {tiny_graph(), limited_graph(), weightless_graph()}) {
    SCOPED_TRACE(graph.name);
    GrowthPool pool(graph);
    for (const int steps : {0, 1, 2, 4, 100}) {
      SCOPED_TRACE(steps);
      RandomStream random = stream(static_cast<std::uint64_t>(steps) + 2);
      constexpr int kTries = 8000;
      const auto pooled = outcomes(graph, kTries, [&](int) {
        pool.clear();
        GrowingDerivation growing = pool.begin(random);
        for (int k = 0; k < steps; ++k) {
          const ShootId before = growing.last;
          const bool grown = pool.grow(growing, random, kNoEnd, [](ShootId) {}) == GrowthStep::grown;
          EXPECT_EQ(grown, growing.last != before);
          if (!grown) break;
        }
        return pool.pack(growing);
      });
      const auto plain = outcomes(graph, kTries, [&](int) {
        Derivation d = seedling(graph, random);
        for (int k = 0; k < steps && grow_open_slot(graph, d, random) == GrowthStep::grown; ++k) {}
        return d;
      });
      if (steps == 0) {
        EXPECT_EQ(pooled.size(), 1u);
        EXPECT_EQ(pooled, plain);
      } else {
        expect_same_distribution(pooled, plain);
      }
    }
  }
}

// The test above can fail: depth-first growth, and strict growth that tries again, differ from it.
TEST(GrowthPool, OtherGrowthIsDistributedOtherwise) {
  const GeneratorGraph graph = limited_graph();
  const auto grown_so = [&](SlotOrder order, bool strict, std::uint64_t seed) {
    RandomStream random = stream(seed);
    return outcomes(graph, 8000, [&](int) {
      Derivation d;
      GrowthStep step = GrowthStep::stuck;
      while (step == GrowthStep::stuck) {
        d = seedling(graph, random);
        step = GrowthStep::grown;
        while (step == GrowthStep::grown) step = grow_open_slot(graph, d, random, order, strict);
      }
      return d;
    });
  };
  const auto chi2 = [](const std::map<std::string, int>& a, const std::map<std::string, int>& b) {
    double sum = 0;
    for (const auto& [key, count] : a) {
      const double other = b.contains(key) ? b.at(key) : 0;
      sum += (count - other) * (count - other) / (count + other);
    }
    return sum;
  };
  const auto right = grown_so(SlotOrder::random, false, 1);
  const double bound = chi_square_bound(static_cast<double>(right.size()));
  EXPECT_GT(chi2(right, grown_so(SlotOrder::depth_first, false, 2)), 2 * bound);
  EXPECT_GT(chi2(right, grown_so(SlotOrder::random, true, 3)), 2 * bound);
  EXPECT_LT(chi2(right, grown_so(SlotOrder::random, false, 4)), bound);
}

TEST(GrowthPool, FillsOptionalSlotsNoFurtherThanLimitsAndLeavesRequiredOnesOpen) {
  GraphBuilder b("full");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.spawn(root, leaf, 2);
  b.maybe(root, leaf, 0.999999, 2);
  b.limit(leaf, 1);
  const GeneratorGraph graph = b.build();
  GrowthPool pool(graph);
  RandomStream random = stream(4);
  int required_filled = 0;
  for (int i = 0; i < 100; ++i) {
    GrowingDerivation growing = pool.begin(random);
    while (pool.grow(growing, random, kNoEnd, [](ShootId) {}) == GrowthStep::grown) {}
    const Derivation d = pool.pack(growing);
    EXPECT_EQ(find_fault(graph, d), "");
    EXPECT_EQ(d.size(), 2u);
    const long open_required = std::count(d.slots.begin(), d.slots.begin() + 2, SlotState::open);
    required_filled += open_required == 1;
    EXPECT_EQ(open_required, d.slots[0] == SlotState::filled || d.slots[1] == SlotState::filled ? 1 : 2);
    EXPECT_EQ(std::count(d.slots.begin() + 2, d.slots.end(), SlotState::open), 0);
  }
  EXPECT_GT(required_filled, 20);
}

TEST(GrowthPool, WhatGrowsIsValidAtEveryStep) {
  int steps = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream random = stream(seed + 100);
    const GeneratorGraph graph = random_making_graph(random);
    GrowthPool pool(graph);
    GrowingDerivation growing = pool.begin(random);
    std::vector<ShootId> visited = {growing.last};
    for (int k = 0; k < 20; ++k) {
      const std::size_t before = visited.size();
      const Derivation packed_before = pool.pack(growing);
      const GrowthStep step = pool.grow(growing, random, 300, [&](ShootId shoot) { visited.push_back(shoot); });
      const Derivation packed = pool.pack(growing);
      ASSERT_EQ(find_fault(graph, packed), "") << "seed " << seed;
      EXPECT_EQ(packed.size(), growing.genes);
      EXPECT_EQ(packed.size(), packed_before.size() + visited.size() - before);
      EXPECT_EQ(step == GrowthStep::finished, packed == packed_before);
      // Only the last gene of a step makes something, and it does unless none is open or there are enough.
      for (std::size_t i = before; i + 1 < visited.size(); ++i) {
        EXPECT_FALSE(pool.makes_something(pool.shoot(visited[i])));
      }
      const bool made = visited.size() > before && pool.makes_something(pool.shoot(visited.back()));
      EXPECT_TRUE(made || growing.open.empty() || packed.size() >= before + 300 || growing.genes >= 300);
      if (step == GrowthStep::finished) break;
      ++steps;
    }
    // Every gene was shown, in order.
    std::vector<ShootId> history;
    pool.history(growing, history);
    std::erase_if(history, [&](ShootId id) { return !pool.shoot(id).filled; });
    EXPECT_EQ(history, visited);
  }
  EXPECT_GT(steps, 300);
}

TEST(GrowthPool, NothingGrowsBeyondTheMostGenes) {
  const auto graph = compile_shipped("guided-tree.esp");
  GrowthPool pool(*graph);
  for (std::uint32_t most = 1; most < 40; most += 7) {
    RandomStream random = stream(most);
    GrowingDerivation growing = pool.begin(random);
    for (int k = 0; k < 200; ++k) pool.grow(growing, random, most, [](ShootId) {});
    EXPECT_LE(growing.genes, most);
    EXPECT_EQ(pool.grow(growing, random, most, [](ShootId) {}), GrowthStep::finished);
  }
}

TEST(GrowthPool, ShippedGrammarsGrowValidDerivations) {
  for (const std::string& name : shipped_grammars()) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    GrowthPool pool(*graph);
    RandomStream random = stream(7);
    for (int i = 0; i < 5; ++i) {
      GrowingDerivation growing = pool.begin(random);
      for (int k = 0; k < 60; ++k) pool.grow(growing, random, 500, [](ShootId) {});
      const Derivation packed = pool.pack(growing);
      ASSERT_EQ(find_fault(*graph, packed), "");
      EXPECT_EQ(decode(*graph, encode(*graph, packed)), packed);
      EXPECT_EQ(packed, plain_pack(*graph, pool, growing));
    }
  }
}

TEST(GrowthPool, BeginsWithADerivationAndPacksTheSame) {
  int with_open = 0, with_empty = 0, genes = 0;
  const auto check = [&](const GeneratorGraph& graph, GrowthPool& pool, const Derivation& d) {
    const GrowingDerivation growing = pool.begin(d);
    ASSERT_EQ(pool.pack(growing), d);
    EXPECT_EQ(growing.genes, d.size());
    const auto open = std::count(d.slots.begin(), d.slots.end(), SlotState::open);
    EXPECT_EQ(growing.open.size(), static_cast<std::size_t>(open));
    EXPECT_EQ(plain_pack(graph, pool, growing), d);
    with_open += open > 0;
    with_empty += std::count(d.slots.begin(), d.slots.end(), SlotState::empty) > 0;
    genes += static_cast<int>(d.size());
  };
  for (const std::string& name : shipped_grammars()) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    GrowthPool pool(*graph);
    RandomStream random = stream(8);
    for (const std::uint32_t most : {1u, 5u, 60u, 1000u}) check(*graph, pool, sample(*graph, random, most).derivation);
  }
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream random = stream(seed + 600);
    const GeneratorGraph graph = random_graph(random);
    GrowthPool pool(graph);
    for (int i = 0; i < 3; ++i) {
      if (const auto d = random_derivation(graph, random, 20)) check(graph, pool, *d);
    }
  }
  EXPECT_GT(with_open, 60);
  EXPECT_GT(with_empty, 300);
  EXPECT_GT(genes, 5000);
}

// Limits count what was there before, and decided slots stay decided.
TEST(GrowthPool, GrowsOnFromADerivation) {
  int grown = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream random = stream(seed + 1000);
    const GeneratorGraph graph = random_making_graph(random);
    std::optional<Derivation> before = random_derivation(graph, random, 6);
    if (!before) continue;
    GrowthPool pool(graph);
    GrowingDerivation growing = pool.begin(*before);
    for (int k = 0; k < 10; ++k) grown += pool.grow(growing, random, 200, [](ShootId) {}) == GrowthStep::grown;
    const Derivation after = pool.pack(growing);
    ASSERT_EQ(find_fault(graph, after), "");
    for (std::uint32_t g = 0; g < before->size(); ++g) {
      const auto now = find_gene(graph, after, gene_path(graph, *before, g));
      ASSERT_TRUE(now);
      const GenePosition was = place_of(graph, *before, g), is = place_of(graph, after, *now);
      const Variant& variant = variant_of(graph, before->genes[g]);
      EXPECT_EQ(after.genes[*now].variant, before->genes[g].variant);
      EXPECT_TRUE(equal_run(before->draws, was.draw, after.draws, is.draw, variant.draws.size()));
      for (std::size_t k = 0; k < variant.slots.size(); ++k) {
        const SlotState old_state = before->slots[was.slot + k];
        EXPECT_TRUE(old_state == SlotState::open || old_state == after.slots[is.slot + k]);
      }
    }
  }
  EXPECT_GT(grown, 100);
}

TEST(GrowthPool, CopiesShareThePastAndGrowApart) {
  const auto graph = compile_shipped("guided-tree.esp");
  GrowthPool pool(*graph);
  RandomStream random = stream(9);
  GrowingDerivation trunk;
  while (trunk.open.size() < 3) {
    trunk = pool.begin(random);
    for (int k = 0; k < 6; ++k) pool.grow(trunk, random, 1000, [](ShootId) {});
  }
  const Derivation before = pool.pack(trunk);
  std::vector<GrowingDerivation> copies(5, trunk);
  std::vector<Derivation> packed(5);
  for (int k = 0; k < 20; ++k) {
    for (std::size_t i = 0; i < copies.size(); ++i) {
      pool.grow(copies[i], random, 1000, [](ShootId) {});
      packed[i] = pool.pack(copies[i]);
    }
  }
  EXPECT_EQ(pool.pack(trunk), before);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    EXPECT_EQ(pool.pack(copies[i]), packed[i]);
    EXPECT_EQ(packed[i].detail_seed, before.detail_seed);
    EXPECT_GT(packed[i].size(), before.size());
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(packed[k] == packed[i]);
  }
}

/// A derivation that has grown for a while, in a pool with others.
struct Grove {
  RandomStream random;
  GeneratorGraph graph;
  GrowthPool pool;
  std::vector<GrowingDerivation> trees;

  Grove(std::uint64_t seed, std::size_t count)
      : random(stream(seed)), graph(random_making_graph(random)), pool(graph) {
    for (std::size_t i = 0; i < count; ++i) trees.push_back(pool.begin(random));
    for (int k = 0; k < 12; ++k) grow(60);
  }

  void grow(std::uint32_t most) {
    for (GrowingDerivation& tree : trees) pool.grow(tree, random, most, [](ShootId) {});
  }
};

TEST(GrowthPool, KnowsWhereShootsStand) {
  int looked = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Grove grove(seed + 2000, 3);
    for (const GrowingDerivation& tree : grove.trees) {
      std::vector<ShootId> history;
      std::vector<std::uint32_t> parents;
      grove.pool.history(tree, history);
      grove.pool.parents(history, parents);
      ASSERT_EQ(parents.size(), history.size());
      EXPECT_EQ(parents[0], 0u);
      for (std::uint32_t i = 1; i < history.size(); ++i, ++looked) {
        EXPECT_LT(parents[i], i);
        EXPECT_EQ(parents[i], owner_in(grove.pool, history, grove.pool.shoot(history[i]).bud));
      }
    }
  }
  EXPECT_GT(looked, 1000);
}

TEST(GrowthPool, CutsBackJustWhatItIsTold) {
  int cuts = 0, removed = 0, regrown = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Grove grove(seed + 3000, 2);
    GrowthPool& pool = grove.pool;
    GrowingDerivation tree = grove.trees[seed % 2];
    for (int round = 0; round < 4; ++round) {
      const Derivation before = pool.pack(tree);
      std::vector<ShootId> history;
      std::vector<std::uint32_t> parents, kept;
      pool.history(tree, history);
      pool.parents(history, parents);
      std::vector<std::uint8_t> cut(history.size());
      for (std::uint8_t& c : cut) c = grove.random.chance(0.15);
      const std::size_t shoots_before = pool.shoots();
      const GrowingDerivation rest = pool.cut_back(tree, history, parents, cut, kept);
      // By the plain way: what is cut, and what stands on it.
      std::vector<ShootId> staying;
      std::vector<std::uint32_t> staying_places;
      std::vector<bool> gone(history.size());
      for (std::uint32_t i = 0; i < history.size(); ++i) {
        gone[i] = i > 0 && (cut[i] || gone[parents[i]]);
        if (gone[i]) continue;
        staying.push_back(history[i]);
        staying_places.push_back(i);
      }
      EXPECT_EQ(kept, staying_places);
      const Derivation packed = pool.pack(rest);
      ASSERT_EQ(packed, plain_pack(grove.graph, pool, staying, before.detail_seed));
      ASSERT_EQ(find_fault(grove.graph, packed), "");
      EXPECT_EQ(pool.pack(tree), before);
      EXPECT_EQ(rest.genes, packed.size());
      EXPECT_EQ(pool.shoots() - shoots_before, kept.size());
      // All that is undecided may grow again, each slot once.
      std::vector<BudId> open = rest.open;
      std::sort(open.begin(), open.end());
      EXPECT_EQ(std::unique(open.begin(), open.end()), open.end());
      EXPECT_EQ(open.size(),
                static_cast<std::size_t>(std::count(packed.slots.begin(), packed.slots.end(), SlotState::open)));
      cuts += kept.size() < history.size();
      removed += static_cast<int>(before.size() - packed.size());
      tree = rest;
      for (int k = 0; k < 6; ++k) {
        regrown += pool.grow(tree, grove.random, 60, [](ShootId) {}) == GrowthStep::grown;
        ASSERT_EQ(find_fault(grove.graph, pool.pack(tree)), "");
      }
    }
  }
  EXPECT_GT(cuts, 300);
  EXPECT_GT(removed, 500);
  EXPECT_GT(regrown, 500);
}

/// A copy of a tree without some of its shoots.
GrowingDerivation cut_at_random(GrowthPool& pool, const GrowingDerivation& tree, RandomStream& random) {
  std::vector<ShootId> history;
  std::vector<std::uint32_t> parents, kept;
  pool.history(tree, history);
  pool.parents(history, parents);
  std::vector<std::uint8_t> cut(history.size());
  for (std::uint8_t& c : cut) c = random.chance(0.15);
  return pool.cut_back(tree, history, parents, cut, kept);
}

TEST(GrowthPool, ForgetsWhatNobodyHolds) {
  int forgotten = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Grove kept(seed + 4000, 6), twin(seed + 4000, 6);
    // Some are copies that were cut back; whether what they are copies of lives on is a matter of chance.
    RandomStream choices = stream(seed);
    for (std::size_t i = 0; i < kept.trees.size(); ++i) {
      const std::uint32_t what = choices.below(4);
      if (what > 1) continue;
      RandomStream same = choices;
      const GrowingDerivation a = cut_at_random(kept.pool, kept.trees[i], choices);
      const GrowingDerivation b = cut_at_random(twin.pool, twin.trees[i], same);
      if (what == 0) {
        kept.trees[i] = a, twin.trees[i] = b;
      } else {
        kept.trees.push_back(a), twin.trees.push_back(b);
      }
    }
    kept.grow(60), twin.grow(60);
    std::vector<GrowingDerivation*> living;
    std::vector<Derivation> before;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < kept.trees.size(); ++i) {
      if (choices.chance(0.4)) continue;
      living.push_back(&kept.trees[i]);
      places.push_back(i);
      before.push_back(kept.pool.pack(kept.trees[i]));
      ASSERT_EQ(before.back(), twin.pool.pack(twin.trees[i]));
    }
    if (living.empty()) continue;
    const GrowthPool old = kept.pool;
    GrowthRenumbering renumbering;
    kept.pool.keep_only(living, renumbering);
    forgotten += static_cast<int>(old.shoots() - kept.pool.shoots());
    for (std::size_t k = 0; k < living.size(); ++k) {
      ASSERT_EQ(kept.pool.pack(*living[k]), before[k]) << "seed " << seed;
      EXPECT_EQ(plain_pack(kept.graph, kept.pool, *living[k]), before[k]);
      EXPECT_EQ(living[k]->open.size(), twin.trees[places[k]].open.size());
    }
    // Followers count on this: numbers keep their order, and all are taken.
    const auto is_compact = [](const std::vector<std::uint32_t>& numbers, std::size_t left) {
      std::uint32_t next = 0;
      for (const std::uint32_t number : numbers) {
        if (number != kNoShoot && number != next++) return false;
      }
      return next == left;
    };
    ASSERT_EQ(renumbering.shoots.size(), old.shoots());
    ASSERT_EQ(renumbering.buds.size(), old.buds());
    EXPECT_TRUE(is_compact(renumbering.shoots, kept.pool.shoots())) << "seed " << seed;
    EXPECT_TRUE(is_compact(renumbering.buds, kept.pool.buds())) << "seed " << seed;
    for (ShootId id = 0; id < old.shoots(); ++id) {
      if (renumbering.shoots[id] == kNoShoot) continue;
      const GrowthPool::Shoot &was = old.shoot(id), &is = kept.pool.shoot(renumbering.shoots[id]);
      EXPECT_EQ(was.filled, is.filled);
      EXPECT_EQ(is.bud, was.bud == kNoShoot ? kNoShoot : renumbering.buds[was.bud]);
      if (!was.filled) continue;
      EXPECT_EQ(was.edge, is.edge);
      EXPECT_EQ(was.variant, is.variant);
      EXPECT_EQ(old.counts_above(id).depth, kept.pool.counts_above(renumbering.shoots[id]).depth);
    }
    for (BudId bud = 0; bud < kept.pool.buds(); ++bud) {
      const GrowthPool::Shoot& owner = kept.pool.shoot(kept.pool.bud(bud).shoot);
      EXPECT_EQ(owner.first_bud + kept.pool.bud(bud).slot, bud);
    }
    // What is left grows on as if nothing had happened.
    for (int k = 0; k < 5; ++k) {
      for (std::size_t i = 0; i < living.size(); ++i) {
        RandomStream one = stream(seed * 100 + i), other = one;
        kept.pool.grow(*living[i], one, 80, [](ShootId) {});
        twin.pool.grow(twin.trees[places[i]], other, 80, [](ShootId) {});
        ASSERT_EQ(kept.pool.pack(*living[i]), twin.pool.pack(twin.trees[places[i]]));
      }
    }
  }
  EXPECT_GT(forgotten, 1000);
}

TEST(GrowthPool, BeginsAnywhere) {
  GraphBuilder b("deep");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig", 2), leaf = b.rule("Leaf");
  const EdgeId to_twig = b.spawn(root, twig), to_leaf = b.maybe(twig, leaf, 0.5);
  b.maybe(twig, twig, 0.5);
  b.guard(twig, depth_below(4));
  b.limit(leaf, 0);
  const GeneratorGraph graph = b.build();
  GrowthPool pool(graph);
  RandomStream random = stream(12);
  const GrowingDerivation high = pool.begin_at(to_twig, {2, {}}, random);
  ASSERT_NE(high.last, kNoShoot);
  EXPECT_EQ(high.genes, 1u);
  EXPECT_EQ(pool.shoot(high.last).edge, to_twig);
  EXPECT_EQ(pool.counts_above(high.last).depth, 2u);
  EXPECT_EQ(high.open.size(), 2u);
  EXPECT_EQ(pool.begin_at(to_twig, {3, {}}, random).open.size(), 1u);  // no twig may stand in it
  EXPECT_EQ(pool.begin_at(to_twig, {4, {}}, random).last, kNoShoot);
  EXPECT_EQ(pool.begin_at(to_leaf, {1, {}}, random).last, kNoShoot);
}

TEST(GrowthPool, RefusesAStartThatNothingMayStandAt) {
  GraphBuilder b("nothing");
  const RuleId root = b.rule("Root");
  b.variant(root, 0, {}, {});
  b.variant(root, 0, {}, {});
  const GeneratorGraph graph = b.build();
  GrowthPool pool(graph);
  RandomStream random = stream(13);
  EXPECT_THROW(pool.begin(random), Error);
}

TEST(GrowthPool, ClearsAndSwaps) {
  const auto graph = compile_shipped("guided-tree.esp");
  GrowthPool one(*graph), other(*graph);
  RandomStream random = stream(14);
  GrowingDerivation a = one.begin(random), b = other.begin(random);
  for (int k = 0; k < 20; ++k) one.grow(a, random, 100, [](ShootId) {}), other.grow(b, random, 100, [](ShootId) {});
  const Derivation of_a = one.pack(a), of_b = other.pack(b);
  one.swap(other);
  EXPECT_EQ(one.pack(b), of_b);
  EXPECT_EQ(other.pack(a), of_a);
  other.clear();
  EXPECT_EQ(other.shoots(), 0u);
  EXPECT_EQ(other.buds(), 0u);
  EXPECT_EQ(one.pack(b), of_b);
}

}  // namespace
}  // namespace espalier
