#include "render/layer_rows.h"

#include <algorithm>

namespace espalier {
namespace {

constexpr int kOrderSweeps = 24;
constexpr int kPlaceSweeps = 24;

void number_row(LayerRows& rows, const std::vector<std::uint32_t>& row) {
  for (std::uint32_t i = 0; i < row.size(); ++i) rows.items[row[i]].place = i;
}

// By the mean place of the links in the row before; items without any keep theirs.
void order_row(LayerRows& rows, std::vector<std::uint32_t>& row, bool downwards) {
  std::vector<std::pair<double, std::uint32_t>> keyed;
  for (const std::uint32_t i : row) {
    const LayerItem& item = rows.items[i];
    const auto& links = downwards ? item.above : item.below;
    double sum = 0;
    for (const std::uint32_t other : links) sum += rows.items[other].place;
    keyed.push_back({links.empty() ? item.place : sum / static_cast<double>(links.size()), i});
  }
  std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = keyed[k].second;
  number_row(rows, row);
}

struct Wish {
  double sum = 0, weight = 0;  // weighted places wished for, less the room before
  std::size_t count = 0;
  double mean() const { return sum / weight; }
};

void place_row(LayerRows& rows, const std::vector<std::uint32_t>& row, const std::vector<double>& wished, double gap) {
  std::vector<double> weights, room;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const LayerItem& item = rows.items[row[k]];
    weights.push_back(item.weight);
    room.push_back(k > 0 ? rows.items[row[k - 1]].right + gap + item.left : 0);
  }
  const std::vector<double> x = nearest_in_order(wished, weights, room);
  for (std::size_t k = 0; k < row.size(); ++k) rows.items[row[k]].x = x[k];
}

}  // namespace

// Pool adjacent violators: less the room before them the numbers need only ascend.
std::vector<double> nearest_in_order(const std::vector<double>& wished, const std::vector<double>& weights,
                                     const std::vector<double>& room) {
  std::vector<Wish> blocks;
  double before = 0;
  for (std::size_t k = 0; k < wished.size(); ++k) {
    before += k > 0 ? room[k] : 0;
    blocks.push_back({(wished[k] - before) * weights[k], weights[k], 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() >= blocks.back().mean()) {
      const Wish last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().weight += last.weight;
      blocks.back().count += last.count;
    }
  }
  std::vector<double> placed;
  before = 0;
  for (const Wish& block : blocks) {
    for (std::size_t i = 0; i < block.count; ++i) {
      before += placed.empty() ? 0 : room[placed.size()];
      placed.push_back(block.mean() + before);
    }
  }
  return placed;
}

std::uint64_t count_crossings(const LayerRows& rows) {
  std::uint64_t crossings = 0;
  for (const auto& row : rows.rows) {
    // Links in the order of their upper ends; what was seen before and ends further right crosses.
    std::vector<std::uint32_t> ends, sorted;
    for (const std::uint32_t i : row) {
      sorted.clear();
      for (const std::uint32_t other : rows.items[i].below) sorted.push_back(rows.items[other].place);
      std::sort(sorted.begin(), sorted.end());
      ends.insert(ends.end(), sorted.begin(), sorted.end());
    }
    std::vector<std::uint32_t> tree(ends.empty() ? 0 : *std::max_element(ends.begin(), ends.end()) + 2, 0);
    for (std::size_t seen = 0; seen < ends.size(); ++seen) {
      std::uint64_t not_right = 0;
      for (std::size_t i = ends[seen] + 1; i > 0; i -= i & (~i + 1)) not_right += tree[i];
      crossings += seen - not_right;
      for (std::size_t i = ends[seen] + 1; i < tree.size(); i += i & (~i + 1)) ++tree[i];
    }
  }
  return crossings;
}

void order_rows(LayerRows& rows) {
  for (const auto& row : rows.rows) number_row(rows, row);
  auto best = rows.rows;
  std::uint64_t fewest = count_crossings(rows);
  for (int sweep = 0; sweep < kOrderSweeps && fewest > 0; ++sweep) {
    const bool downwards = sweep % 2 == 0;
    for (std::size_t r = 0; r < rows.rows.size(); ++r) {
      order_row(rows, rows.rows[downwards ? r : rows.rows.size() - 1 - r], downwards);
    }
    if (const std::uint64_t now = count_crossings(rows); now < fewest) {
      fewest = now;
      best = rows.rows;
    }
  }
  rows.rows = best;
  for (const auto& row : rows.rows) number_row(rows, row);
}

void place_rows(LayerRows& rows, double gap) {
  std::vector<double> wished;
  for (const auto& row : rows.rows) place_row(rows, row, std::vector<double>(row.size(), 0), gap);
  for (int sweep = 0; sweep < kPlaceSweeps; ++sweep) {
    // Down, up, and at last between both sides.
    const bool both = sweep >= kPlaceSweeps - 8, downwards = sweep % 2 == 0;
    for (std::size_t r = 0; r < rows.rows.size(); ++r) {
      const auto& row = rows.rows[downwards ? r : rows.rows.size() - 1 - r];
      wished.clear();
      for (const std::uint32_t i : row) {
        const LayerItem& item = rows.items[i];
        double sum = 0;
        std::size_t count = 0;
        if (both || downwards) for (const std::uint32_t other : item.above) sum += rows.items[other].x, ++count;
        if (both || !downwards) for (const std::uint32_t other : item.below) sum += rows.items[other].x, ++count;
        wished.push_back(count > 0 ? sum / static_cast<double>(count) : item.x);
      }
      place_row(rows, row, wished, gap);
    }
  }
}

}  // namespace espalier
