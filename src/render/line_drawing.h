#pragma once
// LineDrawing: bones and curves as solid things to be drawn. A bone is a double pyramid, widest near its joint; a curve
// is a round wire with a ball where it begins and an arrowhead where it ends.

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/surfaces.h"
#include "render/paint.h"

namespace espalier {

/// What is drawn names its ink by index.
struct LineDrawing {
  Model model;
  MeshTable meshes;
  Surfaces surfaces;
};

/// Nothing drawn yet. `glow`: light that lines send out, per unit of colour, so that their shaded sides keep it.
LineDrawing start_drawing(const std::vector<Colour>& inks, float glow = 0);

/// `thick`: at most, m; a bone without length is left out. The parts belong to the bone's gene.
void draw_bone(LineDrawing& drawing, const Bone& bone, float thick, std::uint16_t ink);

/// Through the points, at least two; inks[i] is that of the piece from points[i] to points[i + 1]. Pieces without length
/// are left out.
void draw_wire(LineDrawing& drawing, std::span<const Vec3> points, std::span<const std::uint16_t> inks, float radius);

}  // namespace espalier
