// Meshes of every sort, drawn by their folds, against the reference that tries each triangle.

#include <cmath>

#include <gtest/gtest.h>

#include "score/reference_silhouette.h"
#include "score/silhouette_kernel.h"
#include "score_models.h"

namespace espalier {
namespace {

using test::Dice;

Caster caster_of(const Mesh& mesh) {
  MeshRef file;
  file.kind = MeshKind::file;
  return make_caster(file, mesh);
}

/// Triangles at random, some of which share corners, run against each other or have no area.
Mesh soup(Dice& dice, int triangles, float size) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 at(dice.between(-0.5f, 0.5f), dice.between(-0.5f, 0.5f), dice.between(-0.5f, 0.5f));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back(at + size * Vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)));
    Triangle t = {first, first + 1, first + 2};
    if (first > 2 && dice.chance(0.5)) t[2] = dice.below(first), t[1] = dice.below(first);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// A wavy sheet of cells x cells squares; with `back`, a second side that shares the border.
Mesh sheet(int cells, bool back) {
  Mesh mesh;
  for (const float side : {1.0f, -1.0f}) {
    if (side < 0 && !back) break;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(cells) - 0.5f,
                    v = static_cast<float>(j) / static_cast<float>(cells) - 0.5f;
        const float thick = 0.1f * (0.25f - u * u) * (0.25f - v * v);  // 0 at the border
        mesh.positions.push_back({u, v, 0.2f * std::sin(9 * u) * std::cos(7 * v) + side * thick});
      }
    const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        for (Triangle t : {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                           Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
          if (side < 0) std::swap(t[0], t[1]);
          mesh.triangles.push_back(t);
        }
  }
  return mesh;
}

Frame frame_of(Dice& dice, float size, float around) {
  Frame frame;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) frame.basis[c][r] = size * dice.between(-1, 1);
    frame.origin[c] = dice.between(-around, around);
  }
  return frame;
}

/// Pixels in which both differ. Rays through a common edge may slip between its triangles in the reference.
std::uint64_t differences(const Mesh& mesh, const Projection& projection, const Instance& one) {
  const std::vector<Caster> casters = {caster_of(mesh)};
  WeightImage image{projection.width, projection.height, {}};
  image.degrees.assign(std::size_t{projection.width} * projection.height, 65535);
  const SilhouetteKernel kernel(projection, casters, image);
  SilhouetteScratch scratch(projection);
  for (int twice = 0; twice < 2; ++twice) {  // nothing is left of the first
    kernel.draw(std::span(&one, 1), VolumeView::full, scratch);
    if (twice == 0) kernel.sweep(scratch);
  }
  const PixelCanvas slow = reference_silhouette(projection, casters, std::span(&one, 1), VolumeView::full);
  std::uint64_t different = 0;
  for (std::uint32_t row = 0; row < projection.height; ++row)
    for (std::uint32_t column = 0; column < projection.width; ++column)
      different += scratch.canvas.get(column, row) != slow.get(column, row) ? 1 : 0;
  for (const std::int32_t begins : scratch.folds.begins) EXPECT_EQ(begins, 0);
  return different;
}

TEST(FoldDraw, SoupsAgreeWithTheReference) {
  std::uint64_t different = 0, pixels = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Dice dice(100 + i);
    const Mesh mesh = soup(dice, 1 + static_cast<int>(dice.below(60)), i % 2 == 0 ? 0.1f : 0.6f);
    LookAt look;
    look.eye = {dice.between(-3, 3), dice.between(-3, 3), 7};
    const Projection projection =
        i % 3 == 0 ? orthographic(look, 5, 130, 90) : perspective(look, 40, 0.2, 100, 70 + dice.below(20));
    const Instance one = test::part(0, frame_of(dice, dice.between(0.1f, 4), 1.5f));
    different += differences(mesh, projection, one);
    pixels += std::uint64_t{projection.width} * projection.height;
  }
  EXPECT_LE(different, 2u) << "of " << pixels;
}

TEST(FoldDraw, SheetsAgreeWithTheReference) {
  std::uint64_t different = 0, pixels = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    Dice dice(400 + i);
    const Mesh mesh = sheet(2 + static_cast<int>(dice.below(9)), i % 2 == 0);
    LookAt look;
    look.eye = {dice.between(-3, 3), dice.between(-3, 3), 7};
    const Projection projection = perspective(look, 40, 0.2, 100, 90);
    const Instance one = test::part(0, frame_of(dice, dice.between(0.2f, 5), 1.5f));
    different += differences(mesh, projection, one);
    pixels += std::uint64_t{projection.width} * projection.height;
  }
  EXPECT_LE(different, 2u) << "of " << pixels;
}

// Wide enough for the rows to be worked off in more than one band.
TEST(FoldDraw, LargeImagesAreDrawnInBands) {
  Dice dice(900);
  const Mesh mesh = sheet(3, false);
  for (const auto& [width, height] : {std::pair(2000u, 40u), std::pair(992u, 101u)}) {
    const Projection projection = orthographic(LookAt{}, 2, width, height);
    Instance one = test::part(0, Frame{});
    one.model_from_mesh.basis[0] *= 40, one.model_from_mesh.basis[1] *= 1.7f;
    one.model_from_mesh.basis[0][1] = 0.4f;
    EXPECT_LE(differences(mesh, projection, one), 1u);
  }
}

TEST(FoldDraw, SheetsSeenEdgeOnCoverNothing) {
  Mesh flat = sheet(4, false);
  for (Vec3& p : flat.positions) p.z = 0;
  flat.triangles.pop_back();  // not convex
  ASSERT_EQ(caster_of(flat).kind, Caster::Kind::triangles);
  for (const float column : {0.0f, 0.25f, 0.3f}) {
    Instance one = test::part(0, Frame{});
    one.model_from_mesh.basis = Mat3(0.0f);
    one.model_from_mesh.basis[0].z = 1, one.model_from_mesh.basis[1].y = 1, one.model_from_mesh.basis[2].x = 1;
    one.model_from_mesh.origin.x = column;
    EXPECT_EQ(differences(flat, orthographic(LookAt{}, 2, 64, 64), one), 0u);
    EXPECT_EQ(differences(flat, orthographic(LookAt{}, 2, 65, 65), one), 0u) << "through the middles of pixels";
  }
}

}  // namespace
}  // namespace espalier
