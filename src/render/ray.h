#pragma once
// Ray: where it starts and where it goes.

#include "base/vec.h"

namespace espalier {

struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};  // not necessarily of unit length
  float near = 0;           // hits before are ignored

  Vec3 at(float t) const { return origin + t * direction; }
};

}  // namespace espalier
