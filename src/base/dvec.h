#pragma once
// Vectors in double precision, for what is computed once and not once per part.

#include <glm/vec3.hpp>

namespace espalier {

using DVec3 = glm::dvec3;

}  // namespace espalier
