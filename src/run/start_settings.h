#pragma once
// SceneStart: the model that the search of a scene starts from, and what of it stays.

#include <string>
#include <vector>

#include "derivation/locks.h"

namespace espalier {

/// Genes of the start that stay: the path to the uppermost of them, as text ("Trunk/Branch[2]").
struct SceneLock {
  std::string path;
  LockScope scope = LockScope::subtree;

  bool operator==(const SceneLock&) const = default;
};

/// A model that the search starts from, instead of from nothing.
struct SceneStart {
  std::string derivation;  // path; empty: none
  std::vector<SceneLock> locks;

  bool operator==(const SceneStart&) const = default;
};

}  // namespace espalier
