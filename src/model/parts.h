#pragma once
// Parts: what of a model is drawn or written, as shared shapes with normals and one entry per instance.

#include <cmath>
#include <cstdint>
#include <vector>

#include "model/model.h"

namespace espalier {

/// A mesh as files and pictures want it: a unit normal per position, no triangle without area.
struct Shape {
  Mesh mesh;
  Bounds box;
  bool open = false;  // not closed: to be seen from both sides
};

struct Part {
  Frame model_from_shape;
  std::uint32_t shape = 0;     // index into Parts::shapes
  std::uint16_t material = 0;  // index into the grammar's materials
  std::uint32_t gene = 0;
};

struct Parts {
  std::vector<Shape> shapes;  // one per mesh and cone ratio, in order of first use
  std::vector<Part> parts;    // in the model's order
};

inline constexpr float kFarthestShown = 1e18f;  // m; beyond, squares of lengths leave single precision

/// Finite and within kFarthestShown: what is not is left out of files, pictures and measures.
inline bool can_be_shown(const Frame& frame) {
  bool inside = true;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) inside &= std::abs(frame.basis[c][r]) <= kFarthestShown;
    inside &= std::abs(frame.origin[c]) <= kFarthestShown;
  }
  return inside;
}

/// The parts that `full` (else: parts) shows. Instances whose frame is not finite, or has no area to show, are left
/// out. `materials` (surfaces.h): shapes have texture coordinates in metres where those ask for them; without, all have
/// one picture per part.
Parts collect_parts(const Model& model, const MeshTable& meshes, bool full,
                    const std::vector<Material>& materials = {});

/// Whether `full` (else: parts) shows an instance, and it can be shown.
bool is_shown(const Instance& instance, bool full);

/// The part's shape in model space: mirrored parts are turned inside out, so that triangles face outwards.
Mesh baked(const Shape& shape, const Frame& model_from_shape);

/// Splits flat-shaded meshes so that every position has its face's normal; drops triangles without area.
Mesh with_normals(const Mesh& mesh);

}  // namespace espalier
