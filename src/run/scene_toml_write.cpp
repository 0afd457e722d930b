// Writing scenes as TOML, every setting spelled out.
#include <fmt/format.h>

#include "run/scene_choices.h"
#include "run/scene_engines.h"
#include "run/scene_limits.h"
#include "run/scene_curves.h"
#include "run/scene_silhouettes.h"
#include "run/scene_start.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

class SceneWriter {
 public:
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
    out_ += '\n';
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

void write_budget(SceneWriter& w, const SceneBudget& budget) {
  w.line("\n[budget]");
  if (budget.seconds) w.line("seconds = {}", format_toml(*budget.seconds));
  if (budget.evaluations) w.line("evaluations = {}", *budget.evaluations);
  if (budget.generations) w.line("generations = {}", *budget.generations);
}

void write_volume(SceneWriter& w, const SceneVolume& volume) {
  w.line("\n[volume]\nform = \"{}\"\nview = \"{}\"\noverlap = \"{}\"", word_for(kVolumeForms, volume.form),
         word_for(kVolumeViews, volume.view), word_for(kOverlapCounts, volume.overlap));
  w.line("overlap_weight = {}", format_toml(volume.overlap_weight));
  if (volume.outside_weight) w.line("outside_weight = {}", format_toml(*volume.outside_weight));
  w.line("cells = {}", volume.cells);
  if (volume.grid) {
    w.line("\n[volume.grid]\nmin = {}\nmax = {}\ncells = [{}, {}, {}]", format_vector(volume.grid->min),
           format_vector(volume.grid->max), volume.grid->cells[0], volume.grid->cells[1], volume.grid->cells[2]);
  }
  for (const SceneMesh& mesh : volume.meshes) {
    w.line("\n[[volume.mesh]]\nfile = {}\nfill = {}", quote_toml(mesh.file), format_toml(mesh.fill));
    if (mesh.spill) w.line("spill = {}", format_toml(*mesh.spill));
    w.line("position = {}\nscale = {}\nrotation_deg = {}", format_vector(mesh.position), format_vector(mesh.scale),
           format_vector(mesh.rotation_deg));
  }
}

}  // namespace

std::string to_toml(const Scene& scene) {
  SceneWriter w;
  w.line("espalier = 1\ngrammar = {}\nseed = {}", quote_toml(scene.grammar), scene.seed);
  if (!scene.attributes.empty()) w.line("\n[attributes]");
  for (const auto& [name, value] : scene.attributes) w.line("{} = {}", quote_toml(name), quote_toml(value));
  write_budget(w, scene.budget);
  w.line("\n{}", search_to_toml(scene.search));
  w.line("{}", limits_to_toml(scene));
  if (!scene.volume.meshes.empty()) write_volume(w, scene.volume);
  for (const SceneSilhouette& silhouette : scene.silhouettes) w.line("\n{}", silhouette_to_toml(silhouette));
  w.line("\n{}", curves_to_toml(scene.curves));
  if (!scene.start.derivation.empty()) w.line("\n{}", start_to_toml(scene.start));
  w.line("\n[output]\nkeep = {}\ndistance = {}\npicture = [{}, {}]\nazimuth_deg = {}\nelevation_deg = {}",
         scene.output.keep, format_toml(scene.output.distance), scene.output.picture[0], scene.output.picture[1],
         format_toml(scene.output.azimuth_deg), format_toml(scene.output.elevation_deg));
  return w.take();
}

}  // namespace espalier
