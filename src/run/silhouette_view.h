#pragma once
// Silhouette view: a model as a silhouette target sees it: from its camera, in its frame; or for a shadow, the model
// with the plane on which the shadow falls, and what is wanted there.

#include <array>
#include <cstdint>

#include "base/executor.h"
#include "render/camera.h"
#include "render/render.h"
#include "run/setup.h"

namespace espalier {

/// Of setup.silhouettes[index]. The picture fits into `room`; one from a camera has the proportions of the target. The
/// model is shown with its details, whatever the target counts; its shadow is that of what is shown.
Picture silhouette_view(const Setup& setup, std::size_t index, const Model& model, const Surfaces& surfaces,
                        std::array<std::uint32_t, 2> room, int samples, Executor& executor);

/// For a camera in model space.
CameraPlace place_of(const Camera& camera);

}  // namespace espalier
