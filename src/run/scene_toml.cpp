#include "run/scene_toml.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"
#include "run/scene_choices.h"
#include "run/scene_curves.h"
#include "run/scene_engines.h"
#include "run/scene_limits.h"
#include "run/scene_silhouettes.h"
#include "run/scene_start.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMostWhole = std::uint64_t{1} << 53;
constexpr float kFarthest = 1e6f;  // coordinates, metres
constexpr double kMostWeight = 1e9;

void read_budget(const TomlValue& table, const std::string& file, SceneBudget& budget) {
  TomlSection s(table, file, "budget");
  budget.seconds = s.number("seconds", 1e-3, 1e7);
  budget.evaluations = s.whole("evaluations", 1, kMostWhole);
  budget.generations = s.whole("generations", 1, 0xffffffff);
  s.finish();
}

SceneMesh read_mesh(const TomlValue& table, const std::string& file, std::size_t index) {
  TomlSection s(table, file, fmt::format("volume.mesh.{}", index));
  SceneMesh mesh;
  const auto path = s.text("file");
  if (!path || path->empty()) s.fail("file", "must be the path of a mesh");
  mesh.file = *path;
  take(mesh.fill, s.number("fill", -kMostWeight, kMostWeight));
  mesh.spill = s.number("spill", -kMostWeight, kMostWeight);
  take(mesh.position, s.vector("position", -kFarthest, kFarthest));
  take(mesh.scale, s.vector("scale", -kFarthest, kFarthest, true));
  take(mesh.rotation_deg, s.vector("rotation_deg", -36'000, 36'000));
  for (int i = 0; i < 3; ++i) {
    if (mesh.scale[i] == 0) s.fail("scale", "must not be 0");
  }
  s.finish();
  return mesh;
}

SceneGrid read_grid(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "volume.grid");
  SceneGrid grid;
  for (const char* key : {"min", "max", "cells"}) {
    if (!s.member(key)) s.fail("", fmt::format("must have {}", key));
  }
  grid.min = *s.vector("min", -kFarthest, kFarthest);
  grid.max = *s.vector("max", -kFarthest, kFarthest);
  const auto cells = *s.wholes("cells", 3, 1, kMostVoxelsPerAxis);
  for (std::size_t i = 0; i < 3; ++i) grid.cells[i] = static_cast<std::uint32_t>(cells[i]);
  for (int i = 0; i < 3; ++i) {
    if (!(grid.min[i] < grid.max[i])) {
      s.fail("max", fmt::format("must be greater than volume.grid.min along {}, got {} and {}", "xyz"[i], grid.max[i],
                                grid.min[i]));
    }
  }
  if (cells[0] * cells[1] * cells[2] > kMostVoxels) {
    s.fail("cells", fmt::format("must multiply to at most {}, got {}", kMostVoxels, cells[0] * cells[1] * cells[2]));
  }
  s.finish();
  return grid;
}

void read_volume(const TomlValue& table, const std::string& file, SceneVolume& volume) {
  TomlSection s(table, file, "volume");
  take(volume.form, s.choice("form", kVolumeForms));
  take(volume.view, s.choice("view", kVolumeViews));
  take(volume.overlap, s.choice("overlap", kOverlapCounts));
  take(volume.overlap_weight, s.number("overlap_weight", 0, kMostWeight));
  volume.outside_weight = s.number("outside_weight", -kMostWeight, kMostWeight);
  take(volume.cells, s.whole("cells", 1, kMostVoxels));
  if (const TomlValue* grid = s.table("grid")) volume.grid = read_grid(*grid, file);
  const std::vector<TomlValue>* meshes = s.tables("mesh");
  if (!meshes || meshes->empty()) s.fail("mesh", "must name at least one mesh: [[volume.mesh]] with file = \"...\"");
  if (meshes->size() > 64) s.fail("mesh", fmt::format("must be at most 64 meshes, got {}", meshes->size()));
  for (std::size_t i = 0; i < meshes->size(); ++i) volume.meshes.push_back(read_mesh((*meshes)[i], file, i));
  s.finish();
}

void read_output(const TomlValue& table, const std::string& file, Scene& scene) {
  SceneOutput& output = scene.output;
  TomlSection s(table, file, "output");
  take(output.keep, s.whole("keep", 0, 99));
  take(output.distance, s.number("distance", 0, 1));
  take(scene.refresh_seconds, s.number("refresh_seconds", 0, 1e6));
  take(scene.checkpoint_seconds, s.number("checkpoint_seconds", 0, 1e6));
  if (const auto size = s.wholes("picture", 2, 16, 8192)) {
    output.picture = {static_cast<std::uint32_t>((*size)[0]), static_cast<std::uint32_t>((*size)[1])};
  }
  take(output.azimuth_deg, s.number("azimuth_deg", -360, 360));
  take(output.elevation_deg, s.number("elevation_deg", -90, 90));
  s.finish();
}

// Values as the grammar language writes them after `attr NAME =`.
void read_attributes(const TomlValue& table, const std::string& file, std::map<std::string, std::string>& attributes) {
  TomlSection s(table, file, "attributes");
  for (const auto& [name, value] : table.members) {
    s.member(name);
    switch (value.kind) {
      case TomlValue::Kind::boolean: attributes[name] = value.boolean ? "true" : "false"; break;
      case TomlValue::Kind::integer: attributes[name] = fmt::format("{}", value.integer); break;
      case TomlValue::Kind::real: attributes[name] = fmt::format("{}", *s.number(name, -1e30, 1e30)); break;
      case TomlValue::Kind::text: attributes[name] = value.text; break;
      default: s.fail(name, "must be a number, true, false or a text, got " + describe(value));
    }
  }
}

void override_attributes(const std::vector<std::string>& overrides, std::map<std::string, std::string>& attributes) {
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw Error(fmt::format("-D must be NAME=VALUE, got \"{}\"", text));
    attributes[text.substr(0, equals)] = text.substr(equals + 1);
  }
}

void check_whole(const TomlValue& root, TomlSection& s, const Scene& scene) {
  if (!scene.budget.seconds && !scene.budget.evaluations && !scene.budget.generations) {
    s.fail("budget", "must give seconds, evaluations or generations: a search has to end");
  }
  try {
    validate_search(scene.search);
  } catch (const Error& error) {
    // Rules on several settings at once: told where the scene speaks of the search.
    const TomlValue* const engines = root.find("engine");
    const TomlValue* const own = engines ? engines->find(name_of(scene.search.engine)) : nullptr;
    const TomlValue* const place = own ? own : root.find("search");
    throw Error(fmt::format("{}:{}:{}: {}.{}", s.file(), place ? place->line : 1, place ? place->column : 1,
                            own ? fmt::format("engine.{}", name_of(scene.search.engine)) : "search", error.what()));
  }
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::string& folder,
                  const SceneOverrides& overrides) {
  if (text.find('\0') != std::string_view::npos) throw Error(fmt::format("{}: must be text, got binary data", name));
  TomlValue root = parse_toml(text, name);
  const std::string named_engine = engine_of_file(root);
  for (const std::string& setting : overrides.settings) apply_setting(root, setting);

  Scene scene;
  scene.folder = folder;
  TomlSection s(root, name, "");
  if (!s.whole("espalier", 1, 1)) s.fail("espalier", "must be 1, the version of the scene format");
  const auto grammar = s.text("grammar");
  if (!grammar || grammar->empty()) s.fail("grammar", "must be the path of a grammar");
  scene.grammar = *grammar;
  take(scene.seed, s.whole("seed", 0, std::uint64_t{1} << 62));
  take(scene.threads, s.whole("threads", 0, 1024));
  if (const TomlValue* t = s.table("attributes")) read_attributes(*t, name, scene.attributes);
  override_attributes(overrides.attributes, scene.attributes);
  if (const TomlValue* t = s.table("budget")) read_budget(*t, name, scene.budget);
  s.table("search"), s.table("engine");
  read_search(root, named_engine, name, scene.search);
  // Its genomes are one gene, always.
  if (scene.search.engine == EngineKind::genesis) scene.search.ga.genes.min = 1;
  if (const TomlValue* t = s.table("limits")) read_limits(*t, name, scene);
  if (const TomlValue* t = s.table("volume")) read_volume(*t, name, scene.volume);
  if (const std::vector<TomlValue>* list = s.tables("silhouette")) {
    if (list->size() > 64) s.fail("silhouette", fmt::format("must be at most 64 silhouettes, got {}", list->size()));
    for (std::size_t i = 0; i < list->size(); ++i) scene.silhouettes.push_back(read_silhouette((*list)[i], name, i));
  }
  if (const TomlValue* t = s.table("curves")) scene.curves = read_curves(*t, name);
  if (scene.volume.meshes.empty() && scene.silhouettes.empty() && scene.curves.settings.curves.empty()) {
    s.fail("volume", "must be given, or [[silhouette]], or [curves]: a search needs meshes to fill, images to look like "
                     "or curves to follow");
  }
  if (const TomlValue* t = s.table("start")) scene.start = read_start(*t, name);
  if (const TomlValue* t = s.table("output")) read_output(*t, name, scene);
  s.finish();
  share_limits(scene.search);
  check_whole(root, s, scene);
  return scene;
}

Scene load_scene(const std::string& path, const SceneOverrides& overrides) {
  const std::string text = read_file(path, kMostSceneBytes);
  return parse_scene(text, path, std::filesystem::path(path).parent_path().string(), overrides);
}

}  // namespace espalier
