#pragma once
// Thinned: rows of a series that may go on for ever, of which a bounded number is kept: all at first, then every second,
// every fourth and so on, and always the last. What is kept depends on the rows' numbers alone.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/check.h"

namespace espalier {

template <typename Row>
class Thinned {
 public:
  struct Numbered {
    std::uint64_t number;
    Row row;
  };

  /// `most` >= 2: rows that are kept, the last aside.
  explicit Thinned(std::size_t most) : most_(most) { CHECK(most >= 2); }

  /// Whether the row of this number outlasts its successor.
  bool keeps(std::uint64_t number) const { return number % stride_ == 0; }
  /// `number` is greater than every one before.
  void add(std::uint64_t number, Row row) {
    CHECK(rows_.empty() || number > rows_.back().number);
    if (!rows_.empty() && !keeps(rows_.back().number)) rows_.pop_back();
    rows_.push_back({number, std::move(row)});
    while (rows_.size() > most_ + 1) thin();
  }
  const std::vector<Numbered>& rows() const { return rows_; }

  /// What `restore` makes an equal series of.
  std::uint64_t stride() const { return stride_; }
  void restore(std::uint64_t stride, std::vector<Numbered> rows) {
    CHECK(stride > 0);
    stride_ = stride, rows_ = std::move(rows);
  }

 private:
  void thin() {
    stride_ *= 2;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!keeps(rows_[i].number) && i + 1 < rows_.size()) continue;
      if (kept != i) rows_[kept] = std::move(rows_[i]);
      ++kept;
    }
    rows_.resize(kept);
  }

  std::size_t most_;
  std::uint64_t stride_ = 1;
  std::vector<Numbered> rows_;
};

}  // namespace espalier
