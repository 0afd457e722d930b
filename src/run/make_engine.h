#pragma once
// The engine that a scene asks for.

#include <memory>

#include "run/scene.h"
#include "search/engine.h"

namespace espalier {

/// Throws Error for settings that do not go together.
std::unique_ptr<Engine> make_engine(const SceneSearch& search, const SearchProblem& problem);

}  // namespace espalier
