#include "run/results.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/check.h"
#include "base/version.h"
#include "io/file.h"
#include "io/image.h"
#include "run/output_look.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::string alternative_name(std::size_t index, const char* ending) {
  return fmt::format("alternatives/{:02}{}", index, ending);
}

std::string caption(const Individual& individual, std::size_t index, double optimum) {
  std::string text = index == 0 ? "best" : fmt::format("{}", index);
  text += fmt::format("  {:.6g}", individual.score);
  if (optimum > 0) text += fmt::format(" ({:.1f} %)", 100 * individual.score / optimum);
  return text;
}

}  // namespace

std::string settings_text(const Setup& setup) {
  return fmt::format(
      "# The settings of a run of Espalier {}, all written out. `espalier run` searches with them anew;\n"
      "# `espalier reproduce` on a file of this folder replays its steps and compares.\n{}",
      kVersion, to_toml(setup.scene));
}

ResultWriter::ResultWriter(const Setup& setup, const SearchResult& result, Executor& executor)
    : setup_(setup),
      result_(result),
      executor_(executor),
      settings_(settings_text(setup)),
      files_(setup.graph(), setup.meshes, setup.textures, setup.targets, look_of(setup.scene.output), executor) {}

const Individual& ResultWriter::individual(std::size_t index) const {
  CHECK(index < size());
  return index == 0 ? result_.best : result_.alternatives[index - 1];
}

Provenance ResultWriter::provenance(std::size_t index, const std::string& settings_folder) const {
  Provenance p = provenance_in_folder("run", setup_.scene.seed, index, setup_.inputs, settings_,
                                      individual(index).derivation);
  p.steps = result_.steps;
  p.engine = name_of(setup_.scene.search.engine);
  p.settings_folder = settings_folder;
  p.score = individual(index).score;
  p.optimum = setup_.objective.optimum();
  return p;
}

std::vector<std::string> ResultWriter::names() const {
  std::vector<std::string> names = {"best.derivation.json", "result.json", "convergence.csv", "diagnostics.csv",
                                    kRunMarker,             "inputs",      "best.glb",        "best.obj", "best.png"};
  for (const std::string& name : outcome_names(setup_)) names.push_back(name);
  for (const char* ending : {".derivation.json", ".glb", ".png"}) {
    for (std::size_t i = 1; i < size(); ++i) names.push_back(alternative_name(i, ending));
  }
  names.push_back("alternatives.png");
  names.push_back("report.html");
  return names;
}

void ResultWriter::write(const std::string& name, const std::string& path) {
  if (name == kRunMarker) return write_file(path, settings_);
  if (name == "inputs") return setup_.inputs.write(fs::path(path).parent_path().string());
  if (name == "result.json") return write_result(path);
  if (name == "convergence.csv") return write_convergence(path);
  if (name == "diagnostics.csv") return write_diagnostics(path);
  if (name == "alternatives.png") return write_sheet(path);
  if (name == "report.html") return write_report(path);
  if (name.starts_with("best.")) return write_individual(0, path, provenance(0, "."));
  if (!name.starts_with("alternatives/")) return write_outcome(name, path);
  std::error_code ignored;  // a folder that cannot be made shows when the file is written
  fs::create_directories(fs::path(path).parent_path(), ignored);
  const std::size_t index = std::stoul(name.substr(name.find('/') + 1));
  write_individual(index, path, provenance(index, ".."));
}

void ResultWriter::write_individual(std::size_t index, const std::string& path, const Provenance& provenance) {
  if (index > 0 && path.ends_with(".png")) return write_small_picture(index, path, provenance);
  if (path.ends_with(".png")) {
    const Picture& picture = best_picture();
    return write_png(path, picture.width, picture.height, picture.rgb, provenance);
  }
  files_.write(individual(index).derivation, path, provenance);
}

const OutcomePicture& ResultWriter::outcome(const std::string& name) {
  const auto found = outcomes_.find(name);
  if (found != outcomes_.end()) return found->second;
  const Model& model = files_.model_of(result_.best.derivation);
  const Surfaces surfaces = files_.surfaces();
  OutcomeLook look;
  look.view = setup_.scene.output.picture;
  return outcomes_[name] = draw_outcome({setup_, model, surfaces}, name, look, executor_);
}

void ResultWriter::write_outcome(const std::string& name, const std::string& path) {
  const Picture picture = with_words(outcome(name));
  write_png(path, picture.width, picture.height, picture.rgb, provenance(0, "."));
}

const Picture& ResultWriter::best_picture() {
  if (best_picture_.rgb.empty()) best_picture_ = files_.picture(result_.best.derivation);
  return best_picture_;
}

const Picture& ResultWriter::small_picture(std::size_t index) {
  small_pictures_.resize(size());
  Picture& picture = small_pictures_[index];
  if (picture.rgb.empty()) {
    const std::array<std::uint32_t, 2> whole = setup_.scene.output.picture;
    picture = files_.picture(individual(index).derivation, {whole[0] / 2, whole[1] / 2});
  }
  return picture;
}

void ResultWriter::write_small_picture(std::size_t index, const std::string& path, const Provenance& provenance) {
  const Picture& picture = small_picture(index);
  write_png(path, picture.width, picture.height, picture.rgb, provenance);
}

void ResultWriter::write_sheet(const std::string& path) {
  std::vector<SheetCell> cells;
  for (std::size_t i = 0; i < size(); ++i) {
    cells.push_back({small_picture(i), caption(individual(i), i, setup_.objective.optimum())});
  }
  const Picture sheet = contact_sheet(cells, fmt::format("{}, seed {}", setup_.graph().name, setup_.scene.seed));
  write_png(path, sheet.width, sheet.height, sheet.rgb, provenance(0, "."));
}

}  // namespace espalier
