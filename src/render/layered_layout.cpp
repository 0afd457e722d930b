#include "render/layered_layout.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "render/layer_rows.h"

namespace espalier {
namespace {

constexpr double kGapAcross = 24, kGapDown = 18;
constexpr double kPortMargin = 10, kPortGap = 16;
constexpr double kBendWeight = 4;  // long edges rather run straight

class LayeredDrawing {
 public:
  LayeredDrawing(const std::vector<LayerNode>& nodes, const std::vector<LayerEdge>& edges)
      : nodes_(nodes), edges_(edges), upwards_(edges.size(), false), row_of_(nodes.size(), 0) {}

  LayeredLayout run() {
    turn_cycles();
    find_rows();
    make_items();
    order_rows(rows_);
    place_rows(rows_, kGapAcross);
    return finish();
  }

 private:
  std::uint32_t upper(std::size_t e) const { return upwards_[e] ? edges_[e].to : edges_[e].from; }
  std::uint32_t lower(std::size_t e) const { return upwards_[e] ? edges_[e].from : edges_[e].to; }

  // Depth first from every node in turn: an edge back to a node that is still being followed is turned round.
  void turn_cycles() {
    std::vector<std::vector<std::size_t>> out(nodes_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      CHECK(edges_[e].from != edges_[e].to && edges_[e].from < nodes_.size() && edges_[e].to < nodes_.size());
      out[edges_[e].from].push_back(e);
    }
    enum : char { fresh, followed, done };
    std::vector<char> state(nodes_.size(), fresh);
    std::vector<std::pair<std::uint32_t, std::size_t>> stack;  // node, next of its edges
    for (std::uint32_t root = 0; root < nodes_.size(); ++root) {
      if (state[root] == fresh) stack.push_back({root, 0}), state[root] = followed;
      while (!stack.empty()) {
        auto& [node, next] = stack.back();
        if (next == out[node].size()) {
          state[node] = done;
          stack.pop_back();
          continue;
        }
        const std::size_t e = out[node][next++];
        const std::uint32_t to = edges_[e].to;
        if (state[to] == followed) upwards_[e] = true;
        if (state[to] == fresh) stack.push_back({to, 0}), state[to] = followed;
      }
    }
  }

  // Longest ways from the top. Labels take the rows between.
  void find_rows() {
    std::vector<std::size_t> incoming(nodes_.size(), 0);
    std::vector<std::vector<std::uint32_t>> out(nodes_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      out[upper(e)].push_back(lower(e));
      ++incoming[lower(e)];
    }
    std::vector<std::uint32_t> ready;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (incoming[n] == 0) ready.push_back(n);
    }
    for (std::size_t at = 0; at < ready.size(); ++at) {
      for (const std::uint32_t to : out[ready[at]]) {
        row_of_[to] = std::max(row_of_[to], row_of_[ready[at]] + 2);
        if (--incoming[to] == 0) ready.push_back(to);
      }
    }
    CHECK(ready.size() == nodes_.size());
  }

  std::uint32_t add_item(LayerItem item) {
    if (rows_.items.size() >= kMostLayeredItems) {
      throw Error(fmt::format("{} nodes and {} edges are too many to draw: at most {} boxes, labels and bends",
                              nodes_.size(), edges_.size(), kMostLayeredItems));
    }
    if (item.row >= rows_.rows.size()) rows_.rows.resize(item.row + 1);
    rows_.rows[item.row].push_back(static_cast<std::uint32_t>(rows_.items.size()));
    rows_.items.push_back(std::move(item));
    return static_cast<std::uint32_t>(rows_.items.size() - 1);
  }

  void make_items() {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      LayerItem item;
      item.row = row_of_[n];
      item.left = nodes_[n].width / 2;
      item.right = nodes_[n].width / 2 + nodes_[n].beside;
      item.height = nodes_[n].height;
      add_item(item);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t top = row_of_[upper(e)], bottom = row_of_[lower(e)];
      const std::uint32_t label_row = (top + (bottom - top) / 2) | 1;  // nodes stand in even rows
      std::vector<std::uint32_t>& chain = chains_.emplace_back(1, upper(e));
      for (std::uint32_t row = top + 1; row < bottom; ++row) {
        LayerItem item;
        item.row = row;
        item.weight = kBendWeight;
        if (row == label_row) {
          item.left = item.right = edges_[e].label_width / 2;
          item.height = edges_[e].label_height;
        }
        chain.push_back(add_item(item));
      }
      chain.push_back(lower(e));
      for (std::size_t i = 1; i < chain.size(); ++i) rows_.link(chain[i - 1], chain[i]);
      label_items_.push_back(chain[label_row - top]);
    }
  }

  // Where edges end on the upper or lower side of their nodes: as near as can be to straight above or below the next
  // item, apart from each other, and on the side.
  std::vector<double> ports(bool lower_side) const {
    std::vector<std::vector<std::pair<double, std::size_t>>> ends(nodes_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::vector<std::uint32_t>& chain = chains_[e];
      const std::uint32_t next = lower_side ? chain[1] : chain[chain.size() - 2];
      ends[lower_side ? upper(e) : lower(e)].push_back({rows_.items[next].x, e});
    }
    std::vector<double> x(edges_.size(), 0);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (ends[n].empty()) continue;
      std::sort(ends[n].begin(), ends[n].end());
      const double reach = std::max(0.0, nodes_[n].width / 2 - kPortMargin), middle = rows_.items[n].x;
      const double apart = std::min(kPortGap, 2 * reach / static_cast<double>(ends[n].size()));
      std::vector<double> wished;
      for (std::size_t i = 0; i < ends[n].size(); ++i) {
        const double low = apart * static_cast<double>(i), high = apart * static_cast<double>(ends[n].size() - 1 - i);
        wished.push_back(std::clamp(ends[n][i].first, middle - reach + low, middle + reach - high));
      }
      const std::vector<double> same(wished.size(), 1), room(wished.size(), apart);
      const std::vector<double> placed = nearest_in_order(wished, same, room);
      for (std::size_t i = 0; i < placed.size(); ++i) x[ends[n][i].second] = placed[i];
    }
    return x;
  }

  LayeredLayout finish() {
    LayeredLayout layout;
    double least = 0, y = 0;
    for (const LayerItem& item : rows_.items) least = std::min(least, item.x - item.left);
    std::vector<double> top, bottom;
    for (const auto& row : rows_.rows) {
      double height = 0;
      for (const std::uint32_t i : row) height = std::max(height, rows_.items[i].height);
      top.push_back(y);
      bottom.push_back(y + height);
      y += height + kGapDown;
    }
    layout.size.y = rows_.rows.empty() ? 0 : y - kGapDown;
    for (LayerItem& item : rows_.items) {
      item.x -= least;
      layout.size.x = std::max(layout.size.x, item.x + item.right);
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const double middle = (top[row_of_[n]] + bottom[row_of_[n]]) / 2;
      layout.boxes.push_back({rows_.items[n].x - nodes_[n].width / 2, middle - nodes_[n].height / 2});
    }
    const std::vector<double> starts = ports(true), ends = ports(false);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      LayeredRoute& route = layout.routes.emplace_back();
      const double start = starts[e], end = ends[e];
      route.points = {{start, layout.boxes[upper(e)].y + nodes_[upper(e)].height}, {start, bottom[row_of_[upper(e)]]}};
      for (std::size_t i = 1; i + 1 < chains_[e].size(); ++i) {
        const LayerItem& item = rows_.items[chains_[e][i]];
        route.points.push_back({item.x, top[item.row]});
        route.points.push_back({item.x, bottom[item.row]});
      }
      route.points.push_back({end, top[row_of_[lower(e)]]});
      route.points.push_back({end, layout.boxes[lower(e)].y});
      const LayerItem& label = rows_.items[label_items_[e]];
      route.label = {label.x, (top[label.row] + bottom[label.row]) / 2};
      if (upwards_[e]) std::reverse(route.points.begin(), route.points.end());
    }
    return layout;
  }

  const std::vector<LayerNode>& nodes_;
  const std::vector<LayerEdge>& edges_;
  std::vector<bool> upwards_;           // per edge: turned round
  std::vector<std::uint32_t> row_of_;   // per node, even
  LayerRows rows_;                      // items: the nodes first
  std::vector<std::vector<std::uint32_t>> chains_;  // per edge: its items, from the upper node to the lower
  std::vector<std::uint32_t> label_items_;
};

}  // namespace

LayeredLayout lay_out_graph(const std::vector<LayerNode>& nodes, const std::vector<LayerEdge>& edges) {
  return LayeredDrawing(nodes, edges).run();
}

std::string route_path(const std::vector<Point2>& points) {
  std::string d;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2& p = points[i];
    const std::string place = svg_number(p.x) + " " + svg_number(p.y);
    if (i == 0) {
      d = "M" + place;
    } else if (points[i - 1].x == p.x) {
      if (points[i - 1].y != p.y) d += "L" + place;
    } else {
      const std::string middle = svg_number((points[i - 1].y + p.y) / 2);
      d += fmt::format("C{} {} {} {} {}", svg_number(points[i - 1].x), middle, svg_number(p.x), middle, place);
    }
  }
  return d;
}

}  // namespace espalier
