#include "run/picture_request.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "grammar/surface_arguments.h"
#include "run/mesh_look.h"

namespace espalier {
namespace {

constexpr Choice<PictureView> kViews[] = {
    {"full", PictureView::full}, {"parts", PictureView::parts}, {"bones", PictureView::bones}};
constexpr double kFarthest = 1e12;  // m

void check_range(const char* option, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw Error(fmt::format("{} must be from {:g} to {:g}, got {:g}", option, low, high, value));
}

void check_alone(const char* option, bool given, const char* other, bool other_given) {
  if (given && other_given) throw Error(fmt::format("{} and {} exclude each other", option, other));
}

void check_camera(const PictureRequest& r) {
  check_range("--elevation", r.elevation_deg, -90, 90);
  check_range("--azimuth", r.azimuth_deg, -36000, 36000);
  if (r.at && !r.eye) throw Error("--at needs --eye");
  for (const auto& [name, place] : {std::pair{"--eye", r.eye}, {"--at", r.at}}) {
    for (int axis = 0; place && axis < 3; ++axis) check_range(name, (*place)[axis], -kFarthest, kFarthest);
  }
  if (r.eye && r.at && *r.eye == *r.at) throw Error("--eye and --at must differ");
  if (r.fov_deg) check_range("--fov", *r.fov_deg, 0.1, 170);
  if (r.tall) check_range("--tall", *r.tall, 1e-6, kFarthest);
  check_alone("--fov", r.fov_deg.has_value(), "--tall", r.tall.has_value());
}

void check_turntable(const PictureRequest& r) {
  if (r.frames == 0) {
    if (r.columns > 0) throw Error("--columns needs --turntable");
    if (r.fixed_light) throw Error("--light needs --turntable");
    return;
  }
  check_range("--turntable", r.frames, 2, PictureRequest::kMostFrames);
  if (r.columns > r.frames)
    throw Error(fmt::format("--columns must be at most the {} frames, got {}", r.frames, r.columns));
}

/// "#rrggbb"; throws Error for anything else.
Vec3 color_of(const std::string& text) {
  Vec3 color(0);
  bool good = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; good && i < 7; ++i) good = std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
  if (!good) throw Error(fmt::format("--background must be a colour \"#rrggbb\", got \"{}\"", text));
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = linear_light(static_cast<int>(std::stoul(text.substr(1 + 2 * c, 2), nullptr, 16)));
  return color;
}

}  // namespace

void check(const PictureRequest& r) {
  for (const std::uint32_t side : r.size) check_range("--size", side, 1, PictureRequest::kMostSide);
  if (std::uint64_t{r.size[0]} * r.size[1] > PictureRequest::kMostPixels)
    throw Error(fmt::format("--size must be at most {} pixels, got {}x{}", PictureRequest::kMostPixels, r.size[0],
                            r.size[1]));
  check_range("--samples", r.samples, 1, 256);
  check_camera(r);
  check_turntable(r);
  check_alone("--view bones", r.view == PictureView::bones, "--joints or --lod", r.detail.has_value());
  check_alone("--transparent", r.transparent, "--background", !r.background.empty());
  if (!r.background.empty()) color_of(r.background);
}

std::string to_toml(const PictureRequest& r) {
  std::string text = fmt::format("size = [{}, {}]\n", r.size[0], r.size[1]);
  if (r.eye) {
    text += fmt::format("eye = {}\n", format_vector(*r.eye));
    if (r.at) text += fmt::format("at = {}\n", format_vector(*r.at));
  } else {
    text += fmt::format("azimuth_deg = {}\nelevation_deg = {}\n", format_toml(r.azimuth_deg),
                        format_toml(r.elevation_deg));
  }
  if (r.fov_deg) text += fmt::format("fov_deg = {}\n", format_toml(*r.fov_deg));
  if (r.tall) text += fmt::format("tall = {}\n", format_toml(*r.tall));
  text += fmt::format("samples = {}\nground = {}\n", r.samples, r.ground);
  if (r.transparent) text += "transparent = true\n";
  if (!r.background.empty()) text += fmt::format("background = {}\n", quote_toml(r.background));
  for (const Choice<PictureView>& view : kViews) {
    if (view.value == r.view) text += fmt::format("view = \"{}\"\n", view.name);
  }
  if (r.detail) text += to_toml(*r.detail);
  text += fmt::format("targets = {}\n", r.targets);
  if (r.frames == 0) return text;
  text += fmt::format("turntable = {}\nfixed_light = {}\n", r.frames, r.fixed_light);
  if (r.columns > 0) text += fmt::format("columns = {}\n", r.columns);
  if (r.frame) text += fmt::format("frame = {}\n", *r.frame);
  return text;
}

PictureRequest parse_picture_request(std::string_view text, const std::string& name) {
  const TomlValue root = parse_toml(text, name);
  TomlSection s(root, name, "");
  PictureRequest r;
  const auto whole = [&](const char* key, std::uint64_t low, std::uint64_t high, std::uint32_t& value) {
    value = static_cast<std::uint32_t>(s.whole(key, low, high).value_or(value));
  };
  if (const auto size = s.wholes("size", 2, 1, PictureRequest::kMostSide))
    r.size = {static_cast<std::uint32_t>((*size)[0]), static_cast<std::uint32_t>((*size)[1])};
  r.azimuth_deg = s.number("azimuth_deg", -36000, 36000).value_or(r.azimuth_deg);
  r.elevation_deg = s.number("elevation_deg", -90, 90).value_or(r.elevation_deg);
  r.eye = s.vector("eye", -kFarthest, kFarthest), r.at = s.vector("at", -kFarthest, kFarthest);
  r.fov_deg = s.number("fov_deg", 0.1, 170), r.tall = s.number("tall", 1e-6, kFarthest);
  whole("samples", 1, 256, r.samples);
  r.ground = s.boolean("ground").value_or(r.ground);
  r.transparent = s.boolean("transparent").value_or(r.transparent);
  r.background = s.text("background").value_or(r.background);
  r.view = s.choice("view", kViews).value_or(r.view);
  r.detail = level_of_detail(s);
  r.targets = s.boolean("targets").value_or(r.targets);
  whole("turntable", 0, PictureRequest::kMostFrames, r.frames);
  whole("columns", 0, PictureRequest::kMostFrames, r.columns);
  r.fixed_light = s.boolean("fixed_light").value_or(r.fixed_light);
  if (const auto frame = s.whole("frame", 0, PictureRequest::kMostFrames)) r.frame = static_cast<std::uint32_t>(*frame);
  s.finish();
  if (r.frame && *r.frame >= r.frames) s.fail("frame", "must be below turntable");
  check(r);
  return r;
}

RenderSettings render_settings(const PictureRequest& r) {
  RenderSettings s;
  s.width = r.size[0], s.height = r.size[1];
  s.azimuth_deg = static_cast<float>(r.azimuth_deg), s.elevation_deg = static_cast<float>(r.elevation_deg);
  s.full = r.view != PictureView::parts;
  s.detail = r.detail;
  s.samples = static_cast<int>(r.samples);
  if (r.eye) s.place = CameraPlace{*r.eye, r.at};
  if (r.fov_deg) s.fov_deg = static_cast<float>(*r.fov_deg);
  if (r.tall) s.tall = static_cast<float>(*r.tall);
  s.ground = r.ground, s.transparent = r.transparent;
  if (!r.background.empty()) s.background = color_of(r.background);
  return s;
}

}  // namespace espalier
