#pragma once
// LayerRows: the rows of a layered drawing while it is made. Items are boxes, labels and bends; links join items of
// neighbouring rows. Internal to layered_layout.

#include <cstdint>
#include <utility>
#include <vector>

namespace espalier {

struct LayerItem {
  std::uint32_t row = 0;
  double left = 0, right = 0;  // room on both sides of x
  double height = 0;
  double weight = 1;           // how much it wants to stand between its neighbours
  double x = 0;
  std::uint32_t place = 0;     // in its row
  std::vector<std::uint32_t> above, below;  // linked items
};

struct LayerRows {
  std::vector<LayerItem> items;
  std::vector<std::vector<std::uint32_t>> rows;

  void link(std::uint32_t upper, std::uint32_t lower) {
    items[upper].below.push_back(lower);
    items[lower].above.push_back(upper);
  }
};

/// Orders every row so that few links cross: barycentres, swept down and up; the best order that was met stays.
void order_rows(LayerRows& rows);
/// The number of pairs of links that cross.
std::uint64_t count_crossings(const LayerRows& rows);
/// The numbers nearest to `wished` (least squares, weighted) of which each is at least `room` above the one before it.
std::vector<double> nearest_in_order(const std::vector<double>& wished, const std::vector<double>& weights,
                                     const std::vector<double>& room);
/// Sets x so that items keep their order and `gap`, and stand as near as they can to the middle of what they link to.
void place_rows(LayerRows& rows, double gap);

}  // namespace espalier
