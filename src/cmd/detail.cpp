#include "cmd/detail.h"

#include "base/error.h"
#include "run/mesh_look.h"

namespace espalier {

std::optional<LevelOfDetail> level_of(const DetailOptions& options) {
  if (options.lods && options.lod) throw Error("--lod and --lods exclude each other");
  return read_level_of_detail(options.joints, options.lod);
}

}  // namespace espalier
