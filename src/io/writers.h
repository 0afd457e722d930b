#pragma once
// The writers behind export_model: parts in, the bytes of a file out. Pure functions.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/parts.h"
#include "model/surfaces.h"
#include "io/provenance.h"

namespace espalier {

struct WriterInput {
  const Parts& parts;
  const Surfaces& surfaces;
  const Provenance& provenance;
  std::string name;  // of the model
};

/// glTF 2.0: one node per part; parts of the same shape and material share a mesh unless their frame shears.
/// `gpu_instancing`: EXT_mesh_gpu_instancing, required, for shapes that stand in more than one place.
std::string write_glb(const WriterInput& input, bool gpu_instancing);

struct ObjFiles {
  std::string obj, mtl;
  std::vector<std::pair<std::string, const TexturePicture*>> textures;  // by the name of their file
};
/// Wavefront OBJ, one group per material; the OBJ names "STEM.mtl" as its library, that one "STEM-texture-N.png".
ObjFiles write_obj(const WriterInput& input, const std::string& stem);

/// PLY, binary little endian: positions, normals, sRGB colours with opacity.
std::string write_ply(const WriterInput& input);

/// STL, binary.
std::string write_stl(const WriterInput& input);

/// The bytes of a texture's file: its own, or a PNG, with provenance unless that is null.
std::string texture_bytes(const TexturePicture& picture, const Provenance* provenance);

/// The mesh as a surface wants it: with texture coordinates, repeated as often as it says, where it has a texture; else
/// without.
Mesh mapped(const Mesh& mesh, const Surfaces& surfaces, std::uint16_t material);

}  // namespace espalier
