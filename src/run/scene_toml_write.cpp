// Writing scenes as TOML, every setting spelled out.
#include <fmt/format.h>

#include "run/scene_choices.h"
#include "run/scene_limits.h"
#include "run/scene_silhouettes.h"
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

void write_search(SceneWriter& w, const SceneSearch& search) {
  const GaSettings& ga = search.ga;
  w.line("\n[search]\nengine = {}\npreset = {}", quote_toml(search.engine), quote_toml(search.preset));
  w.line("population = {}\nelitism = {}", ga.population, ga.elitism);
  if (ga.initial_length_min == ga.initial_length_max) {
    w.line("initial_length = {}", ga.initial_length_min);
  } else {
    w.line("initial_length = [{}, {}]", ga.initial_length_min, ga.initial_length_max);
  }
  w.line("mutation = {}\ngrow = {}\ncut = {}\nalter = {}\nnudge = {}", format_toml(ga.mutation),
         format_toml(ga.grow), format_toml(ga.cut), format_toml(ga.alter), format_toml(ga.nudge));
  w.line("first = \"{}\"\nsecond = \"{}\"\ntournament_size = {}", word_for(kSelectionSchemes, ga.first),
         word_for(kSelectionSchemes, ga.second), ga.tournament_size);
  w.line(
      "crossover = \"{}\"\nretries = {}\nreplace_probability = {}\nreuse_scores = {}\nunique = {}\nrestart_after = {}",
      word_for(kCompatibilities, ga.crossover), ga.retries, format_toml(ga.replace_probability), ga.reuse_scores,
      ga.unique, ga.restart_after);
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
  write_search(w, scene.search);
  w.line("\n{}", limits_to_toml(scene));
  if (!scene.volume.meshes.empty()) write_volume(w, scene.volume);
  for (const SceneSilhouette& silhouette : scene.silhouettes) w.line("\n{}", silhouette_to_toml(silhouette));
  w.line("\n[output]\nkeep = {}\ndistance = {}\npicture = [{}, {}]", scene.output.keep,
         format_toml(scene.output.distance), scene.output.picture[0], scene.output.picture[1]);
  return w.take();
}

}  // namespace espalier
