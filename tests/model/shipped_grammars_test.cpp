// What the shipped towns, buildings and creatures promise.

#include <array>
#include <set>

#include "model/shipped.h"

namespace espalier {
namespace {

using namespace test;

/// The boxes that stand for buildings, with the gene of each.
std::vector<const Instance*> buildings(const Grown& town) {
  std::vector<const Instance*> found;
  for (const Instance& part : town.model.instances)
    if (part.layer == Layer::proxy) found.push_back(&part);
  return found;
}

/// Cell k of the lattice, by the published formula without the shift.
void check_lattice(const char* name, bool with_lots) {
  const auto graph = compile_shipped(name);
  const Grown town(*graph, grown(*graph, 201, 1));
  const auto houses = buildings(town);
  ASSERT_EQ(houses.size(), 100u) << "every lot can be built on";
  std::set<int> cells;
  for (const Instance* house : houses) {
    const int lot = with_lots ? town.parent[house->gene] : static_cast<int>(house->gene);
    const int k = town.slot[static_cast<std::size_t>(lot)];
    cells.insert(k);
    EXPECT_NEAR(house->model_from_mesh.origin.x, -9.9 + 2.2 * (k % 10), 1e-4);
    EXPECT_NEAR(house->model_from_mesh.origin.z, -9.9 + 2.2 * (k / 10), 1e-4);
    const Vec3 size = size_of(*house);
    EXPECT_NEAR(house->model_from_mesh.origin.y, size.y / 2, 1e-4) << "it stands on the ground";
    EXPECT_TRUE(size.x >= 0.44f && size.x <= 1.98f && size.z >= 0.44f && size.z <= 1.98f);
    EXPECT_TRUE(size.y >= 0.36f && size.y <= 10);
  }
  EXPECT_EQ(cells.size(), 100u);
}

TEST(City, StandsOnAStraightLattice) { check_lattice("city.esp", true); }
TEST(CitySeparate, StandsOnAStraightLattice) { check_lattice("city-separate.esp", false); }

TEST(CityFilling, ItsFourArmsFillFourQuadrantsAndNoLotTwice) {
  const auto graph = compile_shipped("city-filling.esp");
  const Grown town(*graph, grown(*graph, 1500, 3));
  std::set<std::pair<long, long>> lots;
  std::map<int, std::set<std::pair<bool, bool>>> quadrants;  // of each arm
  for (const Instance* house : buildings(town)) {
    const Vec3 at = house->model_from_mesh.origin;
    const long x = std::lround(at.x / 2.2f), z = std::lround(at.z / 2.2f);
    EXPECT_LT(std::abs(at.x - 2.2f * static_cast<float>(x)) + std::abs(at.z - 2.2f * static_cast<float>(z)), 1e-3f);
    EXPECT_TRUE(lots.insert({x, z}).second) << x << ", " << z << " is built on twice";
    int gene = static_cast<int>(house->gene);
    while (town.parent[static_cast<std::size_t>(gene)] > 0) gene = town.parent[static_cast<std::size_t>(gene)];
    if (x != 0 && z != 0) quadrants[town.slot[static_cast<std::size_t>(gene)]].insert({x > 0, z > 0});
  }
  ASSERT_EQ(quadrants.size(), 4u);
  std::set<std::pair<bool, bool>> all;
  for (const auto& [arm, of_arm] : quadrants) {
    EXPECT_EQ(of_arm.size(), 1u) << "arm " << arm << " keeps to one";
    all.insert(of_arm.begin(), of_arm.end());
  }
  EXPECT_EQ(all.size(), 4u);
}

TEST(CityBuilding, ItsFacadesStayWithinTheBoxThatSearchesSee) {
  const auto graph = compile_shipped("city-building.esp");
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Grown site(*graph, grown(*graph, 2, i), ExpandTo::full);
    const Instance& box = *buildings(site).at(0);
    std::size_t details = 0, panes = 0;
    for (const Instance& part : site.model.instances) {
      if (part.gene != box.gene || part.layer != Layer::detail) continue;
      const Vec3 at = in_part(box, part.model_from_mesh.origin);
      if (at.y > 0.5f) continue;  // on the roof
      ++details, panes += graph->meshes[part.mesh].kind == MeshKind::quad;
      EXPECT_LE(std::max(std::abs(at.x), std::abs(at.z)), 0.5f + 1e-4f);
      EXPECT_GE(at.y, -0.5f);
    }
    EXPECT_GE(details, 20u);
    EXPECT_EQ(panes % 4, 0u) << "as many on every side";
    const double tall = static_cast<double>(size_of(box).y);
    EXPECT_GE(static_cast<double>(panes), 4 * std::max(1.0, std::floor(tall / 0.36)));
    EXPECT_LE(static_cast<double>(panes), 4 * std::ceil(tall / 0.24));
  }
}

TEST(Cathedral, BlocksLeaveEachOtherAtRightAnglesAndNeverTurnBack) {
  const auto graph = compile_shipped("cathedral.esp");
  std::array<int, 3> seen{};  // back, aside, on
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Grown church(*graph, grown(*graph, 40, i));
    for (const Bone& bone : church.model.bones) {
      if (church.rule(bone.gene) == "Tower") {
        EXPECT_GT(direction_of(bone).y, 0.9999f);
      }
      if (church.rule(bone.gene) != "Block") continue;
      EXPECT_NEAR(bone.from.y, 0, 1e-5f);
      EXPECT_NEAR(bone.to.y, 0, 1e-5f);
      const int above = church.parent[bone.gene];
      if (church.rule(static_cast<std::size_t>(above)) != "Block") continue;
      const Bone& before = *church.bones(static_cast<std::size_t>(above))[0];
      const float along = glm::dot(direction_of(bone), direction_of(before));
      EXPECT_NEAR(along, std::round(along), 1e-4f);
      ++seen[static_cast<std::size_t>(std::lround(along) + 1)];
    }
  }
  EXPECT_EQ(seen[0], 0);
  EXPECT_GT(seen[1], 10);
  EXPECT_GT(seen[2], 10);
}

TEST(Mondrian, SquaresLieOnTheirQuarter) {
  const auto graph = compile_shipped("mondrian.esp");
  const Grown painting(*graph, grown(*graph, 80, 1), ExpandTo::full);
  const auto panel = [&](std::size_t gene) { return painting.parts(gene, Layer::detail).at(0); };
  for (std::size_t gene = 1; gene < painting.derivation.size(); ++gene) {
    const Instance &parent = *panel(static_cast<std::size_t>(painting.parent[gene])), &square = *panel(gene);
    const Vec3 at = in_part(parent, square.model_from_mesh.origin);
    const int slot = painting.slot[gene];  // i, then j
    EXPECT_NEAR(at.x, slot < 2 ? -0.25f : 0.25f, 1e-4f);
    EXPECT_NEAR(at.z, slot % 2 ? 0.25f : -0.25f, 1e-4f);
    EXPECT_NEAR(size_of(square).x / size_of(parent).x, 0.5f, 1e-4f) << "so it covers that quarter, and no more";
    EXPECT_GT(at.y, 0) << "and stands out";
  }
}

TEST(Snake, IsAChainOnTheGround) {
  const auto graph = compile_shipped("snake.esp");
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Grown snake(*graph, grown(*graph, 25, i));
    ASSERT_EQ(snake.model.bones.size(), 24u);
    for (std::size_t k = 0; k < 24; ++k) {
      const Bone& bone = snake.model.bones[k];
      EXPECT_NEAR(length_of(bone), 1, 1e-4f);
      EXPECT_NEAR(bone.from.y, bone.to.y, 1e-4f);
      if (k == 0) continue;
      EXPECT_LT(glm::length(bone.from - snake.model.bones[k - 1].to), 1e-4f) << "connected";
      EXPECT_LE(angle_between(bone.to - bone.from, direction_of(snake.model.bones[k - 1])) / kDegree, 45.1f);
    }
  }
}

TEST(ModularHouse, UnitsStandBesideOrOnTopOfWhatCarriesThem) {
  const auto graph = compile_shipped("modular-house.esp");
  std::size_t beside = 0, above = 0;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Grown house(*graph, grown(*graph, 40, i));
    for (std::size_t gene = 0; gene < house.derivation.size(); ++gene) {
      if (house.rule(gene) != "Unit") continue;
      const auto link = static_cast<std::size_t>(house.parent[gene]);
      if (house.rule(link) == "House") continue;
      const Instance& below = *house.parts(static_cast<std::size_t>(house.parent[link]))[0];
      const Vec3 at = in_part(below, house.parts(gene)[0]->model_from_mesh.origin);
      if (house.rule(link) == "Upper") {
        EXPECT_GT(at.y, 0.5f);
        ++above;
      } else {
        EXPECT_GT(std::max(std::abs(at.x), std::abs(at.z)), 0.5f);
        ++beside;
      }
    }
  }
  EXPECT_GT(above, 10u);
  EXPECT_GT(beside, 10u);
}

TEST(Facade, EveryStoreyHasTheSameBays) {
  const auto graph = compile_shipped("facade.esp", {{"shop", "false"}});
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Grown house(*graph, grown(*graph, 6, i), ExpandTo::full);
    std::map<long, int> panes;  // by the height of their middle, in centimetres, of the genes that are bays
    for (const Instance& part : house.model.instances) {
      if (house.rule(part.gene) != "Bay" || graph->materials[part.material].name != "glass") continue;
      ++panes[std::lround(part.model_from_mesh.origin.y * 100)];
    }
    ASSERT_GE(panes.size(), 3u) << "storeys";
    for (const auto& [height, count] : panes) EXPECT_EQ(count, panes.begin()->second) << "at " << height << " cm";
  }
}

/// Nothing is dropped and no budget runs out in ordinary use.
TEST(ShippedGrammars, MakeWholeModels) {
  const std::vector<std::string> names = shipped_grammars();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    ASSERT_TRUE(graph);
    for (std::uint32_t i = 0; i < 5; ++i) {
      const Grown one(*graph, grown(*graph, 60, i), ExpandTo::full);
      EXPECT_GT(one.model.instances.size(), 0u);
      EXPECT_EQ(one.model.dropped, 0u);
      EXPECT_TRUE(!one.model.truncated || name == "gentree.esp") << "only its larger trees are, and say so";
    }
  }
}

}  // namespace
}  // namespace espalier
