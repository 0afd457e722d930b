#pragma once
// Levels of detail: one model as four sets of triangles, the coarser ones with about 40, 15 and 5 % of the finest.
// Nothing is grown anew: the same limbs and leaves stand in the same places, with fewer sides, fewer of them, and what
// is left of the leaves larger.

#include <cstdint>
#include <vector>

#include "grammar/material.h"
#include "model/parts.h"

namespace espalier {

/// How round parts that touch end to end are shown: each by itself, or as one tube (limbs.h, tube.h).
enum class Joints : std::uint8_t { separate, smooth };

struct LevelOfDetail {
  static constexpr std::uint32_t kCount = 4;
  static constexpr std::uint64_t kMostTriangles = 20'000'000;
  /// Triangles of each level that are aimed at, as a share of the finest one's.
  static constexpr float kShares[kCount] = {1, 0.4f, 0.15f, 0.05f};

  std::uint32_t level = 0;  // 0: the finest .. kCount - 1
  Joints joints = Joints::separate;

  bool operator==(const LevelOfDetail&) const = default;
};

/// What `full` (else: parts) shows of the model, for files of games: one part per material, in the order in which
/// materials come up, in model space. `materials`: materials_of(graph, model), surfaces.h. A pure function: equal
/// models give equal bytes.
///
/// Round parts have sides by their girth as a share of the model's size, at most as many as the grammar says, and fewer
/// at coarser levels. Foliage (`leaf`, and whatever has a cut-out material) loses corners, then leaves, chosen by a key
/// of their place in the model; those that stay grow to cover as much. Of limbs and details the smallest are left out
/// until the level's share is reached. Boxes and files of rules always stay: a level may be above its share.
Parts parts_at(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
               const LevelOfDetail& lod, bool full = true);

/// Triangles that parts_at gives at most, in a small part of its time: it makes no meshes, and so does not see which
/// triangles would have no area and be left out.
std::uint64_t most_triangles_at(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
                                const LevelOfDetail& lod, bool full = true);

/// Triangles of all parts, as they are written.
std::uint64_t triangle_count(const Parts& parts);

}  // namespace espalier
