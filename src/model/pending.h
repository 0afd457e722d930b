#pragma once
// Pending: a gene's copy or a detail call that waits to be run, and the queue that holds such. Internal to expansion.

#include <cstdint>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

/// Four floats side by side; the fourth lane of points and axes is 0.
using Lanes = float __attribute__((vector_size(16)));

/// What the statements of a block change and its end brings back (language.md 23).
struct State {
  Lanes axis[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};  // columns of the frame's basis
  Lanes origin = {0, 0, 0, 0};
  Lanes scope = {1, 1, 1, 0};
  std::uint64_t key = 0;
  std::int32_t bone = -1;
  float material = 0;
};

struct Pending {
  State state;
  GenePosition at;            // gene, first slot state, first draw
  std::uint32_t depth = 0;
  std::uint16_t program = 0;  // details: which
};

/// Pending items with `stride` floats of arguments each; storage is kept between uses.
class PendingQueue {
 public:
  void reset(std::uint32_t stride) {
    stride_ = stride;
    size_ = 0;
  }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const Pending& operator[](std::size_t i) const { return items_[i]; }
  const float* floats(std::size_t i) const { return floats_.data() + i * stride_; }
  float* floats(std::size_t i) { return floats_.data() + i * stride_; }
  /// Room for one more item; what it holds is left over from earlier.
  Pending& push(float*& floats) {
    if (size_ == items_.size()) grow();
    floats = floats_.data() + size_ * stride_;
    return items_[size_++];
  }
  void pop_back() { --size_; }

 private:
  void grow() {
    items_.resize(2 * items_.size() + 64);
    floats_.resize(items_.size() * stride_);
  }

  std::uint32_t stride_ = 0;
  std::size_t size_ = 0;
  std::vector<Pending> items_;
  std::vector<float> floats_;
};

}  // namespace espalier
