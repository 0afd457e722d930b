#include "score/fold_mesh.h"

#include <map>

#include <gtest/gtest.h>

#include "score_models.h"

namespace espalier {
namespace {

FoldMesh folded(const Mesh& mesh) { return FoldMesh(mesh.positions, mesh.triangles); }

TEST(FoldMesh, AClosedMeshHasNoBorders) {
  const FoldMesh gem = folded(test::gem_mesh());
  EXPECT_EQ(gem.folds.size(), 12u) << "Euler: 6 corners, 8 faces";
  EXPECT_TRUE(gem.borders.empty());
  EXPECT_EQ(gem.faces, 8u);
  EXPECT_EQ(gem.place[0].size(), 8u) << "padded";
}

TEST(FoldMesh, BordersRunTheWayOfTheirFace) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  const FoldMesh mesh(corners, square);
  ASSERT_EQ(mesh.folds.size(), 1u);
  EXPECT_EQ(mesh.folds[0].left, 1u) << "from 0 to 2 runs the second triangle, back the first";
  EXPECT_EQ(mesh.folds[0].right, 0u);
  std::map<std::uint32_t, std::uint32_t> next;
  for (const FoldMesh::Border& b : mesh.borders) next[b.from] = b.to;
  EXPECT_EQ(next, (std::map<std::uint32_t, std::uint32_t>{{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
}

TEST(FoldMesh, FacesTurnedAgainstEachOtherShareNoFold) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> turned = {{0, 1, 2}, {0, 3, 2}};
  const FoldMesh mesh(corners, turned);
  EXPECT_TRUE(mesh.folds.empty());
  EXPECT_EQ(mesh.borders.size(), 6u);
}

TEST(FoldMesh, ThreeFacesAtAnEdgeAreAPairAndABorder) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<Triangle> book = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const FoldMesh mesh(corners, book);
  EXPECT_EQ(mesh.folds.size(), 1u);
  EXPECT_EQ(mesh.borders.size(), 7u);
}

TEST(FoldView, TellsWhatItCannotSee) {
  const FoldMesh gem = folded(test::gem_mesh());
  const Projection camera = perspective(LookAt{}, 40, 0.1, 64, 48);  // at z = 10
  FoldView view;
  const auto at = [&](const Vec3& place, float size = 1) {
    Frame frame;
    frame.basis = Mat3(size), frame.origin = place;
    return view.set(gem, camera, frame);
  };
  EXPECT_EQ(at({0, 0, 0}), FoldView::Result::ready);
  EXPECT_EQ(at({0, 0, 20}), FoldView::Result::nothing) << "behind the camera";
  EXPECT_EQ(at({0, 0, 10}), FoldView::Result::careful) << "the camera stands in it";
  EXPECT_EQ(at({50, 0, 0}), FoldView::Result::nothing) << "beside the image";
  EXPECT_EQ(at({0, -50, 0}), FoldView::Result::nothing);
  EXPECT_EQ(at({0, 0, 0}, INFINITY), FoldView::Result::careful);
  EXPECT_EQ(at({NAN, 0, 0}), FoldView::Result::careful);
}

TEST(FoldView, FacesTurnAsTheyDoInTheImage) {
  const Mesh gem = test::gem_mesh();
  const FoldMesh folds = folded(gem);
  test::Dice dice(3);
  for (int i = 0; i < 200; ++i) {
    LookAt look;
    look.eye = {dice.between(-9, 9), dice.between(-9, 9), dice.between(3, 9)};
    const Projection projection =
        i % 2 == 0 ? perspective(look, 50, 0.1, 300, 200) : orthographic(look, 4, 300, 200);
    Frame frame;
    for (int c = 0; c < 3; ++c) frame.basis[c] = {dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)};
    FoldView view;
    if (view.set(folds, projection, frame) != FoldView::Result::ready) continue;
    for (std::size_t f = 0; f < folds.faces; ++f) {
      glm::dvec2 pixel[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = frame.point(gem.positions[gem.triangles[f][k]]);
        const DVec3 q = projection.point({p.x, p.y, p.z});
        pixel[k] = {q.x / q.z, q.y / q.z};
      }
      const glm::dvec2 a = pixel[1] - pixel[0], b = pixel[2] - pixel[0];
      const double turn = a.x * b.y - a.y * b.x;
      double at = 0;
      for (int k = 0; k < 4; ++k) at += double{folds.plane[k][f]} * double{view.eye[k]};
      if (std::abs(turn) > 1e-2) {
        EXPECT_EQ(turn > 0, at > 0) << i;
      }
    }
  }
}

}  // namespace
}  // namespace espalier
