// Volume scoring on a 100 x 200 x 100 grid: drawing into two planes, overlap included, and the sweep against a target,
// beside the slow reference. `covered` tells how many voxels a model fills. And all limits on a spaceship of 500 genes,
// beside its expansion.

#include <benchmark/benchmark.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"
#include "model/model.h"
#include "score/limit_target.h"
#include "score/reference_volume.h"
#include "score/volume_kernel.h"

namespace espalier {
namespace {

class NoFiles final : public MeshSource {
 public:
  Mesh load(const std::string&) override { return {}; }
};

struct Setting {
  MeshTable meshes;
  VoxelGrid grid;
  BitGrid target;

  Setting() {
    GeneratorGraph graph;
    for (const MeshKind kind : {MeshKind::box, MeshKind::cylinder, MeshKind::cone, MeshKind::sphere, MeshKind::wedge}) {
      graph.meshes.emplace_back().kind = kind;
    }
    NoFiles files;
    meshes = MeshTable(graph, "", files);
    grid = {Vec3(0), Vec3(100, 200, 100), {100, 200, 100}};
    target = BitGrid(100, 200, 100);
    for (std::uint32_t z = 20; z < 80; ++z) {
      for (std::uint32_t y = 40; y < 160; ++y) {
        for (std::uint32_t x = 30; x < 70; ++x) target.set(x, y, z);
      }
    }
  }
  VolumeKernel kernel() const { return VolumeKernel(grid, make_solids(meshes), {target}); }
};

/// A random rotation: a unit quaternion by rejection, no libm.
Mat3 random_rotation(RandomStream& random) {
  float q[4], square;
  do {
    square = 0;
    for (float& v : q) {
      v = static_cast<float>(2 * random.next_unit() - 1);
      square += v * v;
    }
  } while (square > 1 || square < 0.01f);
  const float w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / square;
  return Mat3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y), s * (x * y - w * z),
              1 - s * (x * x + z * z), s * (y * z + w * x), s * (x * z + w * y), s * (y * z - w * x),
              1 - s * (x * x + y * y));
}

/// n parts of sizes low .. high voxels, turned at random or not, most of them inside the grid.
std::vector<Instance> random_parts(std::size_t n, std::uint16_t mesh, const Vec3& low, const Vec3& high, bool turned) {
  RandomStream random({20261122, Purpose::test, mesh, static_cast<std::uint32_t>(n), turned});
  const auto between = [&](float a, float b) { return a + (b - a) * static_cast<float>(random.next_unit()); };
  std::vector<Instance> parts(n);
  for (Instance& part : parts) {
    part.mesh = mesh;
    part.top = between(0.4f, 1);
    const Mat3 rotation = turned ? random_rotation(random) : Mat3(1);
    for (int i = 0; i < 3; ++i) part.model_from_mesh.basis[i] = rotation[i] * between(low[i], high[i]);
    part.model_from_mesh.origin = Vec3(between(14, 86), between(14, 186), between(14, 86));
  }
  return parts;
}

const Vec3 kBoxLow(8, 8, 8), kBoxHigh(18, 18, 18), kConeLow(3, 8, 3), kConeHigh(6, 14, 6);

std::vector<Instance> parts_of(int kind) {
  switch (kind) {
    case 0: return random_parts(50, 0, kBoxLow, kBoxHigh, false);
    case 1: return random_parts(50, 0, kBoxLow, kBoxHigh, true);
    case 2: return random_parts(1000, 2, kConeLow, kConeHigh, true);
    case 3: return random_parts(1000, 1, kConeLow, kConeHigh, true);
    case 4: return random_parts(50, 4, kBoxLow, kBoxHigh, true);
    default: return random_parts(50, 3, kBoxLow, kBoxHigh, true);
  }
}

constexpr const char* kNames[] = {"50 boxes along the axes", "50 turned boxes", "1000 cones", "1000 cylinders",
                                  "50 wedges", "50 spheres"};

void volume_score(benchmark::State& state) {
  static const Setting setting;
  static const VolumeKernel kernel = setting.kernel();
  const std::vector<Instance> parts = parts_of(static_cast<int>(state.range(0)));
  VolumeScratch scratch(setting.grid);
  VolumeCounts counts;
  for (auto _ : state) {
    kernel.count(parts, VolumeView::full, scratch, counts);
    benchmark::DoNotOptimize(counts.covered);
  }
  state.SetLabel(kNames[state.range(0)]);
  state.counters["covered"] = static_cast<double>(counts.covered);
  state.counters["overlap"] = static_cast<double>(counts.overlap);
}
BENCHMARK(volume_score)->DenseRange(0, 5)->Unit(benchmark::kMicrosecond);

void volume_draw_only(benchmark::State& state) {
  static const Setting setting;
  static const VolumeKernel kernel = setting.kernel();
  const std::vector<Instance> parts = parts_of(static_cast<int>(state.range(0)));
  VolumeScratch scratch(setting.grid);
  for (auto _ : state) kernel.draw(parts, VolumeView::full, scratch);
  state.SetLabel(kNames[state.range(0)]);
}
BENCHMARK(volume_draw_only)->DenseRange(0, 5)->Unit(benchmark::kMicrosecond);

void volume_reference(benchmark::State& state) {
  static const Setting setting;
  const ReferenceVolume reference(setting.grid, setting.meshes, {});
  const std::vector<Instance> parts = parts_of(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(reference.counts(parts, VolumeView::full));
  state.SetLabel(kNames[state.range(0)]);
}
BENCHMARK(volume_reference)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

struct Spaceship {
  std::shared_ptr<const GeneratorGraph> graph;
  MeshTable meshes;
  Derivation derivation;

  Spaceship() {
    std::ifstream file(std::string(ESPALIER_SOURCE_DIR) + "/grammars/spaceship.esp");
    std::stringstream text;
    text << file.rdbuf();
    graph = compile_grammar({"spaceship.esp", text.str(), {}}).graph;
    CHECK(graph);
    NoFiles files;
    meshes = MeshTable(*graph, "", files);
    RandomStream random({1, Purpose::test});
    derivation = seedling(*graph, random);
    close_open_slots(*graph, derivation, random);
    while (derivation.size() < 500) CHECK(grow(*graph, derivation, {}, random));
  }
};

// 0: expansion alone; 1: with a limit on every measure; 2 to 5: limits alone, of a model that is there.
struct LimitCase {
  const char* what;
  bool (*limited)(Measure);
};
constexpr LimitCase kCases[] = {
    {"expansion alone", [](Measure) { return false; }},
    {"expansion and all limits", [](Measure) { return true; }},
    {"genes, depth, balance", [](Measure m) { return facts_of(m).by_genes; }},
    {"parts, triangles", [](Measure m) { return m == Measure::parts || m == Measure::triangles; }},
    {"height, spread", [](Measure m) { return m == Measure::height || m == Measure::spread; }},
    {"volume", [](Measure m) { return m == Measure::volume; }},
};

void limits(benchmark::State& state) {
  static const Spaceship ship;
  Limits all;
  for (const Measure measure : kAllMeasures) {
    if (!kCases[state.range(0)].limited(measure)) continue;
    all[measure] = {.min = 0, .max = facts_of(measure).highest, .from = 0.1, .to = 1e4, .weight = 1};
  }
  const LimitTarget target(all, ship.meshes, VolumeView::full);
  const auto scratch = target.make_scratch();
  Expander expander(*ship.graph);
  Model model;
  expander.expand(ship.derivation, ExpandTo::full, model);
  for (auto _ : state) {
    if (state.range(0) < 2) expander.expand(ship.derivation, ExpandTo::full, model);
    if (state.range(0) > 0) benchmark::DoNotOptimize(target.score(ship.derivation, model, scratch.get()));
    benchmark::DoNotOptimize(model.instances.data());
  }
  state.SetLabel(kCases[state.range(0)].what);
  state.counters["parts"] = static_cast<double>(model.instances.size());
}
BENCHMARK(limits)->DenseRange(0, 5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace espalier
