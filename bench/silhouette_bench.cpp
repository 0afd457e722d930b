// Silhouettes. Must: 3000 parts (cones and leaves of a tree) on 512 x 512 in 350 us, a tree of 250 genes with convex
// foliage on 800 x 600 in 150 us, small triangles of meshes at 40 ns each.
// (A budget of 300 000 trees on two cores in 60 s is 400 us each, with leaves of 574 triangles in 300 s 2 ms.)

#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "model/primitives.h"
#include "score/reference_silhouette.h"
#include "score/silhouette_kernel.h"

namespace espalier {
namespace {

enum Shape : std::uint16_t { kBox, kCone, kSphere, kGem, kTriangles, kLeaf };

/// A curved leaf of two sides: 576 triangles.
Mesh leaf() {
  Mesh mesh;
  for (const int side : {1, -1}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= 12; ++j)
      for (int i = 0; i <= 12; ++i) {
        const double v = j / 12.0, u = (i / 6.0 - 1) * (0.05 + 1.6 * v * (1 - v));
        const double bend = 0.3 * v * v - 0.2 * std::abs(u), thick = i % 12 == 0 || j % 12 == 0 ? 0 : 0.01;
        mesh.positions.push_back(Vec3(glm::dvec3(u, v - 0.5, bend + side * thick)));
      }
    const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(13 * j + i); };
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i)
        for (Triangle t : {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                           Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
          if (side < 0) std::swap(t[0], t[1]);
          mesh.triangles.push_back(t);
        }
  }
  return mesh;
}

/// A ball of facets, convex or as loose triangles, and the leaf.
class Files final : public MeshSource {
 public:
  Mesh load(const std::string& path) override {
    if (path == "leaf") return leaf();
    Mesh ball = make_primitive(MeshKind::sphere, 1, 0);
    if (path == "triangles") ball.triangles.pop_back();  // open: neither closed nor flat
    return ball;
  }
};

struct Setting {
  MeshTable meshes;
  std::vector<Caster> casters;

  Setting() {
    GeneratorGraph graph;
    for (const MeshKind kind : {MeshKind::box, MeshKind::cone, MeshKind::sphere})
      graph.meshes.emplace_back().kind = kind;
    graph.meshes[1].sides = 16;
    for (const char* path : {"gem", "triangles", "leaf"}) {
      graph.meshes.emplace_back().kind = MeshKind::file;
      graph.meshes.back().path = path;
    }
    Files files;
    meshes = MeshTable(graph, "", files);
    casters = make_casters(meshes);
    CHECK(casters[kTriangles].kind == Caster::Kind::triangles && casters[kLeaf].kind == Caster::Kind::triangles);
  }
};

Mat3 random_rotation(RandomStream& random) {
  float q[4], square;
  do {
    square = 0;
    for (float& v : q) v = static_cast<float>(2 * random.next_unit() - 1), square += v * v;
  } while (square > 1 || square < 0.01f);
  const float w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / square;
  return Mat3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y), s * (x * y - w * z),
              1 - s * (x * x + z * z), s * (y * z + w * x), s * (x * z + w * y), s * (y * z - w * x),
              1 - s * (x * x + y * y));
}

/// Parts of a few metres' crown: branches 8 times as long as they are thick, or balls.
std::vector<Instance> crown(int count, Shape shape, float size, std::uint32_t seed) {
  RandomStream random({seed, Purpose::test});
  std::vector<Instance> parts;
  for (int i = 0; i < count; ++i) {
    Instance& one = parts.emplace_back();
    const float k = size * (0.5f + static_cast<float>(random.next_unit()));
    Mat3 m = random_rotation(random);
    const float thick = shape == kCone || shape == kBox ? 0.125f : 1;
    m[0] *= k * thick, m[1] *= k, m[2] *= k * thick;
    one.model_from_mesh.basis = m;
    for (int c = 0; c < 3; ++c)
      one.model_from_mesh.origin[c] = static_cast<float>(4 * random.next_unit() - 2);
    one.mesh = shape;
    one.top = 0.58f;
  }
  return parts;
}

WeightImage heart(std::uint32_t width, std::uint32_t height, bool graded) {
  WeightImage image{width, height, {}};
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const double x = (column - 0.5 * width) / (0.4 * height), y = (row - 0.5 * height) / (0.4 * height);
      const double r = x * x + y * y;
      image.degrees.push_back(r < 1 ? (graded ? 65535 - static_cast<std::int32_t>(30000 * r) : 65535) : -65535);
    }
  return image;
}

void silhouette(benchmark::State& state, std::uint32_t width, std::uint32_t height, std::vector<Instance> parts,
                bool graded) {
  const Setting setting;
  LookAt look;
  look.eye = {0, 1, 7};
  const Projection projection = perspective(look, 45, 0.1, width, height);
  const SilhouetteKernel kernel(projection, setting.casters, heart(width, height, graded));
  SilhouetteScratch scratch(projection);
  SilhouetteCounts counts;
  for (auto _ : state) {
    counts = kernel.count(parts, VolumeView::full, scratch);
    benchmark::DoNotOptimize(counts);
  }
  state.counters["covered"] = static_cast<double>(counts.covered);
  state.counters["s_per_part"] = benchmark::Counter(
      static_cast<double>(parts.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

std::vector<Instance> joined(std::vector<Instance> a, const std::vector<Instance>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

BENCHMARK_CAPTURE(silhouette, cones_3000, 512, 512, crown(3000, kCone, 0.35f, 1), false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(silhouette, cones_3000_graded, 512, 512, crown(3000, kCone, 0.35f, 1), true)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(silhouette, boxes_3000, 512, 512, crown(3000, kBox, 0.35f, 2), false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(silhouette, tree_250, 800, 600, joined(crown(250, kCone, 0.6f, 3), crown(160, kSphere, 0.5f, 4)),
                  false)
    ->Unit(benchmark::kMicrosecond);

BENCHMARK_CAPTURE(silhouette, tree_250_leaves, 800, 600, joined(crown(250, kCone, 0.6f, 3), crown(80, kLeaf, 0.5f, 4)),
                  false)
    ->Unit(benchmark::kMicrosecond);

/// One at a time: what parts take that are huge or cut by the nearest plane.
void outlines(benchmark::State& state, std::vector<Instance> parts) {
  const Setting setting;
  LookAt look;
  look.eye = {0, 1, 7};
  OutlineMaker maker(perspective(look, 45, 0.1, 512, 512));
  for (auto _ : state)
    for (const Instance& part : parts) benchmark::DoNotOptimize(maker.set(setting.casters[part.mesh], part));
  state.counters["s_per_part"] = benchmark::Counter(
      static_cast<double>(parts.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(outlines, cones, crown(3000, kCone, 0.35f, 1))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(outlines, boxes, crown(3000, kBox, 0.35f, 1))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(outlines, spheres, crown(3000, kSphere, 0.35f, 1))->Unit(benchmark::kMicrosecond);

void small_triangles(benchmark::State& state, Shape shape, float size) {
  const Setting setting;
  silhouette(state, 512, 512, crown(100, shape, size, 5), false);
  const double triangles = 100.0 * static_cast<double>(setting.casters[shape].triangles.size());
  state.counters["s_per_triangle"] =
      benchmark::Counter(triangles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(small_triangles, ball, kTriangles, 0.4f)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(small_triangles, leaf, kLeaf, 0.7f)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace espalier
