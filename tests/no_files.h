#pragma once
// Meshes of grammars that name no mesh files.

#include <string>

#include "base/error.h"
#include "model/mesh_source.h"
#include "model/model.h"

namespace espalier::test {

class NoFiles final : public MeshSource {
 public:
  Mesh load(const std::string& path) override { throw Error(path + ": this test has no mesh files"); }
};

inline MeshTable meshes_of(const GeneratorGraph& graph) {
  NoFiles files;
  return MeshTable(graph, "", files);
}

}  // namespace espalier::test
