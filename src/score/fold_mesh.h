#pragma once
// FoldMesh: a mesh by its edges. Seen from anywhere, the number of faces over a point of the image changes only at
// edges where the mesh folds over (one face turns towards the eye, the other away) or ends. Most edges do neither, so
// that a silhouette needs but a few.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/mesh.h"
#include "score/bit_grid.h"
#include "score/projection.h"

namespace espalier {

struct FoldMesh {
  /// An edge between two faces: `left` runs along it from `from` to `to`, `right` back.
  struct Fold {
    std::uint32_t from, to, left, right;
  };
  /// An edge of one face, or what is left of one of three faces and more, or of two that run along it the same way.
  struct Border {
    std::uint32_t from, to, face;
  };

  /// No two corners in one place. Faces without area count like others.
  FoldMesh() = default;
  FoldMesh(std::span<const Vec3> corners, std::span<const Triangle> triangles);

  std::size_t corners = 0, faces = 0;
  DVec3 middle{0}, half{0};             // of the box around the corners
  TileVector<float> place[3];           // of corners by axis; the last stands there up to a multiple of 8
  TileVector<float> plane[4];           // of faces: (normal, -offset) relative to `middle`; 0 up to a multiple of 8
  std::vector<Fold> folds;
  std::vector<Border> borders;
};

/// A FoldMesh as one image sees it. Pixels count from `origin`.
struct FoldView {
  enum class Result : std::uint8_t {
    nothing,  // not in the image
    ready,
    careful,  // cut by the nearest plane, huge or not finite: left to OutlineMaker
  };
  Result set(const FoldMesh& mesh, const Projection& projection, const Frame& model_from_mesh);

  double matrix[3][4];      // of homogeneous pixels from mesh space
  float eye[4];             // plane . eye > 0: the face looks at the viewer, or away if the mesh is mirrored
  std::int32_t origin[2];
};

}  // namespace espalier
