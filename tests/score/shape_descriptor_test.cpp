// Subdivided D2 against rejection sampling and known distributions; distances; odd surfaces; bounds.
#include "score/shape_descriptor.h"

#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/math.h"
#include "score/reference_descriptor.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using test::Dice;
using test::ReferenceDescriptor;

ShapeDescriptor describe_alone(const Shell& shell, const DescriptorSettings& settings) {
  return describe(shell, Subdivision(bounds(shell), settings.layers), settings, *make_serial_executor());
}

/// Triangles of all sizes, some crossing many voxels, in several placed meshes.
Shell tangle(std::uint32_t number) {
  Dice dice(number);
  Shell shell;
  shell.meshes = {make_primitive(MeshKind::sphere, 1, 0), test::corner_mesh(), make_primitive(MeshKind::box, 1, 0)};
  for (int i = 0; i < 12; ++i) {
    Frame frame;
    for (int c = 0; c < 3; ++c) {
      frame.basis[c] = Vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
      frame.origin[c] = dice.between(-2, 2);
    }
    shell.parts.push_back({frame, dice.below(3)});
  }
  return shell;
}

Shell square(float side, float z) {
  Mesh mesh;
  mesh.positions = {Vec3(0, 0, z), Vec3(side, 0, z), Vec3(side, side, z), Vec3(0, side, z)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return shell_of(mesh);
}

/// The most that the shares up to the bins' ends may differ in two samples of m and n, but once in a million times
/// (Smirnov 1948); bins make it less.
double most_by_chance(double m, double n) { return std::sqrt(0.5 * std::log(2e6) * (m + n) / (m * n)); }

TEST(ShapeDescriptor, AgreesWithRejectionSampling) {
  const Shell shell = tangle(1);
  DescriptorSettings settings;
  settings.layers = 3, settings.pairs = 20000, settings.bins = 20;
  const Subdivision grid(bounds(shell), settings.layers);
  const ShapeDescriptor descriptor = describe_alone(shell, settings);
  ReferenceDescriptor reference(shell, settings.layers, 7);
  const std::size_t count = 400'000;
  const auto points = reference.points(count);
  EXPECT_NEAR(std::accumulate(descriptor.areas.begin(), descriptor.areas.end(), 0.0), reference.area(),
              1e-6 * reference.area());
  std::size_t compared = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double hit = static_cast<double>(points[v].size()), share = descriptor.areas[v] / reference.area();
    EXPECT_NEAR(hit / count, share, 5.5 * std::sqrt(share / count) + 1e-9) << "area of voxel " << v;
    const std::size_t pairs = points[v].size() / 2;
    if (pairs < 500) continue;
    ++compared;
    std::vector<double> counts(settings.bins, 0.0);
    for (std::size_t i = 0; i < pairs; ++i) {
      double squares = 0;
      for (std::size_t k = 0; k < 3; ++k) squares += std::pow(points[v][2 * i][k] - points[v][2 * i + 1][k], 2);
      ++counts[static_cast<std::size_t>(std::sqrt(squares) / grid.diagonal() * settings.bins)];
    }
    double share_here = 0, share_there = 0, most = 0;
    for (std::size_t bin = 0; bin < settings.bins; ++bin) {
      share_here += static_cast<double>(descriptor.counts[v * settings.bins + bin]) / settings.pairs;
      share_there += counts[bin] / static_cast<double>(pairs);
      most = std::max(most, std::fabs(share_here - share_there));
    }
    EXPECT_LT(most, most_by_chance(settings.pairs, static_cast<double>(pairs))) << "distances in voxel " << v;
  }
  EXPECT_GT(compared, 10u);
}

// The test above can tell: the bound is far below what another distribution makes.
TEST(ShapeDescriptor, TellsUnevenPointsApart) {
  Shell shell = square(1, 0);
  DescriptorSettings settings;
  settings.layers = 1, settings.pairs = 20000, settings.bins = 20;
  const ShapeDescriptor even = describe_alone(shell, settings);
  // The same square in four strips, one of them counted three times: its area draws three times the points.
  Shell uneven = shell;
  Frame strip;
  strip.basis[0] = Vec3(0.25f, 0, 0);
  uneven.parts.push_back({strip, 0});
  uneven.parts.push_back({strip, 0});
  const std::vector<double> distances = voxel_distances(even, describe_alone(uneven, settings));
  EXPECT_GT(distances[0], most_by_chance(20000, 20000));
}

// Distances of two points in a unit square: P(d <= x) = pi x^2 - 8/3 x^3 + x^4 / 2 for x <= 1 (Philip 1991).
TEST(ShapeDescriptor, KnowsTheSquare) {
  DescriptorSettings settings;
  settings.layers = 1, settings.pairs = 100'000, settings.bins = 15, settings.range = 1.5;
  for (const float z : {0.0f, -3.0f}) {
    const ShapeDescriptor descriptor = describe_alone(square(1, z), settings);
    double share = 0;
    for (std::size_t bin = 0; bin < 10; ++bin) {
      share += descriptor.counts[bin] / 1e5;
      const double x = static_cast<double>(bin + 1) / 10;
      const double known = kPi * x * x - 8.0 / 3 * x * x * x + x * x * x * x / 2;
      EXPECT_NEAR(share, known, 5 * std::sqrt(known * (1 - known) / 1e5)) << x;
    }
    EXPECT_NEAR(share, 0.9749, 0.003);
    EXPECT_DOUBLE_EQ(descriptor.areas[0], 1);
  }
}

TEST(ShapeDescriptor, SizeAndPlaceDoNotCountByDefault) {
  const Shell shell = tangle(2);
  DescriptorSettings settings;
  const ShapeDescriptor small = describe_alone(shell, settings);
  for (const float factor : {8.0f, 1.0f / 1024}) {
    Shell scaled = shell;
    for (ShellPart& part : scaled.parts)
      part.model_from_mesh.basis *= factor, part.model_from_mesh.origin *= factor;
    EXPECT_EQ(describe_alone(scaled, settings).counts, small.counts);
  }
  settings.range = 1.5;
  const ShapeDescriptor published = describe_alone(shell, settings);
  Shell large = shell;
  for (ShellPart& part : large.parts) part.model_from_mesh.basis *= 8.0f, part.model_from_mesh.origin *= 8.0f;
  EXPECT_NE(describe_alone(large, settings).counts, published.counts);
}

TEST(ShapeDescriptor, EveryVoxelWithSurfaceHasAllItsPairs) {
  DescriptorSettings settings;
  settings.layers = 5;
  settings.range = 0.01;  // nearly all distances are longer: they are in the last bin
  const ShapeDescriptor descriptor = describe_alone(tangle(3), settings);
  std::size_t occupied = 0, last = 0;
  for (std::size_t v = 0; v < 125; ++v) {
    const auto begin = descriptor.counts.begin() + static_cast<std::ptrdiff_t>(v * 10);
    const std::uint32_t sum = std::accumulate(begin, begin + 10, 0u);
    EXPECT_EQ(sum, descriptor.areas[v] > 0 ? 30u : 0u);
    occupied += sum > 0;
    last += *(begin + 9);
  }
  EXPECT_GT(occupied, 40u);
  EXPECT_LT(occupied, 125u);
  EXPECT_GT(last, 29 * occupied);
}

TEST(ShapeDescriptor, TheSameBytesForAnyNumberOfThreads) {
  const Shell shell = tangle(4);
  for (const std::uint32_t layers : {1u, 4u, 7u}) {
    DescriptorSettings settings;
    settings.layers = layers, settings.pairs = 200;
    const Subdivision grid(bounds(shell), layers);
    const ShapeDescriptor serial = describe(shell, grid, settings, *make_serial_executor());
    for (const int threads : {2, 3, 16})
      EXPECT_EQ(describe(shell, grid, settings, *make_thread_executor(threads)), serial) << threads;
    EXPECT_EQ(describe(shell, grid, settings, *make_tbb_executor(2)), serial);
    settings.draw = 1;
    EXPECT_NE(describe(shell, grid, settings, *make_serial_executor()).counts, serial.counts);
    settings.draw = 0, settings.seed = 2;
    EXPECT_NE(describe(shell, grid, settings, *make_serial_executor()).counts, serial.counts);
  }
}

TEST(ShapeDescriptor, AVoxelDoesNotDependOnTheOthers) {
  Shell shell = tangle(5);
  const Subdivision grid(bounds(shell), 4);
  const ShapeDescriptor before = describe(shell, grid, {}, *make_serial_executor());
  Frame speck;  // in the middle of one voxel
  for (int i = 0; i < 3; ++i) {
    speck.basis[i] *= 1e-3f;
    speck.origin[i] = static_cast<float>(0.5 * (grid.plane(i, 1) + grid.plane(i, 2)));
  }
  shell.parts.push_back({speck, 2});
  const ShapeDescriptor after = describe(shell, grid, {}, *make_serial_executor());
  for (std::size_t v = 0; v < 64; ++v) {
    EXPECT_EQ(after.areas[v] == before.areas[v], v != grid.index(1, 1, 1));
    if (v == grid.index(1, 1, 1)) continue;
    for (std::size_t i = v * 10; i < v * 10 + 10; ++i) EXPECT_EQ(after.counts[i], before.counts[i]);
  }
}

TEST(VoxelDistances, AreSymmetricAndZeroToThemselves) {
  const ShapeDescriptor a = describe_alone(tangle(6), {}), b = describe_alone(tangle(7), {});
  EXPECT_THAT(voxel_distances(a, a), Each(0.0));
  EXPECT_EQ(voxel_distances(a, b), voxel_distances(b, a));
  double most = 0;
  for (const double d : voxel_distances(a, b)) {
    EXPECT_TRUE(d >= 0 && d <= 1);
    EXPECT_DOUBLE_EQ(d * 30, std::round(d * 30));
    most = std::max(most, d);
  }
  EXPECT_EQ(most, 1) << "a voxel that only one occupies";
}

TEST(VoxelDistances, KnownHistograms) {
  ShapeDescriptor a{1, 10, 3, {5, 5, 0}, {1.0}}, b{1, 10, 3, {2, 1, 7}, {1.0}}, none{1, 10, 3, {0, 0, 0}, {0.0}};
  EXPECT_THAT(voxel_distances(a, b), ::testing::ElementsAre(0.7));  // shares .5 1 1 and .2 .3 1
  EXPECT_THAT(voxel_distances(b, a), ::testing::ElementsAre(0.7));
  EXPECT_THAT(voxel_distances(a, none), ::testing::ElementsAre(1.0));
  EXPECT_THAT(voxel_distances(none, b), ::testing::ElementsAre(1.0));
  EXPECT_THAT(voxel_distances(none, none), ::testing::ElementsAre(0.0));
}

TEST(VoxelDistances, NoiseShrinksWithThePairs) {
  const Shell shell = tangle(8);
  double before = 1;
  for (const std::uint32_t pairs : {30u, 300u, 3000u}) {
    DescriptorSettings first, second;
    first.pairs = second.pairs = pairs, second.draw = 1;
    const std::vector<double> d = voxel_distances(describe_alone(shell, first), describe_alone(shell, second));
    const double mean = std::accumulate(d.begin(), d.end(), 0.0) / 64;
    EXPECT_GT(mean, 0);
    EXPECT_LT(mean, 0.5 * before) << "about a third, for ten times the pairs";
    before = mean;
  }
  EXPECT_LT(before, 0.03);
}

TEST(ShapeDescriptor, EmptyAndDegenerateShellsAreEmptyHistograms) {
  Mesh mesh;
  mesh.positions = {Vec3(0), Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(1e6f)};
  mesh.triangles = {{0, 0, 1}, {0, 1, 2}, {3, 3, 3}};
  for (const Shell& shell : {Shell(), shell_of(Mesh()), shell_of(mesh)}) {
    EXPECT_TRUE(bounds(shell).empty());
    const ShapeDescriptor descriptor = describe_alone(shell, {});
    EXPECT_THAT(descriptor.counts, Each(0u));
    EXPECT_THAT(descriptor.areas, Each(0.0));
    EXPECT_THAT(voxel_distances(descriptor, describe_alone(Shell(), {})), Each(0.0));
  }
}

TEST(ShapeDescriptor, TrianglesWithoutAreaChangeNothing) {
  const Shell shell = tangle(9);
  Shell more = shell;
  Mesh& mesh = more.meshes[more.parts[0].mesh];
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const float x : {0.0f, 100.0f, 300.0f}) mesh.positions.push_back(Vec3(x, 0.1f * x, 0.7f * x));
  mesh.triangles.insert(mesh.triangles.begin(), {first, first + 1, first + 2});
  EXPECT_EQ(describe_alone(more, {}), describe_alone(shell, {}));
}

TEST(ShapeDescriptor, FlatModelsLieInOneLayer) {
  const ShapeDescriptor flat = describe_alone(square(4, 1), {});
  for (std::size_t v = 0; v < 64; ++v) EXPECT_NEAR(flat.areas[v], v / 16 == 2 ? 1 : 0, 0.003);
  std::set<std::vector<std::uint32_t>> different;  // all hold the same square, but each has points of its own
  for (auto row = flat.counts.begin() + 32 * 10; row < flat.counts.begin() + 48 * 10; row += 10)
    different.emplace(row, row + 10);
  EXPECT_GT(different.size(), 12u);
  // A plane that an exporter left a little rough is the same to within chance.
  Shell rough = square(4, 1);
  rough.meshes[0].positions[2].z = 1.000001f;
  EXPECT_EQ(describe_alone(rough, {}).areas[40] > 0, flat.areas[40] > 0);
  EXPECT_THAT(voxel_distances(flat, describe_alone(rough, {})), Each(::testing::Le(1.0 / 30)));
}

TEST(ShapeDescriptor, HugeTinyAndFarAwayShellsHaveAllTheirArea) {
  for (const float size : {1e-20f, 1e-3f, 1e9f, 1e17f}) {
    Shell shell = tangle(10);
    for (ShellPart& part : shell.parts)
      part.model_from_mesh.basis *= size, part.model_from_mesh.origin *= size;
    const ShapeDescriptor descriptor = describe_alone(shell, {});
    double expected = 0;
    for_each_triangle(shell, [&](const DVec3& a, const DVec3& b, const DVec3& c) { expected += area(a, b, c); });
    EXPECT_NEAR(std::accumulate(descriptor.areas.begin(), descriptor.areas.end(), 0.0) / expected, 1, 1e-9) << size;
    EXPECT_LT(voxel_distances(descriptor, describe_alone(tangle(10), {}))[0], 0.5);
  }
}

// One triangle may be far larger than all the others.
TEST(ShapeDescriptor, AHugeTriangleTakesItsShare) {
  Shell shell = tangle(11);
  Mesh mesh;
  mesh.positions = {Vec3(-1e6f, -1e6f, 0), Vec3(1e6f, -1e6f, 3), Vec3(0, 1e6f, 1)};
  mesh.triangles = {{0, 1, 2}};
  shell.meshes.push_back(mesh);
  shell.parts.push_back({{}, 3});
  const ShapeDescriptor with = describe_alone(shell, {});
  const ShapeDescriptor alone = describe_alone(shell_of(mesh), {});
  for (std::uint32_t column = 0; column < 16; ++column) {
    double there = 0, here = 0;
    for (std::uint32_t v = column; v < 64; v += 16) there += with.areas[v], here += alone.areas[v];
    EXPECT_NEAR(there, here, 2e-3 * 4e12 / 16);
  }
}

// As fine as files come; nothing is kept per triangle, and the test would take minutes if voxels were searched.
TEST(ShapeDescriptor, AMillionTriangles) {
  Mesh mesh;
  const std::uint32_t side = 708;
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / side, v = static_cast<float>(y) / side;
      mesh.positions.push_back(Vec3(u, sine(9 * u) * cosine(7 * v), v));
    }
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t i = x + (side + 1) * y;
      mesh.triangles.push_back({i, i + 1, i + side + 1});
      mesh.triangles.push_back({i + 1, i + side + 2, i + side + 1});
    }
  }
  ASSERT_GT(mesh.triangles.size(), 1'000'000u);
  const Shell shell = shell_of(std::move(mesh));
  const ShapeDescriptor fine = describe_alone(shell, {});
  EXPECT_GT(std::count_if(fine.areas.begin(), fine.areas.end(), [](double area) { return area > 0; }), 30);
}

TEST(ShapeDescriptor, RefusesTooManyPieces) {
  const Shell shell = tangle(12);
  DescriptorSettings settings;
  const auto refused = [&](std::uint64_t most, int threads) {
    settings.most_pieces = most;
    try {
      describe(shell, Subdivision(bounds(shell), settings.layers), settings, *make_thread_executor(threads));
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  std::uint64_t pieces = 0;  // by bisection: all of them together count, whatever the threads
  for (std::uint64_t bit = 1u << 20; bit > 0; bit /= 2) {
    if (!refused(pieces + bit - 1, 1).empty()) pieces += bit;
  }
  EXPECT_GT(pieces, triangle_count(shell));
  for (const int threads : {1, 2, 4}) {
    EXPECT_EQ(refused(pieces, threads), "");
    EXPECT_THAT(refused(pieces - 1, threads), HasSubstr(fmt::format("at most {} pieces, got more", pieces - 1)));
  }
}

TEST(ShapeDescriptor, RefusesWhatIsOutOfRange) {
  const auto message = [](auto change) -> std::string {
    DescriptorSettings settings;
    change(settings);
    try {
      validate(settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  using S = DescriptorSettings;
  EXPECT_EQ(message([](S&) {}), "");
  EXPECT_EQ(message([](S& s) { s.layers = 0; }), "grid must be from 1 to 16, got 0");
  EXPECT_EQ(message([](S& s) { s.layers = 17; }), "grid must be from 1 to 16, got 17");
  EXPECT_EQ(message([](S& s) { s.pairs = 0; }), "pairs must be from 1 to 100000, got 0");
  EXPECT_EQ(message([](S& s) { s.bins = 1; }), "bins must be from 2 to 100, got 1");
  EXPECT_THAT(message([](S& s) { s.layers = 16, s.pairs = 3000; }), HasSubstr("at most 8388608, got 4096 x 3000"));
  EXPECT_EQ(message([](S& s) { s.layers = 16, s.pairs = 2048; }), "");
  for (const double range : {0.0, -1.0, 1e-310, 1e10, std::nan(""), HUGE_VAL})
    EXPECT_THAT(message([&](S& s) { s.range = range; }), HasSubstr("range must be from 1e-09 to 1000000000 m, got "));
}

}  // namespace
}  // namespace espalier
