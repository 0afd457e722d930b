#pragma once
// A shown model as a file, and as a folder that `espalier run` runs.

#include <string>

#include "io/provenance.h"
#include "studio/shown_model.h"
#include "studio/web_server.h"

namespace espalier::studio {

/// `format`: glb, ply, stl, png; obj: a zip with materials and textures; lods: a zip with the four levels of detail as
/// GLB, with smooth joints, and their triangles; zip: the scene folder. `name`: of the project,
/// for the file's name. Throws Error.
HttpResponse export_model(const ShownModel& shown, const std::string& format, const std::string& name);

/// Where the model came from, for files that lie beside scene.toml.
Provenance provenance_of(const ShownModel& shown);

}  // namespace espalier::studio
