#pragma once
// FacetScan: the inside of any mesh along rows in z, by parity of crossings, one tile row of eight at a time. Scalar,
// double precision; neighbouring triangles share their edges exactly, so no row slips between them or hits both.

#include <cstdint>
#include <vector>

#include "score/bit_grid.h"
#include "score/lattice.h"
#include "score/solid.h"

namespace espalier {

class FacetScan {
 public:
  /// Places the mesh; false if it reaches no lattice point of the window [low, high).
  bool begin(const Mesh& mesh, const GridPlacement& placement, const std::int32_t low[3], const std::int32_t high[3]);

  /// The lattice points that the mesh may cover, clipped to the window.
  const Reach& reach() const { return reach_; }
  /// Words along z that the reach touches: absolute numbers, floor(z / 32).
  std::int32_t first_word() const { return first_word_; }
  std::int32_t words() const { return words_; }

  /// Scans rows 8 * tile .. + 7. The bits of row y and word w at x are at result[((x - reach.low[0]) * words() + w -
  /// first_word()) * 8 + y % 8]. Rows that cross the mesh an odd number of times (it is open there) are empty.
  const std::uint32_t* scan(std::int32_t tile);

 private:
  struct Facet {
    std::uint32_t corner[3];  // ordered by y, then x, then z
    std::int32_t row_low, row_high;
  };
  void scan_row(const Facet& facet, std::int32_t y);
  void cross(std::int32_t x, std::int32_t lane, double z);
  void drop_open_rows();

  Reach reach_;
  std::int32_t first_word_ = 0, words_ = 0;
  std::vector<double> position_;  // 3 per vertex, lattice coordinates
  std::vector<Facet> facets_;
  TileVector<std::uint32_t> bits_;
  std::vector<std::uint8_t> odd_;  // per x: rows crossed an odd number of times so far
};

}  // namespace espalier
