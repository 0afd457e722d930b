#pragma once
// The writers behind export_model: parts in, the bytes of a file out. Pure functions.

#include <string>
#include <string_view>
#include <vector>

#include "model/parts.h"
#include "io/provenance.h"

namespace espalier {

struct WriterInput {
  const Parts& parts;
  const std::vector<Material>& materials;  // as in the grammar; parts that name others get the default
  const Provenance& provenance;
  std::string name;  // of the model
};

/// glTF 2.0: one node per part; parts of the same shape and material share a mesh unless their frame shears.
/// `gpu_instancing`: EXT_mesh_gpu_instancing, required, for shapes that stand in more than one place.
std::string write_glb(const WriterInput& input, bool gpu_instancing);

struct ObjFiles {
  std::string obj, mtl;
};
/// Wavefront OBJ, one group per material; the OBJ names `mtl_name` as its library.
ObjFiles write_obj(const WriterInput& input, std::string_view mtl_name);

/// PLY, binary little endian: positions, normals, sRGB colours with opacity.
std::string write_ply(const WriterInput& input);

/// STL, binary.
std::string write_stl(const WriterInput& input);

/// The material of an index, or a default for an index beyond the list.
const Material& material_at(const std::vector<Material>& materials, std::uint16_t index);

}  // namespace espalier
