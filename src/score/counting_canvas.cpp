#include "score/counting_canvas.h"

#include <algorithm>

namespace espalier {

void CountingCanvas::keep() {
  for (const std::uint32_t block : touched) marked[block / blocks * marks_per_row + block % blocks / 64] = 0;
  touched.clear();
  std::fill(std::begin(overflow), std::end(overflow), 0);
}

void CountingCanvas::undo() {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    std::memcpy(planes.data() + touched[i] * kBlockWords, copies.data() + i * kBlockWords,
                kBlockWords * sizeof(std::uint32_t));
  }
  keep();
}

void CountingCanvas::clear() {
  keep();
  for (std::size_t at = 0; at < used.size(); ++at) {
    for (std::uint64_t bits = used[at]; bits != 0; bits &= bits - 1) {
      const std::size_t in_row = at % marks_per_row * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t block = at / marks_per_row * blocks + in_row;
      std::fill_n(planes.data() + block * kBlockWords, kBlockWords, 0u);
    }
    used[at] = 0;
  }
}

}  // namespace espalier
