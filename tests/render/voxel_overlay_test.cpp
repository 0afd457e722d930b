#include "render/voxel_overlay.h"

#include <gtest/gtest.h>

#include "render/voxel_view.h"

namespace espalier {
namespace {

bool has(const Picture& picture, const Colour& colour) {
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    if (picture.rgb[i] == colour.rgb[0] && picture.rgb[i + 1] == colour.rgb[1] && picture.rgb[i + 2] == colour.rgb[2])
      return true;
  }
  return false;
}

MarkedVoxels empty_grid(std::array<std::uint32_t, 3> cells) {
  MarkedVoxels voxels{cells, Vec3(0), Vec3(static_cast<float>(cells[0]), static_cast<float>(cells[1]),
                                           static_cast<float>(cells[2])), {}};
  voxels.voxels.assign(std::size_t{cells[0]} * cells[1] * cells[2], 0);
  return voxels;
}

void set(MarkedVoxels& voxels, std::uint32_t x, std::uint32_t y, std::uint32_t z, VoxelMark mark, bool twice = false) {
  voxels.voxels[voxels.index(x, y, z)] =
      static_cast<std::uint8_t>(static_cast<int>(mark) | (twice ? MarkedVoxels::kTwice : 0));
}

TEST(VoxelOverlay, CutsWhereMostIsToBeSeen) {
  MarkedVoxels voxels = empty_grid({6, 5, 4});
  using Cuts = std::array<std::uint32_t, 3>;
  EXPECT_EQ(fullest_cuts(voxels), (Cuts{0, 0, 0}));
  for (std::uint32_t z = 0; z < 4; ++z) set(voxels, 4, 2, z, VoxelMark::missed);
  set(voxels, 4, 3, 1, VoxelMark::spilled);
  for (std::uint32_t y = 0; y < 5; ++y) set(voxels, 0, y, 3, VoxelMark::avoided);  // nothing that counts
  EXPECT_EQ(fullest_cuts(voxels), (Cuts{4, 2, 1}));
}

TEST(VoxelOverlay, ShowsEveryKind) {
  const auto executor = make_serial_executor();
  for (const VoxelMark mark : {VoxelMark::missed, VoxelMark::filled, VoxelMark::spilled, VoxelMark::elsewhere,
                               VoxelMark::struck}) {
    MarkedVoxels voxels = empty_grid({8, 8, 8});
    EXPECT_FALSE(has(draw_voxels(voxels, 600, 1, *executor), colour_of(mark)));
    set(voxels, 3, 4, 5, mark);
    EXPECT_TRUE(has(draw_voxels(voxels, 600, 1, *executor), colour_of(mark))) << static_cast<int>(mark);
    if (!is_covered(mark) || mark == VoxelMark::struck) continue;
    set(voxels, 3, 4, 5, mark, true);
    EXPECT_TRUE(has(draw_voxels(voxels, 600, 1, *executor), colour_of(mark, true))) << static_cast<int>(mark);
  }
}

TEST(VoxelOverlay, FrontIsSeenFromTheFront) {
  // A column at the left end of x: it stands at the left of the cut across z, and seen from above.
  MarkedVoxels voxels = empty_grid({10, 10, 10});
  for (std::uint32_t y = 0; y < 3; ++y) set(voxels, 0, y, 9, VoxelMark::filled);
  const auto executor = make_serial_executor();
  const Picture picture = draw_voxels(voxels, 1000, 1, *executor);
  const Colour filled = colour_of(VoxelMark::filled);
  // The cuts begin right of the view; the first one's filled pixels are its lower left corner.
  std::uint32_t left = picture.width, right = 0, top = picture.height, bottom = 0;
  for (std::uint32_t y = 0; y < picture.height / 2; ++y) {
    for (std::uint32_t x = picture.width * 42 / 100; x < picture.width * 70 / 100; ++x) {
      const std::uint8_t* p = picture.rgb.data() + 3 * (x + picture.width * y);
      if (p[0] != filled.rgb[0] || p[1] != filled.rgb[1] || p[2] != filled.rgb[2]) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  ASSERT_LT(left, right);
  const double wide = right - left + 1, tall = bottom - top + 1;
  EXPECT_NEAR(tall / wide, 3, 0.3) << "three cells high";
}

TEST(VoxelView, NearVoxelsHideFarOnes) {
  const auto executor = make_serial_executor();
  MarkedVoxels voxels = empty_grid({9, 9, 9});
  for (std::uint32_t x = 0; x < 9; ++x)
    for (std::uint32_t y = 0; y < 9; ++y) set(voxels, x, y, 8, VoxelMark::filled);  // a wall at the front
  const auto red_of = [&](const Picture& picture) {
    std::size_t red = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) red += picture.rgb[i] > picture.rgb[i + 2] + 40;
    return red;
  };
  set(voxels, 2, 2, 5, VoxelMark::spilled);
  EXPECT_EQ(red_of(voxel_view(voxels, 200, 200, 1, *executor)), 0u);
  set(voxels, 8, 8, 8, VoxelMark::spilled);
  EXPECT_GT(red_of(voxel_view(voxels, 200, 200, 1, *executor)), 20u);
}

TEST(VoxelView, IsTheSameForAnyNumberOfThreadsAndEndsOnFlatGrids) {
  MarkedVoxels voxels = empty_grid({40, 30, 1});
  for (std::uint32_t x = 5; x < 30; ++x) set(voxels, x, x % 20, 0, x % 3 ? VoxelMark::filled : VoxelMark::missed);
  const auto one = make_serial_executor(), many = make_thread_executor(5);
  EXPECT_EQ(draw_voxels(voxels, 700, 2, *one).rgb, draw_voxels(voxels, 700, 2, *many).rgb);
  EXPECT_NO_FATAL_FAILURE(draw_voxels(empty_grid({1, 1, 4096}), 700, 1, *one));
  EXPECT_NO_FATAL_FAILURE(draw_voxels(empty_grid({4096, 1, 1}), 100, 1, *one));
}

}  // namespace
}  // namespace espalier
