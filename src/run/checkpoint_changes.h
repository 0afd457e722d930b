#pragma once
// What has changed in a run's folder since its checkpoint was written: a search can only go on as the same search.

#include <map>
#include <string>
#include <vector>

#include "run/checkpoint.h"
#include "run/scene.h"

namespace espalier {

/// The scene that the checkpoint's settings tell. Throws Error naming `file`, where it was read.
Scene scene_of(const Checkpoint& checkpoint, const std::string& file);

/// One line per setting that differs: "engine.ga.population is 300, was 24". Budgets and the size of pictures may.
std::vector<std::string> setting_changes(const Scene& now, const Scene& before);

/// The same of inputs, by name their content_hash: "inputs/pile.esp is not what it was".
std::vector<std::string> input_changes(const std::map<std::string, std::string>& now,
                                       const std::map<std::string, std::string>& before);

/// The same of the whole folder: settings, inputs, the program. Throws Error where a file cannot be read.
std::vector<std::string> folder_changes(const std::string& folder, const Scene& now, const Checkpoint& checkpoint);

}  // namespace espalier
