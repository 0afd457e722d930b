#include "model/gene_expander.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include <gtest/gtest.h>

#include "compiled.h"
#include "derivation/encode.h"
#include "model/expand.h"
#include "model/shipped.h"

namespace espalier {
namespace {

using namespace test;

/// Every bit of its ends.
using BoneBits = std::array<std::uint32_t, 6>;

BoneBits bits_of(const Bone& bone) {
  BoneBits bits;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bits[axis] = std::bit_cast<std::uint32_t>(bone.from[static_cast<int>(axis)]);
    bits[axis + 3] = std::bit_cast<std::uint32_t>(bone.to[static_cast<int>(axis)]);
  }
  return bits;
}

/// As multisets: sorted.
std::vector<BoneBits> sorted_bits(std::span<const Bone> bones) {
  std::vector<BoneBits> bits;
  for (const Bone& bone : bones) bits.push_back(bits_of(bone));
  std::sort(bits.begin(), bits.end());
  return bits;
}

/// The grammar, with a bone for every part: so that all are skeletons. What is shown of the childless makes no bones.
GeneratorGraph with_bones(const GeneratorGraph& graph) {
  GeneratorGraph boned = graph;
  if (graph.uses_childless) return boned;
  for (Rule& rule : boned.rules) {
    for (Variant& variant : rule.variants) {
      for (Op& op : variant.program.ops) {
        if (op.code != OpCode::emit) continue;
        op.code = OpCode::bone_along;
        op.axis = 1;
        op.flags = 0;
        op.x = {1, -0.5f, 1};  // by half the scope's size, and half a metre: sizes matter
        op.y = {0, 0.5f, kZeroRegister};
      }
    }
  }
  return boned;
}

/// Derivations that grow side by side, each gene expanded as soon as it is there.
class Growths {
 public:
  Growths(const GeneratorGraph& graph, RandomStream random)
      : graph_(graph), random_(random), pool_(graph), expander_(graph), model_of_(graph) {}

  GrowthPool& pool() { return pool_; }
  GeneExpander& expander() { return expander_; }
  std::vector<GrowingDerivation>& trees() { return trees_; }

  void begin() {
    trees_.push_back(pool_.begin(random_));
    run(trees_.back().last);
  }
  void begin(const Derivation& derivation) {
    trees_.push_back(pool_.begin(derivation));
    std::vector<ShootId> history;
    pool_.history(trees_.back(), history);
    for (const ShootId shoot : history) {
      if (pool_.shoot(shoot).filled) run(shoot);
    }
  }
  void grow(int steps, std::uint32_t most_genes) {
    for (int k = 0; k < steps; ++k) {
      for (GrowingDerivation& tree : trees_) pool_.grow(tree, random_, most_genes, [&](ShootId shoot) { run(shoot); });
    }
  }
  /// A copy of a tree goes on by itself.
  void copy(std::size_t tree) { trees_.push_back(trees_[tree]); }
  /// Without some of its shoots; genes that are there once more are not run again.
  void cut_back(std::size_t tree) {
    std::vector<ShootId> history;
    std::vector<std::uint32_t> parents, kept;
    pool_.history(trees_[tree], history);
    pool_.parents(history, parents);
    std::vector<std::uint8_t> cut(history.size());
    for (std::uint8_t& c : cut) c = random_.chance(0.1);
    const auto first = static_cast<ShootId>(pool_.shoots());
    trees_[tree] = pool_.cut_back(trees_[tree], history, parents, cut, kept);
    bones_.resize(pool_.shoots());
    for (std::uint32_t k = 0; k < kept.size(); ++k) bones_[first + k] = bones_[history[kept[k]]];
  }
  /// Forgets all but the trees.
  void renumber() {
    std::vector<GrowingDerivation*> living;
    for (GrowingDerivation& tree : trees_) living.push_back(&tree);
    GrowthRenumbering renumbering;
    pool_.keep_only(living, renumbering);
    expander_.renumber(renumbering);
    std::vector<std::vector<Bone>> bones(pool_.shoots());
    for (std::size_t id = 0; id < bones_.size(); ++id) {
      if (renumbering.shoots[id] != kNoShoot) bones[renumbering.shoots[id]] = bones_[id];
    }
    bones_ = std::move(bones);
  }

  /// Every tree has the bones of its packed derivation; how many all have.
  std::size_t check() {
    std::size_t all = 0;
    for (const GrowingDerivation& tree : trees_) {
      const Derivation packed = pool_.pack(tree);
      EXPECT_EQ(find_fault(graph_, packed), "");
      model_of_.expand(packed, ExpandTo::bones, model_);
      std::vector<Bone> bones;
      std::vector<ShootId> history;
      pool_.history(tree, history);
      bones_.resize(pool_.shoots());
      for (const ShootId shoot : history) bones.insert(bones.end(), bones_[shoot].begin(), bones_[shoot].end());
      EXPECT_EQ(bones.size(), model_.bones.size());
      EXPECT_EQ(sorted_bits(bones), sorted_bits(model_.bones));
      all += bones.size();
    }
    Frame frame;
    for (BudId bud = 0; bud < pool_.buds(); ++bud) {
      EXPECT_FALSE(pool_.bud(bud).absent && expander_.frame(bud, frame)) << "nothing may stand there";
    }
    return all;
  }

 private:
  void run(ShootId shoot) {
    if (bones_.size() <= shoot) bones_.resize(shoot + 1);
    const std::span<const Bone> bones = expander_.run(pool_, shoot);
    bones_[shoot].assign(bones.begin(), bones.end());
  }

  const GeneratorGraph& graph_;
  RandomStream random_;
  GrowthPool pool_;
  GeneExpander expander_;
  Expander model_of_;
  Model model_;
  std::vector<GrowingDerivation> trees_;
  std::vector<std::vector<Bone>> bones_;  // per shoot
};

/// Through all that may happen to a pool.
std::size_t check_growth(const GeneratorGraph& graph, std::uint32_t index) {
  Growths growths(graph, stream_of(index));
  for (int i = 0; i < 3; ++i) growths.begin();
  RandomStream random = stream_of(index + 1000);
  growths.begin(sample(graph, random, 40).derivation);
  growths.grow(15, 150);
  std::size_t bones = growths.check();
  growths.copy(0);
  growths.cut_back(1);
  growths.check();
  growths.grow(10, 150);
  bones += growths.check();
  growths.trees().erase(growths.trees().begin() + 2);
  growths.renumber();
  growths.check();
  growths.cut_back(2);
  growths.grow(10, 200);
  bones += growths.check();
  growths.renumber();
  growths.grow(3, 250);
  return bones + growths.check();
}

TEST(GeneExpander, MakesTheBonesOfEveryShippedGrammar) {
  std::size_t with_own_bones = 0;
  for (const std::string& name : shipped_grammars()) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    for (std::uint32_t index = 0; index < 3 && !testing::Test::HasFailure(); ++index) {
      with_own_bones += check_growth(*graph, index) > 0;
    }
  }
  EXPECT_GE(with_own_bones, 3 * 8u);
}

TEST(GeneExpander, MakesABoneForEveryPartOfShippedGrammars) {
  int grammars = 0;
  for (const std::string& name : shipped_grammars()) {
    SCOPED_TRACE(name);
    const GeneratorGraph graph = with_bones(*compile_shipped(name));
    std::size_t bones = 0;
    for (std::uint32_t index = 10; index < 14 && !testing::Test::HasFailure(); ++index) {
      bones += check_growth(graph, index);
    }
    grammars += bones > 20;
  }
  EXPECT_GE(grammars, 17);
}

// Mirrors within mirrors, copies around an axis, arguments, draws of the start rule, depths, sizes, tails of bodies.
TEST(GeneExpander, FollowsEveryConstruct) {
  const auto graph = compiled(R"(grammar constructs 1
start Root
attr wide = 2
rule Root {
  lean ~ uniform(-30deg, 30deg)
  girth ~ uniform(0.5, 2)
  let half = girth / 2
  mirror x { move x 1  bone (0, 0, 0) -> (0, girth, 0)  maybe 0.9 spawn Arm(half, 1) }
  around y 3 { move z 2  spawn Arm(girth, 2) }
  for k in 0..2 { move y k  maybe 0.7 spawn Twig }
}
rule Arm(long, kind) when depth(Arm) < 4 {
  bend ~ uniform(-60deg, 60deg)
  turn z bend + lean
  bone (0, 0, 0) -> (long, 0.1 * depth, 0.2 * depth(Arm))
  size (long, half, girth)
  mirror z { move z long  turn x 20deg  mirror y { move y half  maybe 0.5 spawn Arm(long * 0.7, kind + 1) } }
  choose {
    2: { maybe 0.6 spawn Twig }
    1: { scale 0.5  around x 2 { spawn Twig } }
  }
  move x long  maybe 0.6 spawn Arm(long, kind)
}
rule Twig when depth < 8 {
  a ~ uniform(-1, 1)
  { turn y a * 1rad  resize (1, 0.5, 1)  bone (0, 0, 0) -> (0, scope.y, a) }
  split x { ~1: { maybe 0.4 spawn Twig } ~2: { bone (0, 0, 0) -> (scope.x, 0, lean / 10deg) } }
  move y wide  maybe 0.5 spawn Twig
}
)");
  ASSERT_TRUE(graph);
  std::size_t bones = 0;
  for (std::uint32_t index = 100; index < 112; ++index) bones += check_growth(*graph, index);
  EXPECT_GT(bones, 2000u);
}

TEST(GeneExpander, LeavesOutWhatHasNoPlace) {
  const auto graph = compiled(R"(grammar broken 1
start Root
rule Root { for k in 0..5 { maybe 0.9 spawn Twig(k) } }
rule Twig(k) when depth < 5 {
  a ~ uniform(-1, 1)
  size (1, a, 1)
  bone (0, 0, 0) -> (0, 1, k)
  move y 1 / max(0, a - 0.2)  maybe 0.8 spawn Twig(k + a)
}
)");
  ASSERT_TRUE(graph);
  std::size_t bones = 0;
  for (std::uint32_t index = 200; index < 230; ++index) bones += check_growth(*graph, index);
  EXPECT_GT(bones, 500u);
  Growths growths(*graph, stream_of(5));
  growths.begin();
  growths.grow(30, 200);
  int shown = 0, hidden = 0;
  Frame frame;
  for (const BudId bud : growths.trees()[0].open) EXPECT_LT(bud, growths.pool().buds());
  for (BudId bud = 0; bud < growths.pool().buds(); ++bud) {
    (growths.expander().frame(bud, frame) ? shown : hidden) += !growths.pool().bud(bud).absent;
  }
  EXPECT_GT(shown, 0);
  EXPECT_GT(hidden, 0);
  EXPECT_FALSE(growths.expander().frame(static_cast<BudId>(growths.pool().buds()), frame));
  EXPECT_FALSE(growths.expander().frame(kNoShoot, frame));
}

/// Each gene's bone stands where it was to stand.
void check_frames(const GrowthPool& pool, const GeneExpander& expander, const GrowingDerivation& tree,
                  const std::vector<std::vector<Bone>>& bones) {
  std::vector<ShootId> history;
  pool.history(tree, history);
  for (const ShootId shoot : history) {
    if (!pool.shoot(shoot).filled || pool.shoot(shoot).bud == kNoShoot) continue;
    Frame frame;
    ASSERT_TRUE(expander.frame(pool.shoot(shoot).bud, frame));
    ASSERT_FALSE(bones[shoot].empty());
    const Bone& bone = bones[shoot][0];
    EXPECT_EQ(bone.from, frame.origin);
    const Vec3 tip = frame.point(Vec3(1, 2, 3));
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(bone.to[axis], tip[axis], 1e-4 + 1e-5 * std::abs(tip[axis]));
  }
}

TEST(GeneExpander, TellsTheFrameOfEverySlot) {
  const auto graph = compiled(R"(grammar frames 1
start Root
rule Root { mirror x { move x 1  maybe 0.9 spawn Twig }  move y 2  spawn Twig }
rule Twig when depth < 7 {
  a ~ uniform(-1, 1)
  b ~ uniform(0.5, 1.5)
  bone (0, 0, 0) -> (1, 2, 3)
  mirror z { turn x a * 1rad  scale (b, 1, 1 / b)  move (a, b, 0.3)  maybe 0.6 spawn Twig }
  turn y a * 1rad  move z b  maybe 0.6 spawn Twig
}
)");
  ASSERT_TRUE(graph);
  for (std::uint32_t index = 300; index < 310; ++index) {
    RandomStream random = stream_of(index);
    GrowthPool pool(*graph);
    GeneExpander expander(*graph);
    std::vector<std::vector<Bone>> bones(10000);
    GrowingDerivation tree = pool.begin(random);
    expander.run(pool, tree.last);
    for (int k = 0; k < 30; ++k) {
      pool.grow(tree, random, 100, [&](ShootId shoot) {
        const auto made = expander.run(pool, shoot);
        bones[shoot].assign(made.begin(), made.end());
      });
    }
    check_frames(pool, expander, tree, bones);
  }
}

TEST(GeneExpander, OfSeveralCopiesTheFirstHasTheFrame) {
  const auto graph = compiled(R"(grammar copies 1
start Root
rule Root { mirror x { move x 1  spawn Twig }  move y 5  around y 3 { move z 2  spawn Twig } }
rule Twig { bone (0, 0, 0) -> (0, 1, 0) }
)");
  ASSERT_TRUE(graph);
  GrowthPool pool(*graph);
  GeneExpander expander(*graph);
  RandomStream random = stream_of(310);
  GrowingDerivation tree = pool.begin(random);
  expander.run(pool, tree.last);
  const BudId mirrored = pool.shoot(tree.last).first_bud;
  Frame frame;
  ASSERT_TRUE(expander.frame(mirrored, frame));
  EXPECT_EQ(frame.origin, Vec3(1, 0, 0));
  ASSERT_TRUE(expander.frame(mirrored + 1, frame));
  EXPECT_EQ(frame.origin, Vec3(0, 5, 2));
  GrowthRenumbering renumbering;
  GrowingDerivation* const living[] = {&tree};
  pool.keep_only(living, renumbering);
  expander.renumber(renumbering);
  ASSERT_TRUE(expander.frame(mirrored, frame));
  EXPECT_EQ(frame.origin, Vec3(1, 0, 0));
}

TEST(GeneExpander, ForgetsWithThePool) {
  const auto graph = compile_shipped("guided-tree.esp");
  Growths growths(*graph, stream_of(400));
  for (int i = 0; i < 20; ++i) growths.begin();
  growths.grow(40, 300);
  const std::size_t before = growths.expander().bytes();
  growths.trees().resize(2);
  growths.renumber();
  EXPECT_LT(growths.expander().bytes(), before / 2);
  growths.grow(10, 300);
  growths.check();
  growths.expander().clear();
  Frame frame;
  EXPECT_FALSE(growths.expander().frame(0, frame));
  EXPECT_EQ(growths.expander().bytes(), 0u);
}

// The start rule's draws, arguments and the size go along; place and turn do not.
TEST(GeneExpander, RunsAGeneAtTheOriginAsItStandsElsewhere) {
  const auto graph = compiled(R"(grammar elsewhere 1
start Root
rule Root {
  long ~ uniform(1, 2)
  move (3, 4, 5)  turn z 40deg  size (0.5, 2, 7)  spawn Twig(0.25)
}
rule Twig(side) {
  bone (0, 0, 0) -> (side, long, scope.z)
  move y 1  size (1, 1, 1)  spawn Leaf(side + 1)
}
rule Leaf(side) { bone (0, 0, 0) -> (side, long * 10, scope.z) }
)");
  ASSERT_TRUE(graph);
  GrowthPool wild(*graph), pool(*graph);
  GeneExpander in_wild(*graph), at_origin(*graph);
  RandomStream random = stream_of(500);
  GrowingDerivation tree = wild.begin(random);
  in_wild.run(wild, tree.last);
  wild.grow(tree, random, 100, [&](ShootId shoot) { in_wild.run(wild, shoot); });
  const GrowthPool::Shoot& twig = wild.shoot(tree.last);
  const float length = 1 + static_cast<float>(wild.draws(wild.shoot(0))[0] >> 8) * 0x1p-24f;
  GrowingDerivation alone = pool.begin_at(twig.edge, wild.counts_above(tree.last), random);
  const std::span<const Bone> bones = at_origin.run_at_origin(pool, alone.last, in_wild, twig.bud);
  ASSERT_EQ(bones.size(), 1u);
  EXPECT_EQ(bones[0].from, Vec3(0));
  EXPECT_NEAR(bones[0].to.x, 0.25, 1e-6);
  EXPECT_NEAR(bones[0].to.y, length, 1e-6);
  EXPECT_NEAR(bones[0].to.z, 7, 1e-6);
  std::vector<Bone> leaf;
  pool.grow(alone, random, 100, [&](ShootId shoot) {
    const auto made = at_origin.run(pool, shoot);
    leaf.assign(made.begin(), made.end());
  });
  ASSERT_EQ(leaf.size(), 1u);
  EXPECT_EQ(leaf[0].from, Vec3(0, 1, 0));
  EXPECT_NEAR(leaf[0].to.x, 1.25, 1e-6);
  EXPECT_NEAR(leaf[0].to.y, 1 + 10 * length, 1e-5);
  EXPECT_NEAR(leaf[0].to.z, 1, 1e-6);
}

}  // namespace
}  // namespace espalier
