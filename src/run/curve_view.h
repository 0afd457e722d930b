#pragma once
// Curve view: a scene's guiding curves as a picture: alone, or over a model and its bones. Whatever would hide them,
// curves and bones are seen whole; segments that are used differ from those that are not.

#include "base/executor.h"
#include "render/render.h"
#include "run/curve_drawing.h"
#include "run/setup.h"

namespace espalier {

/// The scene must have curves.
CurveStage curve_stage(const Setup& setup);

/// From the side that `look` says, framed to show all.
Picture curve_view(const CurveStage& stage, const RenderSettings& look, Executor& executor);
/// The same over a model made pale, with its bones.
Picture curve_view(const CurveStage& stage, const Model& model, const Surfaces& surfaces, const RenderSettings& look,
                   Executor& executor);

/// Lines, drawn with a transparent background, laid over a picture of the same size. `strength`: of 256.
void lay_over(Picture& picture, const Picture& lines, std::uint32_t strength = 256);

/// The drawing alone, to be laid over a picture that was drawn with `look`, which has a place.
Picture drawn_alone(const LineDrawing& drawing, const RenderSettings& look, Executor& executor);

}  // namespace espalier
