#pragma once
// Scene files and grammars with all that they name, as new projects.

#include <functional>
#include <string>

#include "studio/shipped.h"

namespace espalier::studio {

/// The bytes of a file by its path. Throws Error naming it.
using ReadPath = std::function<std::string(const std::string& path)>;

/// What a grammar alone becomes: its imports, meshes and images are files of the project, under names that it has, or
/// under plain ones that its text then says; imports that come along with the program stay where they are. The scene
/// has no targets, and the engine that fits the grammar. Throws Error.
NewProject project_of_grammar(const std::string& path, const ReadPath& read);
/// What a scene file becomes, with its grammar as above. Throws Error.
NewProject project_of_scene(const std::string& path, const ReadPath& read);

}  // namespace espalier::studio
