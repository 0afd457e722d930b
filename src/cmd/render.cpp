// espalier render: pictures and turntables of a derivation's model.
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/attributes.h"
#include "cmd/detail.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/find_derivation.h"
#include "run/model_files.h"
#include "run/picture_file.h"

namespace espalier {
namespace {

template <typename Number, std::size_t N>
bool read_numbers(std::string_view text, std::string_view separators, Number (&out)[N]) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out[i]);
    if (error != std::errc{}) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (i + 1 == N) return text.empty();
    if (text.empty() || separators.find(text[0]) == separators.npos) return false;
    text.remove_prefix(1);
  }
  return false;
}

std::array<std::uint32_t, 2> read_size(const RenderOptions& options) {
  if (options.size.empty()) return options.turntable ? std::array{400u, 300u} : std::array{1200u, 900u};
  std::uint32_t size[2];
  if (!read_numbers(options.size, "x,", size))
    throw Error(fmt::format("--size must be WIDTHxHEIGHT, got \"{}\"", options.size));
  return {size[0], size[1]};
}

std::optional<Vec3> read_place(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  float v[3];
  if (!read_numbers(text, ",", v)) throw Error(fmt::format("{} must be x,y,z in metres, got \"{}\"", option, text));
  return Vec3(v[0], v[1], v[2]);
}

PictureView read_view(const std::string& text) {
  if (text == "full") return PictureView::full;
  if (text == "parts") return PictureView::parts;
  if (text == "bones") return PictureView::bones;
  throw Error(fmt::format("--view must be full, parts or bones, got \"{}\"", text));
}

PictureRequest request_of(const RenderOptions& options) {
  PictureRequest r;
  if (options.turntable == 0u)
    throw Error(fmt::format("--turntable must be from 2 to {}, got 0", PictureRequest::kMostFrames));
  r.size = read_size(options);
  r.eye = read_place("--eye", options.eye), r.at = read_place("--at", options.at);
  if (r.eye && options.azimuth) throw Error("--eye and --azimuth exclude each other");
  if (r.eye && options.elevation) throw Error("--eye and --elevation exclude each other");
  r.azimuth_deg = options.azimuth.value_or(r.azimuth_deg);
  r.elevation_deg = options.elevation.value_or(r.elevation_deg);
  r.fov_deg = options.fov, r.tall = options.tall;
  r.samples = options.samples;
  r.ground = !options.no_ground, r.transparent = options.transparent, r.background = options.background;
  r.view = read_view(options.view);
  r.detail = level_of(options.detail);
  r.targets = options.targets;
  r.frames = options.turntable.value_or(0), r.columns = options.columns;
  if (!options.light.empty() && !options.turntable) throw Error("--light needs --turntable");
  if (!options.light.empty() && options.light != "camera" && options.light != "model")
    throw Error(fmt::format("--light must be camera or model, got \"{}\"", options.light));
  r.fixed_light = options.light == "model";
  return r;
}

}  // namespace

int render_verb(const RenderOptions& options) {
  PictureJob job;
  job.request = request_of(options);
  check(job.request);
  job.derivation = find_derivation(options.file);
  job.grammar = options.grammar, job.attributes = parse_attributes(options.attributes);
  job.out = options.out, job.frames = options.frames;
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const PictureReport report = write_pictures(job, source, *executor);
  print_adapted(report.adapted);
  if (report.truncated) fmt::print(stderr, "warning: {}\n", kTruncated);
  if (!job.frames.empty()) fmt::print("wrote {} frames into {}\n", job.request.frames, job.frames);
  if (!job.out.empty()) fmt::print("wrote {}\n", job.out);
  return kDone;
}

}  // namespace espalier
