#include "studio/export_model.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/version.h"
#include "io/file.h"
#include "model/level_of_detail.h"
#include "run/model_files.h"
#include "run/results.h"
#include "run/scene_toml.h"
#include "run/temporary_folder.h"
#include "studio/zip.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDerivation = "best.derivation.json";

/// Letters, digits and hyphens of a name.
std::string file_stem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) stem += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!plain && !stem.empty() && stem.back() != '-') stem += '-';
  }
  while (!stem.empty() && stem.back() == '-') stem.pop_back();
  return stem.empty() ? "model" : stem.substr(0, 80);
}

bool has_targets(const Setup& setup) { return setup.volume || setup.curves || !setup.silhouettes.empty(); }

std::string read_me(const ShownModel& shown, const std::string& stem) {
  const bool targets = has_targets(*shown.setup);
  std::string text = fmt::format("{}, made with the studio of Espalier {}.\n\n", stem, kVersion);
  text += "best.derivation.json   the model that was shown\n";
  if (targets) text += "scene.toml             what was asked for\n";
  text += "inputs/                grammar, meshes and images\n\n";
  if (targets) text += "Search again:\n  espalier run scene.toml\n\n";
  if (shown.steps > 0) {
    text += fmt::format("Make this very model again, by the search that found it ({} steps):\n"
                        "  espalier reproduce best.derivation.json\n\n", shown.steps);
  }
  text += fmt::format("Files of the model:\n  espalier export best.derivation.json{} -o {}.glb\n",
                      targets ? "" : fmt::format(" --grammar {}", shown.setup->inputs.grammar_name()), stem);
  return text;
}

std::string scene_folder(const ShownModel& shown, const std::string& stem) {
  const Setup& setup = *shown.setup;
  ZipWriter zip;
  const std::string top = stem + "/";
  zip.add(top + "README.txt", read_me(shown, stem));
  if (has_targets(setup)) zip.add(top + "scene.toml", settings_text(setup));
  for (const InputFile& file : setup.inputs.files()) zip.add(top + file.name, file.bytes);
  zip.add(top + kDerivation, derivation_document(setup.graph(), shown.derivation, provenance_of(shown)));
  return zip.finish();
}

/// Every level of detail as a file, and how many triangles each has.
std::string levels_folder(const ShownModel& shown, ModelFiles& files, const TemporaryFolder& folder,
                          const std::string& stem) {
  std::string table = "file,triangles\n";
  for (const auto& [name, triangles] : files.write_levels(shown.derivation, folder.file(stem + ".glb"),
                                                          {.joints = Joints::smooth}, provenance_of(shown))) {
    table += fmt::format("{},{}\n", name, triangles);
  }
  write_file(folder.file("triangles.csv"), table);
  return zip_of_folder(folder.file(""), stem);
}

}  // namespace

Provenance provenance_of(const ShownModel& shown) {
  const Setup& setup = *shown.setup;
  Provenance p;
  p.version = kVersion;
  p.made_by = shown.steps > 0 ? "run" : "export";
  p.inputs = setup.inputs.hashes();
  p.seed = setup.scene.seed;
  p.steps = shown.steps;
  p.derivation = hash_text(shown.derivation);
  p.score = shown.score;
  if (shown.score) p.optimum = shown.optimum;
  // Settings are what a search is made again from, so they stand only where that finds this model.
  if (shown.steps > 0) {
    p.engine = name_of(setup.scene.search.engine);
    p.settings = settings_text(setup);
    p.settings_folder = ".";
  }
  return p;
}

HttpResponse export_model(const ShownModel& shown, const std::string& format, const std::string& name) {
  const std::string stem = file_stem(name);
  if (format == "zip") return {200, "application/zip", scene_folder(shown, stem), stem + ".zip"};
  const bool known = format == "glb" || format == "lods" || format == "obj" || format == "ply" || format == "stl" ||
                     format == "png";
  if (!known) throw Error("models are exported as glb, lods, obj, ply, stl, png or zip");
  const Setup& setup = *shown.setup;
  const TemporaryFolder folder;
  const std::unique_ptr<Executor> executor = make_serial_executor();
  const std::vector<Mesh> no_ghosts;
  RenderSettings look;
  look.azimuth_deg = static_cast<float>(setup.scene.output.azimuth_deg);
  look.elevation_deg = static_cast<float>(setup.scene.output.elevation_deg);
  ModelFiles files(setup.graph(), setup.meshes, setup.textures, no_ghosts, look, *executor);
  if (format == "lods") return {200, "application/zip", levels_folder(shown, files, folder, stem), stem + "-lods.zip"};
  const std::string file = stem + "." + format;
  files.write(shown.derivation, folder.file(file), provenance_of(shown));
  if (format == "obj") return {200, "application/zip", zip_of_folder(folder.file(""), stem), stem + "-obj.zip"};
  const char* const type = format == "glb" ? "model/gltf-binary" : format == "png" ? "image/png" : "application/octet-stream";
  return {200, type, read_file(folder.file(file)), file};
}

}  // namespace espalier::studio
