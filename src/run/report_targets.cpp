#include "run/report_targets.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "io/png.h"
#include "render/render.h"
#include "run/curve_view.h"

namespace espalier {
namespace {

constexpr std::size_t kMostCurvesTold = 8;

// "hull.obj (fill 1, spill -1)"
std::string describe(const SceneMesh& mesh) {
  const std::string file = std::filesystem::path(mesh.file).filename().string();
  const char* wish = mesh.fill > 0 ? "fill" : mesh.fill < 0 ? "avoid" : "neutral";
  return fmt::format("{} ({}, weight {:g})", file, wish, mesh.fill);
}

ReportPicture volume_picture(const Setup& setup, const RenderSettings& look, Executor& executor) {
  const Picture drawn = render(Model(), setup.meshes, setup.graph().materials, setup.targets, look, executor);
  ReportPicture picture;
  picture.title = setup.targets.size() == 1 ? "Target volume" : "Target volumes";
  for (const SceneMesh& mesh : setup.scene.volume.meshes) {
    picture.caption += (picture.caption.empty() ? "" : ", ") + describe(mesh);
  }
  picture.png = encode_png(drawn.width, drawn.height, drawn.rgb, "Title", "espalier: targets");
  return picture;
}

/// As the search sees the image: dark is wanted, light is not, mid-grey does not matter.
ReportPicture silhouette_picture(const SilhouetteTarget& target) {
  const WeightImage& image = target.settings().image;
  std::vector<std::uint8_t> rgb;
  for (const std::int32_t degree : image.degrees) {
    const auto grey =
        static_cast<std::uint8_t>((std::int64_t{WeightImage::kFull} - degree) * 255 / (2 * WeightImage::kFull));
    rgb.insert(rgb.end(), 3, grey);
  }
  return {"Target silhouette", fmt::format("{}, {} x {} pixels", target.name(), image.width, image.height),
          encode_png(image.width, image.height, rgb, "Title", "espalier: target")};
}

ReportPicture curves_picture(const Setup& setup, const RenderSettings& look, Executor& executor) {
  const CurveTarget& target = *setup.curves;
  const CurveSettings& settings = target.cost().settings();
  const Picture drawn = curve_view(setup, look, executor);
  std::string caption;
  for (std::uint32_t i = 0; i < std::min<std::size_t>(settings.curves.size(), kMostCurvesTold); ++i)
    caption += curve_in_words(target, i) + ": " + settings_in_words(settings.curves[i]) + ". ";
  if (settings.curves.size() > kMostCurvesTold)
    caption += fmt::format("And {} more. ", settings.curves.size() - kMostCurvesTold);
  for (const std::string& extra : extras_in_words(settings)) caption += extra + ". ";
  return {settings.curves.size() == 1 ? "Guiding curve" : "Guiding curves", caption,
          encode_png(drawn.width, drawn.height, drawn.rgb, "Title", "espalier: targets"),
          legend_of(mark_curves(target, {}), settings)};
}

const char* title_of(OutcomeKind kind) {
  switch (kind) {
    case OutcomeKind::view: return "As the target sees it";
    case OutcomeKind::curves: return "Curves and bones";
    default: return "Hit and missed";
  }
}

}  // namespace

ReportPicture report_picture(const OutcomePicture& drawn) {
  const Picture& p = drawn.picture;
  return {title_of(drawn.kind), drawn.caption,
          encode_png(p.width, p.height, p.rgb, "Title", "espalier: outcome"), drawn.legend};
}

std::vector<ReportPicture> outcome_pictures(const Outcome& outcome, const OutcomeLook& look, Executor& executor) {
  std::vector<ReportPicture> pictures;
  for (const std::string& name : outcome_names(outcome.setup))
    pictures.push_back(report_picture(draw_outcome(outcome, name, look, executor)));
  return pictures;
}

std::vector<ReportPicture> target_pictures(const Setup& setup, const RenderSettings& look, Executor& executor) {
  std::vector<ReportPicture> pictures;
  for (const SilhouetteTarget* target : setup.silhouettes) pictures.push_back(silhouette_picture(*target));
  if (!setup.targets.empty()) pictures.push_back(volume_picture(setup, look, executor));
  if (setup.curves) pictures.push_back(curves_picture(setup, look, executor));
  return pictures;
}

}  // namespace espalier
