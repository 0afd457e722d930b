// The arboretum: what each of its genes does, and that no genome makes too much.

#include <functional>

#include "model/limbs.h"
#include "model/surfaces.h"
#include "model/tree_genes.h"
#include "no_files.h"

namespace espalier {
namespace {

using namespace test;

constexpr std::uint32_t kMost = 0xffffffffu;

class Arboretum : public testing::Test {
 protected:
  Model tree(const Quantiles& quantiles, std::uint64_t seed = 1) const { return tree_of(*graph_, quantiles, 0.5, seed); }
  std::size_t count(const Model& model, MeshKind kind) const {
    const auto is = [&](const Instance& i) { return graph_->meshes[i.mesh].kind == kind; };
    return static_cast<std::size_t>(std::count_if(model.instances.begin(), model.instances.end(), is));
  }
  Bounds box(const Model& model) const { return bounds(model, meshes_of(*graph_), true); }

  std::shared_ptr<const GeneratorGraph> graph_ = compile_shipped("arboretum.esp");
  const Quantiles oak_ = {{"habit", 0.3}}, pine_ = {{"habit", 0.74}}, palm_ = {{"habit", 0.95}};
};

TEST_F(Arboretum, IsDrawsOfItsStartAlone) {
  ASSERT_EQ(graph_->rules.size(), 1u);
  const Rule& rule = graph_->rules[0];
  EXPECT_TRUE(rule.slots.empty());
  EXPECT_EQ(rule.variants.size(), 1u);
  const auto classic = compile_shipped("gentree.esp");
  ASSERT_GE(rule.draws.size(), 30u);
  for (std::size_t i = 0; i < 13; ++i) EXPECT_EQ(rule.draws[i].name, classic->rules[0].draws[i].name);
}

TEST_F(Arboretum, TheSeedGeneAloneDecidesItsChances) {
  const auto same = [](const Model& a, const Model& b) {
    if (a.instances.size() != b.instances.size()) return false;
    for (std::size_t i = 0; i < a.instances.size(); ++i)
      if (a.instances[i].model_from_mesh.origin != b.instances[i].model_from_mesh.origin) return false;
    return true;
  };
  for (const Quantiles& kind : {oak_, pine_, palm_}) {
    const Model one = tree(kind, 1);
    EXPECT_TRUE(same(one, tree(kind, 99)));
    Quantiles other = kind;
    other["random_seed"] = 0.25;
    EXPECT_FALSE(same(one, tree(other, 1)));
  }
}

TEST_F(Arboretum, GrowsThreeHabits) {
  // How many pieces of wood are at least a sixth as thick as the stem: a palm has its stem and no bough.
  const auto thick = [&](const Model& model) {
    const auto width = [&](const Instance& part) {
      return graph_->meshes[part.mesh].kind == MeshKind::cone ? size_of(part).x : 0.0f;
    };
    float widest = 0;
    std::size_t n = 0;
    for (const Instance& part : model.instances) widest = std::max(widest, width(part));
    for (const Instance& part : model.instances) n += width(part) > widest / 6;
    return n;
  };
  const Model oak = tree(oak_), pine = tree(pine_), palm = tree(palm_);
  EXPECT_EQ(thick(palm), 4u + 10) << "the flare and the stem";
  EXPECT_GT(thick(oak), thick(pine));
  EXPECT_GT(thick(pine), thick(palm));
  EXPECT_GT(box(palm).size().y, 1.2f * box(oak).size().y * 0.7f);
}

TEST_F(Arboretum, RootsAreCounted) {
  for (int roots = 0; roots <= 7; ++roots) {
    Quantiles values = oak_;
    values["roots"] = (roots + 0.5) / 8;
    std::size_t low = 0;
    for (const Instance& part : tree(values).instances) {  // spans that begin a little above the trunk's foot
      const Frame& f = part.model_from_mesh;
      const Vec3 base = f.origin - 0.5f * f.basis[1];
      low += graph_->meshes[part.mesh].kind == MeshKind::cone && glm::length(base - Vec3(0, 0.42f * 0.24f, 0)) < 1e-4f;
    }
    EXPECT_EQ(low, roots > 1 ? static_cast<std::size_t>(roots) : 0u);
  }
}

TEST_F(Arboretum, CrownGenesShapeTheCrown) {
  const auto spread = [&](const char* gene, double u) {
    Quantiles values = oak_;
    values[gene] = u;
    const Vec3 size = box(tree(values)).size();
    return std::max(size.x, size.z) / size.y;
  };
  EXPECT_GT(spread("crown_width", 1), 1.3f * spread("crown_width", 0));
  // A weeping tree's twigs hang: more of its leaves are low.
  const auto low_leaves = [&](double u) {
    Quantiles values = oak_;
    values["weeping"] = u;
    const Model model = tree(values);
    double sum = 0, n = 0;
    for (const Instance& part : model.instances) {
      if (graph_->meshes[part.mesh].kind != MeshKind::leaf) continue;
      sum += static_cast<double>(part.model_from_mesh.origin.y), ++n;
    }
    return sum / n / static_cast<double>(box(model).max.y);
  };
  EXPECT_LT(low_leaves(1), low_leaves(0) - 0.05);
}

TEST_F(Arboretum, FlowersAndFruitComeInTheUpperThird) {
  const auto of = [&](const Quantiles& kind, const char* gene, double u) {
    Quantiles values = kind;
    values[gene] = u;
    return tree(values);
  };
  EXPECT_EQ(count(of(oak_, "fruit", 0.6), MeshKind::sphere), 0u);
  EXPECT_GT(count(of(oak_, "fruit", 1), MeshKind::sphere), 10u);
  EXPECT_LT(count(of(oak_, "fruit", 1), MeshKind::sphere), 150u);
  EXPECT_GT(count(of(palm_, "fruit", 1), MeshKind::sphere), 4u);
  EXPECT_EQ(count(of(oak_, "flowers", 0.1), MeshKind::leaf), count(of(oak_, "flowers", 0.6), MeshKind::leaf));
  EXPECT_GT(count(of(oak_, "flowers", 1), MeshKind::leaf), count(of(oak_, "flowers", 0.6), MeshKind::leaf) + 500);
}

/// Every twig of a broadleaf ends in a leaf. A few limbs end where others go on from them.
TEST_F(Arboretum, LeavesReachTheTips) {
  const Model model = tree(oak_);
  std::vector<Vec3> stems;
  for (const Instance& part : model.instances) {
    const Frame& f = part.model_from_mesh;
    if (graph_->meshes[part.mesh].kind == MeshKind::leaf) stems.push_back(f.origin - 0.5f * f.basis[1]);
  }
  const Limbs limbs = find_limbs(model, meshes_of(*graph_));
  std::size_t tips = 0, bare = 0;
  for (const Limb& limb : limbs.limbs) {
    const Vec3 tip = limb.joints.back().at;
    if (tip.y < 0.5f) continue;  // roots
    float nearest = 1e9f;
    for (const Vec3& stem : stems) nearest = std::min(nearest, glm::length(stem - tip));
    bare += nearest > 0.01f;
    ++tips;
  }
  EXPECT_LE(bare, tips / 50);
  EXPECT_GT(tips, 100u);
}

TEST_F(Arboretum, WoodTouchesEndToEnd) {
  for (const Quantiles& kind : {oak_, pine_, palm_}) {
    const Model model = tree(kind);
    const Limbs limbs = find_limbs(model, meshes_of(*graph_));
    // The flare and the trunk are one limb, the longest of all.
    ASSERT_FALSE(limbs.limbs.empty());
    EXPECT_GE(limbs.limbs[0].parts.size(), 4u + 4);
    std::size_t loose = 0;
    for (const Limb& limb : limbs.limbs) loose += limb.joints[0].at.y > 0.2f && limb.host == 0;
    EXPECT_EQ(loose, 0u) << "every other limb begins within another";
  }
}

TEST_F(Arboretum, NoGenomeMakesTooMuch) {
  for (const char* most : {"50", "1200", "10000"}) {
    const auto graph = compile_shipped("arboretum.esp", {{"most_spans", most}});
    for (std::uint32_t k = 0; k < 64; ++k) {  // corners of the genome, and all of its ends at once
      Derivation derivation = grown(*graph, 1, k);
      RandomStream random = stream_of(1000 + k);
      for (std::uint32_t& q : derivation.draws) q = k == 0 ? kMost : k == 1 ? 0 : random.next_u32() & 1 ? kMost : 0;
      const Grown one(*graph, derivation, ExpandTo::full);
      EXPECT_FALSE(one.model.truncated);
      EXPECT_EQ(one.model.dropped, 0u);
      EXPECT_GT(one.model.instances.size(), 40u);
      EXPECT_LT(one.model.instances.size(), 20'000 + 60 * std::stoul(most));
    }
  }
}

TEST_F(Arboretum, FewTreesGrowIntoTheGround) {
  const auto graph = compile_shipped("arboretum.esp", {{"leafy", "false"}});
  std::size_t deep = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Grown one(*graph, grown(*graph, 1, i), ExpandTo::full);
    float lowest = 0;
    for (const Instance& part : one.model.instances) lowest = std::min(lowest, part.model_from_mesh.origin.y);
    deep += lowest < -0.2f;
  }
  EXPECT_LE(deep, 6u);
}

/// At most nine pictures in a file: leaves of two or three tones that wilt in three steps, and one bark.
TEST_F(Arboretum, HasFewPictures) {
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Grown one(*graph_, grown(*graph_, 1, i), ExpandTo::full);
    std::vector<TextureRef> pictures;
    const std::vector<Material> materials = materials_of(*graph_, one.model);
    std::vector<char> shown(materials.size());
    for (const Instance& part : one.model.instances) shown[part.material] = true;
    for (std::size_t k = 0; k < materials.size(); ++k) {
      const TextureRef& texture = materials[k].texture;
      if (!shown[k] || !materials[k].textured()) continue;
      if (std::find(pictures.begin(), pictures.end(), texture) == pictures.end()) pictures.push_back(texture);
    }
    EXPECT_GE(pictures.size(), 1u);
    EXPECT_LE(pictures.size(), 10u);
  }
}

}  // namespace
}  // namespace espalier
