#pragma once
// Layered drawings of directed graphs: nodes in rows, edges downwards where they can be, labels of edges as boxes in
// rows of their own, so that nothing overlaps. (Sugiyama, Tagawa and Toda, "Methods for visual understanding of
// hierarchical system structures", 1981; rows are placed by isotonic regression towards the neighbours.)

#include <cstdint>
#include <vector>

#include "render/svg.h"

namespace espalier {

struct LayerNode {
  double width = 0, height = 0;  // of the box; edges end on it
  double beside = 0;             // room to keep free right of the box, for loops
};

/// From one node to another one; loops are the caller's.
struct LayerEdge {
  std::uint32_t from = 0, to = 0;
  double label_width = 0, label_height = 0;
};

struct LayeredRoute {
  std::vector<Point2> points;  // from the edge of one box to that of the other; the curve stands upright at each
  Point2 label;                // centre of the room for the label; the curve passes through it
};

struct LayeredLayout {
  std::vector<Point2> boxes;         // top left corners, in the order of the nodes
  std::vector<LayeredRoute> routes;  // in the order of the edges
  Point2 size;                       // everything lies in 0..size
};

/// Rows, labels and bends of edges that a drawing may have; see lay_out_graph.
inline constexpr std::size_t kMostLayeredItems = 20'000;

/// Row 0 holds the nodes without edges to them; the first node's edges are followed first, and what leads back up is
/// drawn upwards. Throws Error where the drawing would hold more than kMostLayeredItems boxes, labels and bends.
LayeredLayout lay_out_graph(const std::vector<LayerNode>& nodes, const std::vector<LayerEdge>& edges);

/// SVG path data through the points of a route.
std::string route_path(const std::vector<Point2>& points);

}  // namespace espalier
