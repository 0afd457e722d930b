#pragma once
// Run: a scene from file to folder: set up, search, write. Layout of the folder: docs/scenes.md.

#include <atomic>
#include <string>

#include "run/progress.h"
#include "run/scene.h"

namespace espalier {

class MeshSource;

struct RunOptions {
  std::string out;                          // folder to make or replace
  const std::atomic<bool>* stop = nullptr;  // set from outside: end with the best so far
  RunObserver* observer = nullptr;          // may be null
};

/// False if it was stopped before there was any result; then nothing is left behind. Throws Error, leaving nothing
/// behind either, unless writing failed half-way: then what could be written is kept, and the message says where.
bool run_scene(const Scene& scene, const RunOptions& options, MeshSource& source);

}  // namespace espalier
