#pragma once
// ModelSketch: a model seen from afar, as the cells of a coarse grid that its parts touch; and how far apart two are.

#include <cstdint>
#include <vector>

#include "model/expand.h"
#include "score/voxel_grid.h"

namespace espalier {

struct ModelSketch {
  std::vector<std::uint64_t> bits;  // one per cell, x fastest
};

/// 1 - (cells touched by both) / (cells touched by either), in [0, 1]; 0 where neither touches any.
double distance(const ModelSketch& a, const ModelSketch& b);

/// Draws sketches on a grid of cubes over `box`, at most kCells along its longest side. Parts are taken as their boxes;
/// what lies beyond the grid is not seen.
class ModelSketcher {
 public:
  static constexpr std::uint32_t kCells = 32;

  /// `full`: with details, else parts. The graph must outlive it.
  ModelSketcher(const GeneratorGraph& graph, const Bounds& box, bool full);

  /// Reuses the storage of `sketch`. Costs about as much as scoring.
  void draw(const Derivation& derivation, ModelSketch& sketch);
  /// The same for a model that is there already.
  void draw(const Model& model, ModelSketch& sketch) const;

 private:
  void touch(const Instance& instance, ModelSketch& sketch) const;
  void touch_by_samples(const Frame& cells_from_part, const int (&steps)[3], ModelSketch& sketch) const;
  void touch_by_cells(const Frame& cells_from_part, ModelSketch& sketch) const;
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return x + cells_[0] * (y + cells_[1] * z); }

  bool full_;
  Vec3 min_;
  float cell_ = 1;
  std::uint32_t cells_[3] = {1, 1, 1};
  Expander expander_;
  Model model_;
};

}  // namespace espalier
