#include "score/silhouette_kernel.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "score/reference_silhouette.h"
#include "score/volume_kernel.h"
#include "score_models.h"

namespace espalier {
namespace {

using namespace test;

/// One mesh of every kind, and two files: a gem (convex) and an L (not convex).
class Shapes final : public MeshSource {
 public:
  Shapes() {
    for (const MeshKind kind : {MeshKind::box, MeshKind::cylinder, MeshKind::cone, MeshKind::sphere, MeshKind::wedge,
                                MeshKind::pyramid, MeshKind::quad, MeshKind::leaf})
      graph.meshes.emplace_back().kind = kind;
    MeshRef& prism = graph.meshes.emplace_back();
    prism.kind = MeshKind::cone, prism.sides = 5;
    for (const char* path : {"gem", "corner"}) {
      MeshRef& file = graph.meshes.emplace_back();
      file.kind = MeshKind::file, file.path = path;
    }
    meshes = MeshTable(graph, "", *this);
    casters = make_casters(meshes);
  }
  Mesh load(const std::string& path) override { return path == "gem" ? gem_mesh() : corner_mesh(); }

  GeneratorGraph graph;
  MeshTable meshes;
  std::vector<Caster> casters;
};

Frame random_frame(Dice& dice, float around, float least, float most) {
  Frame frame;
  for (int c = 0; c < 3; ++c) {
    Vec3 axis(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    frame.basis[c] = axis * (dice.between(least, most) / std::max(0.1f, glm::length(axis)));
    frame.origin[c] = dice.between(-around, around);
  }
  return frame;
}

std::vector<Instance> random_parts(Dice& dice, const Shapes& shapes, int count, float around) {
  std::vector<Instance> parts;
  for (int i = 0; i < count; ++i) {
    const auto mesh = static_cast<std::uint16_t>(dice.below(static_cast<std::uint32_t>(shapes.casters.size())));
    parts.push_back(part(mesh, random_frame(dice, around, 0.05f, 1.5f), dice.between(0, 1.6f)));
    if (dice.chance(0.2)) parts.back().top = 0;
  }
  return parts;
}

Projection random_projection(Dice& dice, std::uint32_t width, std::uint32_t height) {
  LookAt look;
  look.eye = {dice.between(-8, 8), dice.between(-8, 8), dice.between(4, 9)};
  look.at = {dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)};
  switch (dice.below(4)) {
    case 0: return orthographic(look, dice.between(3, 8), width, height);
    case 1: {
      ShadowScreen screen;
      screen.tall = dice.between(4, 9), screen.centre = {0, -2, 0};
      return sun_shadow({dice.between(-1, 1), -1, dice.between(-1, 1)}, screen, width, height);
    }
    case 2: {
      ShadowScreen screen;
      screen.tall = dice.between(6, 14), screen.centre = {0, -3, 0};
      return lamp_shadow({dice.between(-1, 1), dice.between(5, 8), dice.between(-1, 1)}, screen, width, height);
    }
    default: return perspective(look, dice.between(20, 80), 0.5, width, height);
  }
}

WeightImage striped(std::uint32_t width, std::uint32_t height, bool graded) {
  WeightImage image{width, height, {}};
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const int band = static_cast<int>((column / 7 + row / 5) % 3) - 1;
      image.degrees.push_back(band *
                              (graded ? static_cast<std::int32_t>(1 + (column * 31 + row * 17) % 65535) : 65535));
    }
  }
  return image;
}

/// How far (in pixels, squared over a small ring) the reference is from changing at this pixel: whether some ray within
/// `reach` of its middle sees the other answer.
bool near_an_edge(const Projection& projection, const std::vector<Caster>& casters, std::span<const Instance> parts,
                  std::uint32_t column, std::uint32_t row, bool covered, double reach) {
  for (int k = 0; k < 16; ++k) {
    const double angle = k * 0.3926990816987242;
    const PixelRay ray =
        ray_through(projection, column + 0.5 + reach * std::cos(angle), row + 0.5 + reach * std::sin(angle));
    bool hit = false;
    for (const Instance& p : parts) hit = hit || meets(casters[p.mesh], p, ray);
    if (hit != covered) return true;
  }
  return false;
}

struct Differences {
  std::uint64_t pixels = 0, different = 0;
};

void compare(const Shapes& shapes, const Projection& projection, std::span<const Instance> parts, Differences& sum) {
  const WeightImage image = striped(projection.width, projection.height, sum.pixels % 2 == 0);
  const SilhouetteKernel kernel(projection, shapes.casters, image);
  SilhouetteScratch scratch(projection);
  kernel.draw(parts, VolumeView::full, scratch);
  const PixelCanvas fast = scratch.canvas;
  const PixelCanvas slow = reference_silhouette(projection, shapes.casters, parts, VolumeView::full);
  EXPECT_EQ(kernel.sweep(scratch), reference_counts(fast, image));
  for (const std::uint32_t word : scratch.canvas.words) ASSERT_EQ(word, 0u) << "the sweep clears the canvas";
  for (std::uint32_t row = 0; row < projection.height; ++row) {
    for (std::uint32_t column = 0; column < projection.width; ++column) {
      ++sum.pixels;
      if (fast.get(column, row) == slow.get(column, row)) continue;
      ++sum.different;
      ASSERT_TRUE(near_an_edge(projection, shapes.casters, parts, column, row, slow.get(column, row), 1e-3))
          << "pixel " << column << ", " << row;
    }
  }
}

TEST(SilhouetteKernel, AgreesWithTheReferenceOnRandomModels) {
  const Shapes shapes;
  Differences sum;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Dice dice(i);
    const Projection projection = random_projection(dice, 97 + dice.below(64), 50 + dice.below(60));
    compare(shapes, projection, random_parts(dice, shapes, 1 + static_cast<int>(dice.below(12)), 2.5f), sum);
    ASSERT_FALSE(HasFatalFailure()) << "model " << i;
  }
  EXPECT_GT(sum.pixels, 5'000'000u);
  EXPECT_LE(sum.different, sum.pixels / 1'000'000) << "of " << sum.pixels;
}

TEST(SilhouetteKernel, CutsWhatStandsAcrossTheNearestPlane) {
  const Shapes shapes;
  Differences sum;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Dice dice(5000 + i);
    LookAt look;
    look.eye = {dice.between(-1, 1), dice.between(-1, 1), 2}, look.at = {0, 0, 0};
    const Projection projection = perspective(look, dice.between(30, 100), dice.between(0.2f, 1.5f), 80, 70);
    compare(shapes, projection, random_parts(dice, shapes, 1 + static_cast<int>(dice.below(3)), 2), sum);
    ASSERT_FALSE(HasFatalFailure()) << "model " << i;
  }
  EXPECT_LE(sum.different, 1 + sum.pixels / 1'000'000) << "of " << sum.pixels;
}

TEST(SilhouetteKernel, DrawsFlatAndEdgeOnParts) {
  const Shapes shapes;
  LookAt look;
  const Projection projection = perspective(look, 40, 0.1, 64, 64);
  const SilhouetteKernel kernel(projection, shapes.casters, striped(64, 64, false));
  SilhouetteScratch scratch(projection);
  const auto covered = [&](std::uint16_t mesh, Vec3 x, Vec3 y, Vec3 z) {
    Frame frame;
    frame.basis[0] = x, frame.basis[1] = y, frame.basis[2] = z;
    const Instance one = part(mesh, frame);
    return kernel.count(std::span(&one, 1), VolumeView::full, scratch).covered;
  };
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), none(0);
  EXPECT_GT(covered(0, x, y, none), 100u) << "a box without depth is a sheet";
  EXPECT_GT(covered(1, x, y, none), 50u) << "so is a cylinder";
  EXPECT_GT(covered(3, x, y, none), 50u) << "and a sphere a disc";
  EXPECT_EQ(covered(0, none, y, z), 0u) << "a sheet seen edge-on covers nothing";
  EXPECT_EQ(covered(6, none, y, z), 0u);
  EXPECT_EQ(covered(0, none, none, none), 0u);
  const float inf = INFINITY;
  EXPECT_EQ(covered(0, Vec3(inf), y, z), 0u);
  EXPECT_EQ(covered(3, Vec3(NAN), y, z), 0u);
}

TEST(SilhouetteKernel, EveryPathGivesTheSameCounts) {
  const Shapes shapes;
  for (std::uint32_t i = 0; i < 40; ++i) {
    Dice dice(9 + i);
    const Projection projection = random_projection(dice, 200, 150);
    const std::vector<Instance> parts = random_parts(dice, shapes, 60, i % 2 == 0 ? 2.5f : 6);
    const SilhouetteKernel kernel(projection, shapes.casters, striped(200, 150, i % 4 < 2));
    SilhouetteScratch scratch(projection);
    std::vector<SilhouetteCounts> counts;
    std::vector<TileVector<std::uint32_t>> pictures;
    for (const std::string& path : kernel_paths()) {
      use_kernel_path(path);
      kernel.draw(parts, VolumeView::full, scratch);
      pictures.push_back(scratch.canvas.words);
      counts.push_back(kernel.sweep(scratch));
    }
    use_kernel_path("");
    ASSERT_GE(counts.size(), 2u);
    for (const SilhouetteCounts& other : counts) EXPECT_EQ(other, counts[0]);
    for (const auto& other : pictures) EXPECT_EQ(other, pictures[0]);
    EXPECT_GT(counts[0].wanted_sum, 0u);
  }
}

TEST(SilhouetteKernel, TheOrderOfPartsDoesNotMatter) {
  const Shapes shapes;
  Dice dice(77);
  const Projection projection = random_projection(dice, 160, 120);
  std::vector<Instance> parts = random_parts(dice, shapes, 101, 2.5f);
  const SilhouetteKernel kernel(projection, shapes.casters, striped(160, 120, true));
  SilhouetteScratch scratch(projection);
  kernel.draw(parts, VolumeView::full, scratch);
  const auto forwards = scratch.canvas.words;
  kernel.sweep(scratch);
  std::reverse(parts.begin(), parts.end());
  kernel.draw(parts, VolumeView::full, scratch);
  EXPECT_EQ(scratch.canvas.words, forwards);
}

TEST(SilhouetteKernel, SmallPartsAgreeWithTheReference) {
  const Shapes shapes;
  Differences sum;
  for (std::uint32_t i = 0; i < 60; ++i) {  // of a pixel or a few
    Dice dice(7000 + i);
    const Projection projection = random_projection(dice, 120, 90);
    std::vector<Instance> parts = random_parts(dice, shapes, 60, 2.5f);
    for (Instance& p : parts) p.model_from_mesh.basis *= dice.between(0.01f, 0.3f);
    compare(shapes, projection, parts, sum);
    ASSERT_FALSE(HasFatalFailure()) << "model " << i;
  }
  EXPECT_LE(sum.different, 1u) << "of " << sum.pixels;
}

TEST(SilhouetteKernel, HugePartsAgreeWithTheReference) {
  const Shapes shapes;
  Differences sum;
  for (std::uint32_t i = 0; i < 80; ++i) {  // most reach beyond the image, some by far; flat ones too
    Dice dice(8000 + i);
    LookAt look;
    look.eye = {dice.between(-3, 3), dice.between(-3, 3), 30};
    const Projection projection = i % 2 == 0 ? perspective(look, 15, 0.5, 150, 130) : orthographic(look, 4, 150, 130);
    std::vector<Instance> parts = random_parts(dice, shapes, 3, 6);
    for (Instance& p : parts) {
      p.model_from_mesh.basis *= i % 3 == 0 ? dice.between(10, 40) : dice.between(1, 10);
      if (dice.chance(0.3)) p.model_from_mesh.basis[dice.below(3)] *= 1e-3f;
    }
    compare(shapes, projection, parts, sum);
    ASSERT_FALSE(HasFatalFailure()) << "model " << i;
  }
  EXPECT_LE(sum.different, 2u) << "of " << sum.pixels;
}

/// Thin parts, balls as discs, cones as needles or wider above, and mirrored ones. (Round parts without any depth have
/// no inverse, which the reference needs.)
TEST(SilhouetteKernel, ThinAndMirroredPartsAgreeWithTheReference) {
  const Shapes shapes;
  Differences sum;
  for (std::uint32_t i = 0; i < 100; ++i) {
    Dice dice(9000 + i);
    const Projection projection = random_projection(dice, 110, 100);
    std::vector<Instance> parts = random_parts(dice, shapes, 10, 2.5f);
    for (Instance& p : parts) {
      Vec3& axis = p.model_from_mesh.basis[dice.below(3)];
      const Caster::Kind kind = shapes.casters[p.mesh].kind;
      const bool round = kind == Caster::Kind::sphere || kind == Caster::Kind::round;
      axis *= dice.chance(0.5) ? -1 : round || dice.chance(0.5) ? 1e-3f : 0;
      if (dice.chance(0.2)) p.top = dice.chance(0.5) ? 12 : -1;
    }
    compare(shapes, projection, parts, sum);
    ASSERT_FALSE(HasFatalFailure()) << "model " << i;
  }
  EXPECT_LE(sum.different, 2u) << "of " << sum.pixels;
}

TEST(SilhouetteKernel, ViewsShowTheirLayers) {
  const Shapes shapes;
  const Projection projection = orthographic(LookAt{}, 4, 32, 32);
  const SilhouetteKernel kernel(projection, shapes.casters, striped(32, 32, false));
  SilhouetteScratch scratch(projection);
  std::vector<Instance> parts = {part(0, Frame{})};
  for (const auto& [layer, in_parts_view, in_full_view] :
       {std::tuple(Layer::rule, true, true), std::tuple(Layer::proxy, true, false),
        std::tuple(Layer::detail, false, true)}) {
    parts[0].layer = layer;
    EXPECT_EQ(kernel.count(parts, VolumeView::parts, scratch).covered > 0, in_parts_view);
    EXPECT_EQ(kernel.count(parts, VolumeView::full, scratch).covered > 0, in_full_view);
  }
}

}  // namespace
}  // namespace espalier
