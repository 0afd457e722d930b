// espalier preview: what a scene asks for, as one picture.
#include "run/preview.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/verbs.h"
#include "io/image.h"
#include "io/mesh_import.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// Made sure of before anything is computed.
std::string picture_path(const PreviewOptions& options) {
  std::string path = options.out;
  if (path.empty()) path = (fs::path("out") / (fs::path(options.scene).stem().string() + "-preview.png")).string();
  if (!path.ends_with(".png")) throw Error(fmt::format("--out must name a .png file, got \"{}\"", path));
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  return path;
}

}  // namespace

int preview_verb(const PreviewOptions& options) {
  SceneOverrides overrides = {options.settings, options.attributes};
  if (options.seed) overrides.settings.push_back(fmt::format("seed={}", *options.seed));
  const Scene scene = load_scene(options.scene, overrides);
  const std::string path = picture_path(options);
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const Preview preview = make_preview(scene, source);
  const Picture picture = preview_picture(preview, *executor);
  write_png(path, picture.width, picture.height, picture.rgb, preview_provenance(preview));
  if (options.json) {
    fmt::print("{}\n", preview_json(preview, path));
    return kDone;
  }
  fmt::print("{}", preview_text(preview));
  for (const std::string& warning : preview.warnings) fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("wrote {}\n", path);
  return kDone;
}

}  // namespace espalier
