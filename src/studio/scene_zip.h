#pragma once
// Scene folders in a zip file, as exports of the studio are, as new projects.

#include <string_view>

#include "studio/project_file.h"

namespace espalier::studio {

/// Whether the bytes are a zip file's and not a project file's.
bool is_zip(std::string_view bytes);

/// The project of the scene.toml that lies highest, with all that it names, called as its folder; best.derivation.json
/// beside it is the model that is shown, and where there is no scene (nothing was asked for), what that says of its own.
/// Nothing outside the archive is read. Throws Error.
WholeProject project_of_zip(std::string_view archive);

}  // namespace espalier::studio
