#include "score/model_change.h"

#include <algorithm>
#include <cstring>

namespace espalier {

bool same_part(const Instance& a, const Instance& b) {
  static_assert(sizeof(Frame) == 12 * sizeof(float));  // nothing but numbers to compare
  return a.mesh == b.mesh && a.layer == b.layer && std::memcmp(&a.top, &b.top, sizeof(float)) == 0 &&
         std::memcmp(&a.model_from_mesh, &b.model_from_mesh, sizeof(Frame)) == 0;
}

ModelChange find_change(std::span<const Instance> before, std::span<const Instance> after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  std::size_t first = 0, last = 0;
  while (first < shorter && same_part(before[first], after[first])) ++first;
  while (first + last < shorter && same_part(before[before.size() - 1 - last], after[after.size() - 1 - last])) ++last;
  return {before, first, before.subspan(first, before.size() - last - first),
          after.subspan(first, after.size() - last - first)};
}

}  // namespace espalier
