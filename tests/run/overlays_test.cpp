#include "run/overlays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/expand.h"
#include "run/drawing_fixtures.h"
#include "run/probes.h"
#include "run/silhouette_view.h"
#include "score/reference_silhouette.h"
#include "score/reference_volume.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::set_up_drawing;
using testing::TemporaryFolder;

Model probe(const Setup& setup, std::uint32_t index) {
  Expander expander(setup.graph(), {.make_materials = false});
  Model model;
  expander.expand(grow_probe(setup.graph(), setup.scene, index), ExpandTo::full, model);
  return model;
}

/// By rays, and by what the words say; no code shared with the kernel.
TEST(Overlays, PixelsAreMarkedAsTheReferenceCoversThem) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, std::string(testing::kPinhole) + testing::kParallel + testing::kWall);
  const std::vector<Caster> casters = make_casters(setup->meshes);
  for (const SilhouetteTarget* target : setup->silhouettes) {
    const Model model = probe(*setup, 1);
    const SilhouetteSettings& s = target->settings();
    const PixelCanvas silhouette = reference_silhouette(s.projection, casters, model.instances, s.view);
    const MarkedPixels marked = mark_silhouette(*target, model.instances);
    ASSERT_EQ(marked.marks.size(), std::size_t{s.image.width} * s.image.height);
    std::size_t i = 0, off = 0, covered = 0;
    for (std::uint32_t row = 0; row < s.image.height; ++row) {
      for (std::uint32_t column = 0; column < s.image.width; ++column, ++i) {
        const bool seen = silhouette.get(column, row);
        const std::int32_t wish = s.image.at(column, row);
        const Mark expected = wish > 0 ? (seen ? Mark::hit : Mark::missed)
                              : wish < 0 ? (seen ? Mark::spilled : Mark::free)
                                         : (seen ? Mark::covered : Mark::indifferent);
        off += marked.marks[i] != expected, covered += seen;
      }
    }
    EXPECT_GT(covered, 50u);
    EXPECT_LE(off, 1u) << "rays through edges may round the other way";
  }
}

TEST(Overlays, VoxelsAreMarkedAsTheReferenceCountsThem) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, testing::kTowerVolume + std::string("[[volume.mesh]]\n"
                                            "file = \"meshes/tower.obj\"\nfill = -1\nposition = [0, 3, 0]\n"));
  const Model model = probe(*setup, 2);
  const VolumeTarget& target = *setup->volume;
  const ReferenceVolume reference(target.grid(), setup->meshes, setup->targets);
  std::uint64_t outside = 0;
  const auto hits = reference.cover(model.instances, target.settings().view, outside);
  const MarkedVoxels marked = mark_voxels(target, model.instances);
  ASSERT_EQ(marked.voxels.size(), hits.size());
  std::size_t kinds[7] = {};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool wanted = reference.targets()[0][i], avoided = reference.targets()[1][i], covered = hits[i] > 0;
    const VoxelMark expected = wanted    ? (covered ? VoxelMark::filled : VoxelMark::missed)
                               : avoided ? (covered ? VoxelMark::struck : VoxelMark::avoided)
                               : covered ? VoxelMark::spilled
                                         : VoxelMark::free;
    ASSERT_EQ(marked.mark(i), expected) << i;
    ASSERT_EQ(marked.twice(i), hits[i] > 1) << i;
    ++kinds[static_cast<std::size_t>(expected)];
  }
  EXPECT_GT(kinds[static_cast<std::size_t>(VoxelMark::filled)], 10u);
  EXPECT_GT(kinds[static_cast<std::size_t>(VoxelMark::spilled)], 10u);
  const auto scratch = target.make_scratch();
  const auto rows = legend_of(marked, target.counts(model.instances, *scratch).outside);
  EXPECT_THAT(rows[0].text, HasSubstr(std::to_string(kinds[static_cast<std::size_t>(VoxelMark::filled)]) + " voxels"));
}

TEST(Overlays, WhereNothingIsToBeFilledElsewhereIsNotSpilled) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, testing::kTowerVolume + std::string("fill = -1\n"));
  const MarkedVoxels marked = mark_voxels(*setup->volume, probe(*setup, 2).instances);
  for (std::size_t i = 0; i < marked.voxels.size(); ++i) {
    ASSERT_NE(marked.mark(i), VoxelMark::spilled);
    ASSERT_NE(marked.mark(i), VoxelMark::missed);
  }
  EXPECT_THAT(legend_of(marked, 3).back().text, HasSubstr("3 voxels"));
}

TEST(Overlays, LegendsAgreeWithTheScore) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, testing::kPinhole);
  const SilhouetteTarget& target = *setup->silhouettes[0];
  const Model model = probe(*setup, 3);
  const auto scratch = target.make_scratch();
  const SilhouetteCounts counts = target.counts(model.instances, *scratch);
  const auto rows = legend_of(mark_silhouette(target, model.instances));
  EXPECT_THAT(rows[0].text, HasSubstr("hit: " + std::to_string(counts.wanted) + " pixel"));
  EXPECT_THAT(rows[2].text, HasSubstr("spilled: " + std::to_string(counts.free) + " pixel"));
  const DrawingCounts drawing = count_drawing(target.settings().image);
  EXPECT_EQ(drawing.wanted, 60u * 90u);
  EXPECT_EQ(drawing.to_avoid, 60u * 90u);
  EXPECT_EQ(drawing.indifferent, 0u);
}

// The camera of the picture and that of the kernel are two pieces of code: what they show must agree.
TEST(SilhouetteView, ShowsTheModelWhereTheKernelCoversPixels) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, std::string(testing::kPinhole) + testing::kParallel);
  const auto executor = make_serial_executor();
  for (std::size_t t = 0; t < 2; ++t) {
    const Model model = probe(*setup, 1);
    const PixelCanvas silhouette = setup->silhouettes[t]->silhouette(model.instances);
    const std::array<std::uint32_t, 2> size = {silhouette.width, silhouette.height};
    std::vector<Material> dark = setup->graph().materials;
    for (Material& material : dark) material.color = Vec3(0.01f);
    const Surfaces surfaces = dark;
    // From below, and straight from the front, no ground is seen: what differs from the empty stage is the model.
    const Picture seen = silhouette_view(*setup, t, model, surfaces, size, 16, *executor);
    const Picture empty = silhouette_view(*setup, t, Model(), surfaces, size, 16, *executor);
    ASSERT_EQ(seen.width, silhouette.width);
    ASSERT_EQ(seen.height, silhouette.height);
    std::size_t covered = 0, off = 0;
    for (std::uint32_t y = 0; y < seen.height; ++y) {
      for (std::uint32_t x = 0; x < seen.width; ++x) {
        int difference = 0;
        for (std::size_t c = 0; c < 3; ++c)
          difference = std::max(difference, std::abs(seen.rgb[3 * (x + seen.width * y) + c] -
                                                     empty.rgb[3 * (x + seen.width * y) + c]));
        covered += silhouette.get(x, y);
        off += (difference > 60) != silhouette.get(x, y);
      }
    }
    EXPECT_GT(covered, 100u) << t;
    EXPECT_LT(static_cast<double>(off), 0.12 * static_cast<double>(covered)) << t << ": all but pixels on edges";
  }
}

TEST(SilhouetteView, AShadowLiesOnItsPlaneBesideTheModel) {
  const TemporaryFolder folder;
  const auto setup = set_up_drawing(folder, std::string(testing::kFloor) + testing::kWall);
  const auto executor = make_serial_executor(), many = make_thread_executor(3);
  const Surfaces surfaces = setup->graph().materials;
  for (std::size_t t = 0; t < 2; ++t) {
    const Picture bare = silhouette_view(*setup, t, Model(), surfaces, {200, 150}, 4, *executor);
    const Picture seen = silhouette_view(*setup, t, probe(*setup, 1), surfaces, {200, 150}, 4, *executor);
    EXPECT_EQ(seen.rgb, silhouette_view(*setup, t, probe(*setup, 1), surfaces, {200, 150}, 4, *many).rgb);
    EXPECT_TRUE(seen.alpha.empty());
    std::size_t amber = 0, shaded = 0;
    for (std::size_t i = 0; i < bare.rgb.size(); i += 3) {
      amber += bare.rgb[i] > 240 && bare.rgb[i + 2] < 170;
      shaded += seen.rgb[i] < 125;
    }
    EXPECT_GT(amber, 1000u) << "half of the drawing is wanted";
    EXPECT_GT(shaded, 200u);
  }
}

}  // namespace
}  // namespace espalier
