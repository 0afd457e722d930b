#include "render/line_drawing.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "grammar/surface_arguments.h"
#include "render/test_scenes.h"

namespace espalier {
namespace {

constexpr Colour kRed{{200, 10, 10}}, kBlue{{10, 10, 200}};

TEST(LineDrawing, WiresRunThroughTheirPointsInTheirInks) {
  LineDrawing drawing = start_drawing({kRed, kBlue});
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}};
  const std::vector<std::uint16_t> inks = {0, 1};
  draw_wire(drawing, points, inks, 0.1f);
  // A ball, two pieces with a joint each, an arrowhead.
  ASSERT_EQ(drawing.model.instances.size(), 6u);
  EXPECT_EQ(drawing.model.instances.front().material, 0);
  EXPECT_EQ(drawing.model.instances.back().material, 1);
  EXPECT_NEAR(drawing.surfaces.material(0).color.x, linear_light(200), 1e-6);
  EXPECT_NEAR(drawing.surfaces.material(1).color.z, linear_light(200), 1e-6);
  const Bounds box = bounds(drawing.model, drawing.meshes, true);
  EXPECT_LT(box.min.x, -0.1f) << "a ball at the beginning, thicker than the wire";
  EXPECT_GT(box.max.x, 2.1f) << "an arrowhead, wider than the wire";
  EXPECT_GT(box.max.y, 3.1f) << "whose tip is beyond the end";
  EXPECT_LT(box.max.y, 4);
  for (const Instance& i : drawing.model.instances) EXPECT_GT(glm::determinant(i.model_from_mesh.basis), 0);
}

TEST(LineDrawing, PiecesWithoutLengthAreLeftOut) {
  LineDrawing drawing = start_drawing({kRed});
  const std::vector<Vec3> points = {{1, 1, 1}, {1, 1, 1}, {1, 2, 1}, {1, 2, 1}};
  const std::vector<std::uint16_t> inks = {0, 0, 0};
  draw_wire(drawing, points, inks, 0.1f);
  EXPECT_EQ(drawing.model.instances.size(), 4u) << "ball, piece, joint, arrowhead";
  LineDrawing point = start_drawing({kRed});
  draw_wire(point, std::vector<Vec3>(3, Vec3(4)), std::vector<std::uint16_t>(2, 0), 0.1f);
  EXPECT_EQ(point.model.instances.size(), 1u) << "a curve that is a point is a ball";
}

TEST(LineDrawing, BonesAreNoThickerThanAsked) {
  LineDrawing drawing = start_drawing({kRed});
  draw_bone(drawing, {{0, 0, 0}, {0, 10, 0}, -1, 5}, 0.2f, 0);
  ASSERT_EQ(drawing.model.instances.size(), 2u);
  EXPECT_EQ(drawing.model.instances[0].gene, 5u);
  const Bounds box = bounds(drawing.model, drawing.meshes, true);
  EXPECT_NEAR(box.size().y, 10, 1e-4);
  EXPECT_LT(box.size().x, 0.3f);
  EXPECT_GT(box.size().x, 0.1f);
  draw_bone(drawing, {{1, 1, 1}, {1, 1, 1}, -1, 0}, 0.2f, 0);
  EXPECT_EQ(drawing.model.instances.size(), 2u);
}

}  // namespace
}  // namespace espalier
