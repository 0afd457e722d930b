#include "run/setup.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/error.h"
#include "base/math.h"
#include "run/founders.h"
#include "run/scene_silhouettes.h"
#include "run/scene_limits.h"
#include "run/silhouette_weights.h"
#include "score/limit_target.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::string resolve(const Scene& scene, const std::string& path) {
  return fs::path(path).is_absolute() ? path : (fs::path(scene.folder) / path).string();
}

Mat3 rotation(int axis, float degrees) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  float s, c;
  sin_cos(degrees * static_cast<float>(kPi / 180), s, c);
  Mat3 m(1.0f);
  m[a][a] = c, m[a][b] = s;  // counter-clockwise seen from the tip of the axis
  m[b][a] = -s, m[b][b] = c;
  return m;
}

/// The scene's grid; where it gives none, the one around its targets becomes the scene's, and so part of its settings.
const SceneGrid& settle_grid(Setup& setup) {
  SceneVolume& volume = setup.scene.volume;
  if (!volume.grid) {
    const VoxelGrid grid = default_grid(setup.targets, volume.cells);
    volume.grid = SceneGrid{grid.min, grid.max, {grid.cells[0], grid.cells[1], grid.cells[2]}};
  }
  return *volume.grid;
}

std::unique_ptr<VolumeTarget> make_volume_target(Setup& setup) {
  const SceneGrid& grid = settle_grid(setup);
  const SceneVolume& volume = setup.scene.volume;
  VolumeSettings settings;
  for (std::size_t i = 0; i < setup.targets.size(); ++i) {
    const SceneMesh& mesh = volume.meshes[i];
    settings.meshes.push_back({fs::path(mesh.file).filename().string(), setup.targets[i], mesh.fill, mesh.spill});
  }
  settings.grid.min = grid.min;
  settings.grid.max = grid.max;
  for (std::size_t i = 0; i < 3; ++i) settings.grid.cells[i] = grid.cells[i];
  settings.form = volume.form;
  settings.view = volume.view;
  settings.overlap_count = volume.overlap;
  settings.overlap_weight = volume.overlap_weight;
  settings.outside_weight = volume.outside_weight;
  return std::make_unique<VolumeTarget>(std::move(settings), setup.meshes);
}

void add_volume(Setup& setup) {
  auto volume = make_volume_target(setup);
  setup.volume = volume.get();
  setup.stage = {volume->grid().min, volume->grid().max};
  for (const std::string& warning : volume->warnings()) setup.warnings.push_back(warning);
  setup.objective.add(std::move(volume));
}

/// The box around most of what the grammar makes: a twentieth of the probes' parts may lie beyond it on each side.
Bounds box_of(const Probes& probes) {
  std::vector<float> along[3];
  for (const Instance& instance : probes.instances) {
    const Vec3& at = instance.model_from_mesh.origin;
    if (!std::isfinite(at.x + at.y + at.z)) continue;
    for (int i = 0; i < 3; ++i) along[i].push_back(at[i]);
  }
  Bounds box;
  if (along[0].empty()) return {Vec3(-1), Vec3(1)};
  for (int i = 0; i < 3; ++i) {
    std::sort(along[i].begin(), along[i].end());
    const std::size_t cut = along[i].size() / 20;
    box.min[i] = along[i][cut] - 0.5f, box.max[i] = along[i][along[i].size() - 1 - cut] + 0.5f;
  }
  return box;
}

/// The images of a silhouette, where they lie; the scene names their copies from then on.
std::vector<ImageLayer> take_images(Setup& setup, const Scene& from, SceneSilhouette& silhouette) {
  std::vector<ImageLayer> layers;
  const auto take = [&](std::string& file, ImageMeaning meaning) {
    if (file.empty()) return;
    layers.push_back({resolve(from, file), meaning});
    file = setup.inputs.add_target(layers.back().path);
  };
  take(silhouette.image, ImageMeaning::both);
  take(silhouette.want_image, ImageMeaning::want);
  take(silhouette.avoid_image, ImageMeaning::avoid);
  return layers;
}

void add_silhouettes(Setup& setup, const Scene& from) {
  for (std::size_t i = 0; i < from.silhouettes.size(); ++i) {
    SceneSilhouette& scene = setup.scene.silhouettes[i];
    const std::vector<ImageLayer> layers = take_images(setup, from, scene);
    const SilhouetteWeights weights = load_weights(layers, scene.size);
    if (!scene.size)
      scene.size = {std::min(weights.image.width, Projection::kMostPixels),
                    std::min(weights.image.height, Projection::kMostPixels)};
    settle_camera(scene, setup.stage);
    SilhouetteSettings settings;
    settings.name = fmt::format("silhouette {}", fs::path(layers[0].path).filename().string());
    settings.projection = projection_of(scene, *scene.size);
    settings.image = resized(weights.image, (*scene.size)[0], (*scene.size)[1]);
    settings.form = scene.form, settings.view = scene.view, settings.want = scene.want, settings.avoid = scene.avoid;
    // The other form compares with all that is wanted, so that only ratios matter.
    if (scene.form == SilhouetteForm::linear) settings.want *= weights.full, settings.avoid *= weights.full;
    auto target = std::make_unique<SilhouetteTarget>(std::move(settings), setup.meshes);
    setup.silhouettes.push_back(target.get());
    setup.objective.add(std::move(target), scene.weight);
  }
}

void add_curves(Setup& setup) {
  const SceneCurves& scene = setup.scene.curves;
  if (scene.settings.curves.empty()) return;
  auto target = std::make_unique<CurveTarget>(scene.settings);
  setup.curves = target.get();
  setup.objective.add(std::move(target), scene.weight);
}

/// Models that follow curves stay near them: half of their extent is left on every side.
Bounds box_around(const CurveSettings& settings) {
  Bounds box;
  for (const GuidingCurve& guide : settings.curves) {
    for (const Vec3& point : guide.curve.points) box.add(point);
  }
  const Vec3 size = box.size();
  const Vec3 margin(0.5f * std::max({size.x, size.y, size.z, 0.1f}));
  return {box.min - margin, box.max + margin};
}

/// Both grow the same probes.
bool probes_alike(const Setup& a, const Setup& b) {
  return a.grammar.graph == b.grammar.graph && a.scene.seed == b.scene.seed &&
         a.scene.search.ga.genes == b.scene.search.ga.genes && a.full() == b.full();
}

void build_objective(Setup& setup, const Scene& from, const Setup* like) {
  if (setup.targets.empty() && from.silhouettes.empty()) {
    setup.stage = box_around(from.curves.settings);
  } else if (setup.targets.empty() && like && probes_alike(setup, *like)) {
    setup.stage = like->stage;
  } else if (setup.targets.empty()) {
    setup.probes = grow_probes(setup.graph(), setup.scene, setup.full());
    setup.stage = box_of(*setup.probes);
  } else {
    add_volume(setup);
  }
  add_silhouettes(setup, from);
  add_curves(setup);
  const VolumeView view = setup.full() ? VolumeView::full : VolumeView::parts;
  auto limits = std::make_unique<LimitTarget>(limits_of(setup.scene), setup.meshes, view);
  for (const std::string& warning : limits->warnings()) setup.warnings.push_back(warning);
  setup.objective.add(std::move(limits));
}

}  // namespace

bool Setup::full() const {
  if (!scene.volume.meshes.empty()) return scene.volume.view == VolumeView::full;
  if (scene.silhouettes.empty()) return true;
  return std::any_of(scene.silhouettes.begin(), scene.silhouettes.end(),
                     [](const SceneSilhouette& s) { return s.view == VolumeView::full; });
}

Mesh place_mesh(Mesh mesh, const SceneMesh& placing) {
  const Mat3 turn =
      rotation(2, placing.rotation_deg.z) * rotation(1, placing.rotation_deg.y) * rotation(0, placing.rotation_deg.x);
  Mat3 basis = turn;
  for (int i = 0; i < 3; ++i) basis[i] = turn[i] * placing.scale[i];
  for (Vec3& p : mesh.positions) p = basis * p + placing.position;
  for (Vec3& n : mesh.normals) {
    const Vec3 turned = turn * (n / placing.scale);  // the inverse transpose of turn * scale
    const float length = glm::length(turned);
    n = length > 0 ? turned / length : Vec3(0, 1, 0);
  }
  if (placing.scale.x * placing.scale.y * placing.scale.z < 0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

std::unique_ptr<Setup> set_up(const Scene& scene, MeshSource& source) {
  return set_up(scene, load_grammar(resolve(scene, scene.grammar), scene.attributes), source);
}

std::unique_ptr<Setup> set_up(const Scene& scene, LoadedGrammar grammar, MeshSource& source, const Setup* like) {
  auto setup = std::make_unique<Setup>();
  setup->scene = scene;
  setup->grammar = std::move(grammar);
  if (!setup->grammar.warnings.empty()) setup->warnings.push_back(setup->grammar.warnings);
  setup->meshes = load_meshes(setup->grammar, source);
  setup->textures = load_textures(setup->grammar);
  setup->inputs.add_grammar(setup->grammar);
  setup->scene.grammar = setup->inputs.grammar_name();
  for (std::size_t i = 0; i < scene.volume.meshes.size(); ++i) {
    const SceneMesh& mesh = scene.volume.meshes[i];
    const std::string path = resolve(scene, mesh.file);
    setup->scene.volume.meshes[i].file = setup->inputs.add_target(path);
    setup->targets.push_back(place_mesh(source.load(path), mesh));
  }
  build_objective(*setup, scene, like);
  take_founders(*setup, scene);
  return setup;
}

}  // namespace espalier
