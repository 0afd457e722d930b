#include "run/curve_view.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {
namespace {

constexpr std::uint32_t kPale = 118;    // of 256: how much of the model's picture is paper
constexpr std::uint32_t kHidden = 150;  // of 256: how strong a wire is seen through bones

void make_pale(Picture& picture) {
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const Colour pale = mix({{picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}}, kPaper, kPale);
    std::copy(std::begin(pale.rgb), std::end(pale.rgb), picture.rgb.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

RenderSettings placed(const CurveDrawing& drawing, RenderSettings look) {
  look.place = drawing.place(look);
  return look;
}

RenderSettings over(RenderSettings look) {
  look.transparent = true, look.ground = false;
  look.background.reset();
  return look;
}

}  // namespace

CurveStage curve_stage(const Setup& setup) {
  CHECK(setup.curves != nullptr);
  return {*setup.curves, setup.meshes, setup.targets};
}

Picture drawn_alone(const LineDrawing& drawing, const RenderSettings& look, Executor& executor) {
  CHECK(look.place.has_value());
  return render(drawing.model, drawing.meshes, drawing.surfaces, {}, over(look), executor);
}

void lay_over(Picture& picture, const Picture& lines, std::uint32_t strength) {
  CHECK(picture.rgb.size() == lines.rgb.size() && lines.rgb.size() == 3 * lines.alpha.size());
  for (std::size_t i = 0; i < lines.alpha.size(); ++i) {
    const std::uint32_t above = lines.alpha[i] * strength / 256;
    const std::uint32_t below = (255 - above) * (picture.alpha.empty() ? 255 : picture.alpha[i]) / 255;
    const std::uint32_t sum = above + below;
    if (sum == 0) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      picture.rgb[c] = static_cast<std::uint8_t>((lines.rgb[c] * above + picture.rgb[c] * below + sum / 2) / sum);
    if (!picture.alpha.empty()) picture.alpha[i] = static_cast<std::uint8_t>(sum);
  }
}

Picture curve_view(const CurveStage& stage, const RenderSettings& look, Executor& executor) {
  const CurveDrawing drawing(stage, {}, mark_curves(stage.curves, {}));
  const LineDrawing& wires = drawing.wires();
  return render(wires.model, wires.meshes, wires.surfaces, drawing.ghosts(), placed(drawing, look), executor);
}

Picture curve_view(const CurveStage& stage, const Model& model, const Surfaces& surfaces, const RenderSettings& look,
                   Executor& executor) {
  const CurveDrawing drawing(stage, model, mark_curves(stage.curves, model));
  const RenderSettings there = placed(drawing, look);
  Picture picture = render(model, stage.meshes, surfaces, drawing.ghosts(), there, executor);
  make_pale(picture);
  lay_over(picture, drawn_alone(drawing.wires_and_bones(), there, executor));
  lay_over(picture, drawn_alone(drawing.wires(), there, executor), kHidden);
  return picture;
}

}  // namespace espalier
