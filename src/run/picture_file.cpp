#include "run/picture_file.h"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"
#include "io/png.h"
#include "model/expand.h"
#include "render/bone_model.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// What is drawn.
struct Subject {
  Model model;
  MeshTable meshes;
  Surfaces surfaces;
  std::vector<Mesh> ghosts;
  bool truncated = false;
};

Subject subject_of(const LoadedGrammar& grammar, const Derivation& derivation, PictureView view, MeshSource& source) {
  const GeneratorGraph& graph = *grammar.graph;
  Model model;
  Expander(graph).expand(derivation, ExpandTo::full, model);
  const bool truncated = model.truncated;
  if (view == PictureView::bones) {
    if (model.bones.empty()) throw Error(fmt::format("{}: makes no bones to show", grammar.path));
    LineDrawing bones = bone_model(
        model, [&](std::uint32_t gene) { return std::size_t{graph.edges[derivation.genes[gene].edge].child}; });
    return {std::move(bones.model), std::move(bones.meshes), std::move(bones.surfaces), {}, truncated};
  }
  TextureTable textures = load_textures(grammar);
  Surfaces surfaces(graph, model, textures);
  return {std::move(model), load_meshes(grammar, source), std::move(surfaces), {}, truncated};
}

/// The meshes that the scene of a run is to fill or to avoid, in their places.
std::vector<Mesh> scene_targets(const Provenance& provenance, const std::string& name, const std::string& folder,
                                MeshSource& source) {
  if (provenance.settings.empty() || parse_toml(provenance.settings, name).find("espalier_sample"))
    throw Error(fmt::format("{}: comes from no scene; --targets needs a file of a run", name));
  const Scene scene = parse_scene(provenance.settings, name, folder);
  if (scene.volume.meshes.empty()) throw Error(fmt::format("{}: its scene has no meshes for --targets to show", name));
  std::vector<Mesh> targets;
  for (const SceneMesh& mesh : scene.volume.meshes)
    targets.push_back(place_mesh(source.load((fs::path(folder) / mesh.file).string()), mesh));
  return targets;
}

std::string png_of(const Picture& picture, const PictureRequest& request, Provenance provenance) {
  provenance.made_by = "render";
  provenance.picture = to_toml(request);
  const std::string text = to_json(provenance);
  if (picture.alpha.empty()) return encode_png(picture.width, picture.height, picture.rgb, "espalier", text);
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * picture.alpha.size());
  for (std::size_t i = 0; i < picture.alpha.size(); ++i) {
    rgba.insert(rgba.end(), {picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2], picture.alpha[i]});
  }
  return encode_png_with_alpha(picture.width, picture.height, rgba, "espalier", text);
}

Picture draw_one(const Subject& s, const PictureRequest& request, Executor& executor) {
  return render(s.model, s.meshes, s.surfaces, s.ghosts, render_settings(request), executor);
}

using TakeFrame = std::function<void(std::uint32_t frame, const Picture& picture)>;

/// Calls `take` for each frame, and gives the strip if one is wanted.
std::optional<Picture> draw_turntable(const Subject& s, const PictureRequest& request, bool strip_wanted,
                                      const TakeFrame& take, Executor& executor) {
  std::optional<Picture> strip;
  const std::uint32_t columns =
      request.columns > 0 ? request.columns : strip_columns(request.frames, request.size[0], request.size[1]);
  const Turntable turntable{request.frames, request.fixed_light, request.frame};
  render_turntable(s.model, s.meshes, s.surfaces, s.ghosts, render_settings(request), turntable, executor,
                   [&](std::uint32_t number, const Picture& frame) {
                     take(number, frame);
                     if (!strip_wanted) return;
                     if (!strip) strip = empty_strip(request.frames, frame, columns);
                     paste_frame(*strip, frame, number, columns);
                   });
  return strip;
}

std::string frame_name(std::uint32_t frame) { return fmt::format("{:04}.png", frame + 1); }

/// What is written at the end must not fail then, nor take the place of a frame.
void prepare_out(const PictureJob& job) {
  const fs::path out = fs::weakly_canonical(fs::absolute(job.out));
  if (!fs::is_directory(out.parent_path()))
    throw Error(fmt::format("{}: the folder {} does not exist", job.out, out.parent_path().string()));
  if (job.frames.empty() || out.parent_path() != fs::weakly_canonical(fs::absolute(job.frames))) return;
  for (std::uint32_t frame = 0; frame < job.request.frames; ++frame) {
    if (out.filename() == frame_name(frame)) throw Error(fmt::format("{}: is one of the frames", job.out));
  }
}

/// Makes the folder. Frames of a longer turntable there would go on behind the new ones: an Error.
void prepare_frames(const std::string& folder, std::uint32_t frames) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("{}: cannot make the folder: {}", folder, error.message()));
  const fs::path next = fs::path(folder) / frame_name(frames);
  if (fs::exists(next))
    throw Error(fmt::format("{}: is a frame of a longer turntable; remove those frames or name another folder",
                            next.string()));
}

void check_strip(const PictureRequest& request) {
  const std::uint64_t columns =
      request.columns > 0 ? request.columns : strip_columns(request.frames, request.size[0], request.size[1]);
  const std::uint64_t width = columns * request.size[0],
                      height = (request.frames + columns - 1) / columns * request.size[1];
  const auto fail = [&](const std::string& rule) {
    throw Error(fmt::format("a strip of {} frames must have at most {}, got {}x{}; choose a smaller --size or other "
                            "--columns, or --frames without -o", request.frames, rule, width, height));
  };
  if (std::max(width, height) > PictureRequest::kMostStripSide)
    fail(fmt::format("{} pixels a side", PictureRequest::kMostStripSide));
  if (width * height > PictureRequest::kMostStripPixels)
    fail(fmt::format("{} pixels", PictureRequest::kMostStripPixels));
}

void check(const PictureJob& job) {
  check(job.request);
  const bool turntable = job.request.frames > 0;
  if (job.out.empty() && job.frames.empty()) 
    throw Error("nothing to write: give -o FILE.png, or --frames with --turntable");
  if (!job.out.empty() && !job.out.ends_with(".png")) throw Error(fmt::format("{}: render writes .png", job.out));
  if (!job.frames.empty() && !turntable) throw Error("--frames needs --turntable");
  if (turntable && !job.out.empty()) check_strip(job.request);
}

}  // namespace

PictureReport write_pictures(const PictureJob& job, MeshSource& source, Executor& executor) {
  check(job);
  const auto [grammar, derivation, adapted] = load_derivation(job.derivation, job.grammar, job.attributes);
  Subject subject = subject_of(grammar, derivation, job.request.view, source);
  if (job.request.targets) {
    const Provenance original = read_provenance(job.derivation);
    subject.ghosts = scene_targets(original, job.derivation, settings_folder_of(job.derivation, original), source);
  }
  PictureReport report{adapted, subject.truncated, {}};
  const auto write = [&](const std::string& path, const Picture& picture, const PictureRequest& request) {
    const bool as_it_is = job.grammar.empty() && job.attributes.empty();
    const Provenance provenance = made_from(job.derivation, as_it_is, grammar, derivation, path);
    write_file(path, png_of(picture, request, provenance));
    report.written.push_back(path);
  };
  if (!job.frames.empty()) prepare_frames(job.frames, job.request.frames);
  if (!job.out.empty()) prepare_out(job);
  if (job.request.frames == 0) {
    write(job.out, draw_one(subject, job.request, executor), job.request);
    return report;
  }
  const TakeFrame take = [&](std::uint32_t number, const Picture& frame) {
    if (job.frames.empty()) return;
    PictureRequest request = job.request;
    request.frame = number;
    write((fs::path(job.frames) / frame_name(number)).string(), frame, request);
  };
  const std::optional<Picture> strip = draw_turntable(subject, job.request, !job.out.empty(), take, executor);
  if (strip) write(job.out, *strip, job.request);
  return report;
}

std::string picture_again(const PictureRequest& request, const Derivation& derivation, const Provenance& provenance,
                          const std::string& folder, MeshSource& source, Executor& executor) {
  const std::string name = "the picture's settings";
  const LoadedGrammar grammar = grammar_of_settings(provenance.settings, name, folder, {});
  Subject subject = subject_of(grammar, derivation, request.view, source);
  if (request.targets) subject.ghosts = scene_targets(provenance, name, folder, source);
  if (request.frames == 0) return png_of(draw_one(subject, request, executor), request, provenance);
  if (!request.frame) check_strip(request);
  std::optional<Picture> frame;
  const TakeFrame take = [&](std::uint32_t, const Picture& picture) { frame = picture; };
  const std::optional<Picture> strip = draw_turntable(subject, request, !request.frame, take, executor);
  return png_of(strip ? *strip : *frame, request, provenance);
}

}  // namespace espalier
