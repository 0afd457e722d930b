#pragma once
// ModelChange: how one model differs from another, as targets see it. Derivations are in depth-first order, so that
// what a proposal changes is most often one slice of the instances.

#include <cstddef>
#include <span>

#include "model/model.h"

namespace espalier {

/// before[first, first + removed.size()) gave way to `added`; all else is the same and in the same order.
struct ModelChange {
  std::span<const Instance> before;
  std::size_t first = 0;
  std::span<const Instance> removed, added;
};

/// Equal to every target: frames and ratios bit by bit, mesh and layer. Genes and materials aside.
bool same_part(const Instance& a, const Instance& b);

/// The two models up to what their beginnings and ends have in common. Refers to both.
ModelChange find_change(std::span<const Instance> before, std::span<const Instance> after);

}  // namespace espalier
