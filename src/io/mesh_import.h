#pragma once
// Mesh files through assimp: every format that it reads, flattened to one welded triangle mesh.

#include <cstdint>

#include "model/mesh_source.h"

namespace espalier {

struct ImportLimits {
  std::uint64_t most_bytes = 512ull << 20;
  std::uint64_t most_triangles = 20'000'000;
};

class AssimpMeshSource final : public MeshSource {
 public:
  explicit AssimpMeshSource(const ImportLimits& limits = {}) : limits_(limits) {}
  Mesh load(const std::string& path) override;

 private:
  ImportLimits limits_;
};

}  // namespace espalier
