#pragma once

#include <cstdint>

#include "model/model.h"

namespace espalier {

/// Which instances a target counts: emits of rules with proxies, or emits of rules without proxies and details.
enum class VolumeView : std::uint8_t { parts, full };

inline bool shows(VolumeView view, const Instance& instance) {
  return view == VolumeView::parts ? in_parts(instance) : in_full(instance);
}

}  // namespace espalier
