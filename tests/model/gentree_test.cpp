// GenTree: exactly the 13 genes of the paper with their ranges, read off the trees that they make; chances that hang on
// one gene.

#include "base/hash.h"
#include "model/parts.h"
#include "model/tree_genes.h"
#include "no_files.h"

namespace espalier {
namespace {

using namespace test;

constexpr std::uint32_t kMost = 0xffffffffu;

struct Gene {
  const char* name;
  std::uint32_t values;  // 0: continuous
};
const Gene kGenes[] = {{"number_of_branches", 8}, {"length_ratio", 0}, {"width_ratio", 0}, {"taper", 0},
                       {"branch_proximity", 0}, {"tree_depth", 8}, {"branch_angle_delta", 0}, {"vertical_change", 0},
                       {"parent_influence", 0}, {"direction_noise", 0}, {"branch_number_noise", 0},
                       {"subtree_depth_noise", 0}, {"random_seed", 0}};

class GenTree : public testing::Test {
 protected:
  Model tree(const Quantiles& quantiles, std::uint64_t seed = 1) const { return tree_of(*graph_, quantiles, 0, seed); }

  std::shared_ptr<const GeneratorGraph> graph_ = compile_shipped("gentree.esp", {{"leafy", "false"}});
};

TEST_F(GenTree, HasThePapersGenes) {
  ASSERT_EQ(graph_->rules.size(), 1u);
  const Rule& rule = graph_->rules[0];
  ASSERT_EQ(rule.draws.size(), 13u);
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_EQ(rule.draws[i].name, std::string("Tree.") + kGenes[i].name);
    EXPECT_EQ(rule.draws[i].values, kGenes[i].values) << kGenes[i].name;
    EXPECT_EQ(rule.draws[i].shape, kGenes[i].values ? DrawShape::discrete : DrawShape::continuous);
  }
}

TEST_F(GenTree, NumberAndDepthCountItsSpans) {
  for (int n = 1; n <= 8; ++n) {
    const auto spans = static_cast<unsigned>(1 + n + n * n);  // depth 2
    EXPECT_EQ(tree({{"number_of_branches", (n - 0.5) / 8}}).instances.size(), spans);
  }
  for (unsigned levels = 2; levels <= 9; ++levels) {  // one branch per span
    EXPECT_EQ(tree({{"tree_depth", (levels - 1.5) / 8}}).instances.size(), levels + 1);
  }
}

TEST_F(GenTree, RatiosSpanTheirRanges) {
  const double ends[] = {0, 1};
  for (const double u : ends) {
    const float ratio = u > 0 ? 0.9f : 0.2f;
    const Model longer = tree({{"length_ratio", u}}), wider = tree({{"width_ratio", u}});
    for (std::size_t k = 1; k < 3; ++k) {
      EXPECT_NEAR(size_of(longer.instances[k]).y / size_of(longer.instances[k - 1]).y, ratio, 1e-4f);
      EXPECT_NEAR(size_of(wider.instances[k]).x / size_of(wider.instances[k - 1]).x, ratio, 1e-4f);
    }
    EXPECT_NEAR(tree({{"taper", u}}).instances[0].top, ratio, 1e-5f);
    // Eight children: the first at the tip, the others within the proximity's share, measured from the tip.
    const Model crown = tree({{"number_of_branches", 1}, {"branch_proximity", u}, {"parent_influence", 1}});
    const float tall = size_of(crown.instances[0]).y, share = u > 0 ? 0.8f : 0.1f;
    float lowest = tall;
    for (std::size_t k = 1; k <= 8; ++k) {
      const Frame& frame = crown.instances[k].model_from_mesh;
      const float base = frame.origin.y - 0.5f * frame.basis[1].y;
      if (k == 1) {
        EXPECT_NEAR(base, tall, 1e-5f);
      }
      lowest = std::min(lowest, base);
    }
    EXPECT_GE(lowest, tall * (1 - share) - 1e-5f);
    EXPECT_LE(lowest, tall * (1 - share * 7 / 8) + 1e-5f);
  }
}

/// How far from upright the tree's spans are at most, in degrees.
float most_lean(const Model& model) {
  float most = 0;
  for (const Instance& part : model.instances) {
    most = std::max(most, angle_between(part.model_from_mesh.basis[1], Vec3(0, 1, 0)) / kDegree);
  }
  return most;
}

TEST_F(GenTree, DirectionsMixParentSpreadRiseAndNoise) {
  const Quantiles bushy = {{"number_of_branches", 1}, {"parent_influence", 1}, {"random_seed", 0.3}};
  const auto with = [&](const char* name, double u) {
    Quantiles values = bushy;
    values[name] = u;
    return most_lean(tree(values));
  };
  EXPECT_LT(most_lean(tree(bushy)), 0.1f) << "the parent's direction alone";
  // Two levels of atan(0.1) at most: 0.1 is the paper's largest angle delta.
  EXPECT_GT(with("branch_angle_delta", 1), 9);
  EXPECT_LT(with("branch_angle_delta", 1), 2 * 5.72f);
  EXPECT_GT(with("direction_noise", 1), 20);
  EXPECT_LT(with("parent_influence", 0), 0.1f) << "nothing to mix: the parent's direction";
  // Without a parent's influence the change is up or down, as in the paper's trees that grow into the ground.
  EXPECT_NEAR(most_lean(tree({{"number_of_branches", 1}, {"vertical_change", 1}})), 180, 0.1);
}

TEST_F(GenTree, NumberNoiseAddsOneAndDepthNoiseTakesLevelsAway) {
  const Model more = tree({{"branch_number_noise", 1}});  // one branch and one more, depth 2
  EXPECT_EQ(more.instances.size(), 1u + 2 + 4);
  const std::size_t full = tree({{"number_of_branches", 0.2}, {"tree_depth", 1}}).instances.size();
  EXPECT_EQ(full, 1023u) << "two branches, nine levels";
  std::size_t least = full;
  for (int k = 0; k < 8; ++k) {
    least = std::min(least, tree({{"number_of_branches", 0.2}, {"tree_depth", 1}, {"subtree_depth_noise", 1},
                                  {"random_seed", k / 8.0}}).instances.size());
  }
  EXPECT_LT(least, full / 4);
  EXPECT_GE(least, 3u);
}

bool equal(const Model& a, const Model& b) {
  if (a.instances.size() != b.instances.size()) return false;
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    if (a.instances[i].model_from_mesh.origin != b.instances[i].model_from_mesh.origin ||
        a.instances[i].model_from_mesh.basis != b.instances[i].model_from_mesh.basis) return false;
  }
  return true;
}

TEST_F(GenTree, TheSeedGeneAloneDecidesItsChances) {
  Quantiles values = {{"number_of_branches", 0.4}, {"tree_depth", 0.3}, {"branch_angle_delta", 1}, {"vertical_change", 0.5}};
  values["parent_influence"] = 0.7, values["direction_noise"] = 0.5, values["random_seed"] = 0.25;
  const Model one = tree(values, 1);
  EXPECT_TRUE(equal(one, tree(values, 99))) << "whatever the model's seed";
  values["random_seed"] = 0.75;
  EXPECT_FALSE(equal(one, tree(values, 1)));
}

/// The bytes of the mesh that files hold: positions and normals of all parts in model space.
std::string mesh_hash(const GeneratorGraph& graph, const Model& model) {
  const Parts parts = collect_parts(model, meshes_of(graph), true);
  std::string bytes;
  for (const Part& part : parts.parts) {
    const Mesh mesh = baked(parts.shapes[part.shape], part.model_from_shape);
    for (const std::vector<Vec3>* list : {&mesh.positions, &mesh.normals})
      bytes.append(reinterpret_cast<const char*>(list->data()), list->size() * sizeof(Vec3));
    bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()), mesh.triangles.size() * sizeof(Triangle));
  }
  return content_hash(bytes);
}

/// Byte for byte, on every machine: these hashes never change.
TEST_F(GenTree, TheSameGenomeGivesTheSameMesh) {
  Quantiles values = {{"number_of_branches", 0.4}, {"length_ratio", 0.7}, {"width_ratio", 0.5}, {"taper", 0.6},
                   {"branch_proximity", 0.5}, {"tree_depth", 0.4}, {"branch_angle_delta", 0.9},
                   {"vertical_change", 0.3}, {"parent_influence", 0.8}, {"direction_noise", 0.4},
                   {"branch_number_noise", 0.3}, {"subtree_depth_noise", 0.2}, {"random_seed", 0.123}};
  EXPECT_EQ(mesh_hash(*graph_, tree(values)), "92f547d593a607f90ca272782447fd9b");
  const auto leafy = compile_shipped("gentree.esp");
  ASSERT_NE(leafy, nullptr);
  graph_ = leafy;
  EXPECT_EQ(mesh_hash(*graph_, tree(values)), "4bc23101bc5611ccb5a7ba7d436260b7") << "with green triangles";
  graph_ = compile_shipped("gentree.esp", {{"height", "2.5"}, {"width", "0.2"}});
  EXPECT_EQ(mesh_hash(*graph_, tree(values)), "b1df4e24ff9a5d8bab28c352a377fa4e") << "the trunk's size is a setting";
}

TEST_F(GenTree, GreenTrianglesAndTheTrunkAreSettings) {
  const Quantiles values = {{"number_of_branches", 0.2}};  // two, depth two
  const std::size_t bare = tree(values).instances.size();
  graph_ = compile_shipped("gentree.esp");
  EXPECT_EQ(tree(values).instances.size(), bare + 3 * 4) << "a tuft on each of the four tips";
  graph_ = compile_shipped("gentree.esp", {{"height", "2.5"}, {"width", "0.2"}});
  EXPECT_NEAR(size_of(tree(values).instances[0]).y, 2.5f, 1e-5f);
  EXPECT_NEAR(size_of(tree(values).instances[0]).x, 0.2f, 1e-5f);
}

TEST_F(GenTree, TheLargestTreeEndsTruncated) {
  const Model model =
      tree({{"number_of_branches", 1}, {"tree_depth", 1}, {"length_ratio", 1}, {"branch_number_noise", 1}});
  EXPECT_TRUE(model.truncated);
  EXPECT_LE(model.instances.size(), 1'000'000u);
  EXPECT_GE(model.instances.size(), 90'000u);
  // Breadth first: the levels that are there are whole, so no branch is bare while another is full.
  std::map<int, std::size_t> of_length;
  for (const Instance& part : model.instances) {
    ++of_length[static_cast<int>(std::lround(std::log(size_of(part).y / 1.6f) / std::log(0.9f)))];
  }
  std::size_t expected = 1;
  for (int level = 0; level <= 5; ++level, expected *= 9) EXPECT_EQ(of_length[level], expected) << level;
  EXPECT_FALSE(tree({{"number_of_branches", 1}, {"tree_depth", 0}}).truncated);
}

TEST(GenTreeNatural, BranchesAreNoWiderThanTheirParentsAndFewTouchTheGround) {
  const auto graph = compile_shipped("gentree-natural.esp", {{"leafy", "false"}});
  std::size_t below = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Grown tree(*graph, grown(*graph, 1, i), ExpandTo::full);
    EXPECT_FALSE(tree.model.truncated);
    float lowest = 1, widest = 0;
    for (const Instance& part : tree.model.instances) {
      lowest = std::min(lowest, part.model_from_mesh.origin.y);
      if (&part != &tree.model.instances[0]) widest = std::max(widest, size_of(part).x);  // without the flare
    }
    below += lowest < 0;
    EXPECT_NEAR(widest, 0.24f, 1e-4f) << "the trunk is widest";
  }
  EXPECT_LE(below, 2u);
}

TEST(GenTreeNatural, MostSpansBoundsTheLargestTree) {
  for (const char* most : {"50", "2500", "20000"}) {
    const auto graph = compile_shipped("gentree-natural.esp", {{"leafy", "false"}, {"most_spans", most}});
    Derivation derivation = grown(*graph, 1, 1);
    std::fill(derivation.draws.begin(), derivation.draws.end(), kMost);
    derivation.draws[11] = 0;  // no subtree is cut short
    const Grown tree(*graph, derivation, ExpandTo::full);
    EXPECT_FALSE(tree.model.truncated);
    EXPECT_LT(tree.model.instances.size(), 3 * 2 * std::stoul(most)) << "three sections a span; about";
  }
}

}  // namespace
}  // namespace espalier
