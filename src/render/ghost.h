#pragma once
// Ghosts: targets drawn as tinted glass shells, thin where seen face on and denser towards their outline.

#include "render/shade.h"

namespace espalier {

/// Veils the sample by the ghosts that the ray meets before `far` (the model or the ground). Where a ghost's face
/// coincides with what lies behind, it fades in over a small depth, so that neither flickers through the other.
void add_ghosts(const Tracer& ghosts, const Ray& ray, float far, Sample& sample);

inline const Vec3 kGhostEdge(0.06f, 0.22f, 0.62f);  // colour of a ghost's drawn edge

/// `colour` drawn over with `edge`, as strongly as the mean normals of ghosts around a pixel differ by `change`.
Vec3 ghost_edge(const Vec3& colour, const Vec3& edge, float change);

}  // namespace espalier
