#pragma once
// Curve marks: what a skeleton does with guiding curves, segment by segment and bone by bone, for pictures and words.

#include <cstdint>
#include <string>
#include <vector>

#include "render/overlay.h"
#include "score/curve_target.h"

namespace espalier {

/// What a segment of a curve, or a bone, is shown as.
enum class CurveMark : std::uint8_t {
  unused,   // a segment that no bone uses
  used,     // by one bone or more
  follows,  // a bone that distance and alignment make worth something, or at least cost nothing
  strays,   // a bone that they make cost: too far away, or not aligned
};
inline constexpr std::size_t kCurveMarks = 4;

Colour colour_of(CurveMark mark);

struct MarkedCurves {
  std::vector<std::vector<std::uint8_t>> uses;  // per curve, per segment: by how many bones, up to 255
  std::vector<CurveMark> bones;                 // as Model::bones
};

MarkedCurves mark_curves(const CurveTarget& target, const Model& model);

/// "curve 1: 3.87 m in 20 segments of 0.2 m".
std::string curve_in_words(const CurveTarget& target, std::uint32_t curve);
/// "distance 0 + 0 d + 100 d^2, alignment 400 beyond 0.6, utilisation 20, thickness 0 to 0.5 m".
std::string settings_in_words(const GuidingCurve& curve);
/// Of what holds for all curves, a line each; empty where nothing does.
std::vector<std::string> extras_in_words(const CurveSettings& settings);

/// Rows with swatches and counts. Of curves alone, where `marked` has no bones, one row.
std::vector<LegendRow> legend_of(const MarkedCurves& marked, const CurveSettings& settings);

}  // namespace espalier
