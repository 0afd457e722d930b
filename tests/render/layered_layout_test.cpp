#include "render/layered_layout.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/error.h"
#include "render/layer_rows.h"

namespace espalier {
namespace {

struct Box {
  double left, top, right, bottom;
};

bool apart(const Box& a, const Box& b) {
  constexpr double kSlack = 1e-6;
  return a.right <= b.left + kSlack || b.right <= a.left + kSlack || a.bottom <= b.top + kSlack ||
         b.bottom <= a.top + kSlack;
}

struct Graph {
  std::vector<LayerNode> nodes;
  std::vector<LayerEdge> edges;
};

Graph random_graph(bool cycles) {
  Graph g;
  const auto n = *rc::gen::inRange<std::uint32_t>(1, 14);
  for (std::uint32_t i = 0; i < n; ++i) {
    g.nodes.push_back({double(*rc::gen::inRange(20, 200)), double(*rc::gen::inRange(20, 90)),
                       double(*rc::gen::inRange(0, 2) * 60)});
  }
  for (int e = *rc::gen::inRange(0, 30); e > 0 && n > 1; --e) {
    auto from = *rc::gen::inRange<std::uint32_t>(0, n), to = *rc::gen::inRange<std::uint32_t>(0, n);
    if (from == to) continue;
    if (!cycles && from > to) std::swap(from, to);
    const bool label = *rc::gen::arbitrary<bool>();
    g.edges.push_back({from, to, label ? 40.0 : 0.0, label ? 16.0 : 6.0});
  }
  return g;
}

void check_layout(const Graph& g, const LayeredLayout& layout, bool cycles) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < g.nodes.size(); ++i) {
    const Point2 at = layout.boxes[i];
    boxes.push_back({at.x, at.y, at.x + g.nodes[i].width + g.nodes[i].beside, at.y + g.nodes[i].height});
  }
  for (std::size_t e = 0; e < g.edges.size(); ++e) {
    const Point2 c = layout.routes[e].label;
    const LayerEdge& edge = g.edges[e];
    boxes.push_back({c.x - edge.label_width / 2, c.y - edge.label_height / 2, c.x + edge.label_width / 2,
                     c.y + edge.label_height / 2});
    const Box& from = boxes[edge.from];
    const Box& to = boxes[edge.to];
    if (!cycles) RC_ASSERT(from.bottom <= to.top);
    const bool down = from.bottom <= to.top;
    const std::vector<Point2>& p = layout.routes[e].points;
    RC_ASSERT(p.front().y == (down ? from.bottom : from.top));
    RC_ASSERT(p.back().y == (down ? to.top : to.bottom));
    RC_ASSERT(p.front().x >= from.left && p.front().x <= from.left + g.nodes[edge.from].width);
    RC_ASSERT(p.back().x >= to.left && p.back().x <= to.left + g.nodes[edge.to].width);
    RC_ASSERT(std::any_of(p.begin(), p.end(), [&](const Point2& q) { return q.x == c.x; }));
  }
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    RC_ASSERT(boxes[a].left >= -1e-6 && boxes[a].top >= -1e-6);
    RC_ASSERT(boxes[a].right <= layout.size.x + 1e-6 && boxes[a].bottom <= layout.size.y + 1e-6);
    for (std::size_t b = 0; b < a; ++b) RC_ASSERT(apart(boxes[a], boxes[b]));
  }
}

RC_GTEST_PROP(LayeredLayout, BoxesAndLabelsKeepClearOfEachOtherAndEdgesLeadDown, ()) {
  const Graph g = random_graph(false);
  check_layout(g, lay_out_graph(g.nodes, g.edges), false);
}

RC_GTEST_PROP(LayeredLayout, CyclesAreDrawnToo, ()) {
  const Graph g = random_graph(true);
  check_layout(g, lay_out_graph(g.nodes, g.edges), true);
}

RC_GTEST_PROP(LayeredLayout, CrossingsAreCountedAndOrderingAddsNone, ()) {
  LayerRows rows;
  const auto n = *rc::gen::inRange<std::uint32_t>(1, 8), m = *rc::gen::inRange<std::uint32_t>(1, 8);
  rows.rows.resize(2);
  rows.items.resize(n + m);
  for (std::uint32_t i = 0; i < n + m; ++i) {
    rows.items[i].row = i >= n;
    rows.items[i].place = i >= n ? i - n : i;
    rows.rows[i >= n].push_back(i);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  for (int k = *rc::gen::inRange(0, 20); k > 0; --k) {
    links.push_back({*rc::gen::inRange(0u, n), *rc::gen::inRange(0u, m)});
    rows.link(links.back().first, n + links.back().second);
  }
  std::uint64_t expected = 0;
  for (std::size_t a = 0; a < links.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto [u, v] = links[a];
      const auto [x, y] = links[b];
      expected += (u < x && v > y) || (u > x && v < y);
    }
  RC_ASSERT(count_crossings(rows) == expected);
  order_rows(rows);
  RC_ASSERT(count_crossings(rows) <= expected);
}

RC_GTEST_PROP(LayeredLayout, NearestInOrderIsTheBestThatKeepsTheRoom, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 7);
  std::vector<double> wished, weights, room;
  for (std::size_t i = 0; i < n; ++i) {
    wished.push_back(*rc::gen::inRange(-20, 20));
    weights.push_back(*rc::gen::inRange(1, 5));
    room.push_back(*rc::gen::inRange(0, 6));
  }
  const std::vector<double> x = nearest_in_order(wished, weights, room);
  const auto cost = [&](const std::vector<double>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += weights[i] * (y[i] - wished[i]) * (y[i] - wished[i]);
    return sum;
  };
  for (std::size_t i = 1; i < n; ++i) RC_ASSERT(x[i] - x[i - 1] >= room[i] - 1e-9);
  // Convex: no small feasible step of any run of neighbours may be better.
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a; b < n; ++b)
      for (const double step : {-1e-3, 1e-3}) {
        std::vector<double> y = x;
        for (std::size_t i = a; i <= b; ++i) y[i] += step;
        const bool fits = (a == 0 || y[a] - y[a - 1] >= room[a]) && (b + 1 == n || y[b + 1] - y[b] >= room[b + 1]);
        if (fits) RC_ASSERT(cost(y) >= cost(x) - 1e-9);
      }
}

TEST(LayeredLayout, AGraphThatIsTooLargeIsRefused) {
  const std::vector<LayerNode> nodes(kMostLayeredItems + 1, LayerNode{10, 10, 0});
  EXPECT_THROW(lay_out_graph(nodes, {}), Error);
}

}  // namespace
}  // namespace espalier
