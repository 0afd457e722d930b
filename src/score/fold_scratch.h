#pragma once
// FoldScratch: what one thread keeps while it draws FoldMeshes.

#include <cstdint>
#include <vector>

#include "score/bit_grid.h"
#include "score/fold_mesh.h"

namespace espalier {

struct FoldScratch {
  /// An edge that matters and crosses rows: from corner `upper` down to corner `lower`; to its right `step` more faces
  /// lie over the image than to its left.
  struct Step {
    std::uint32_t upper, lower;
    std::int32_t step;
  };

  FoldView view;
  TileVector<float> x, y;         // pixels of corners, relative to view.origin
  TileVector<std::int32_t> row;   // the first row whose middle lies at or below a corner
  TileVector<std::int32_t> turn;  // of faces: -1 where plane . eye > 0, else 0
  std::vector<std::uint32_t> folded;  // of FoldMesh::folds, those whose faces turn different ways
  std::vector<Step> steps;            // the first `kept`
  std::size_t kept = 0;
  // Counts of faces that begin at a pixel, by strips of eight rows: [strip][column][row % 8], all 0 between meshes;
  // and for each 32 of them whether there are any.
  TileVector<std::int32_t> begins;
  std::vector<std::uint8_t> touched;

  void reserve(const FoldMesh& mesh) {
    if (x.size() < mesh.place[0].size()) x.resize(mesh.place[0].size()), y.resize(x.size()), row.resize(x.size());
    if (turn.size() < mesh.plane[0].size()) turn.resize(mesh.plane[0].size());
    const std::size_t most = mesh.folds.size() + mesh.borders.size() + 1;
    if (steps.size() < most) steps.resize(most), folded.resize(most);
  }
};

}  // namespace espalier
