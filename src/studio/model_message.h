#pragma once
// Binary messages of the studio (docs/studio-protocol.md): meshes, models and clouds.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"

namespace espalier::studio {

/// More parts than these are not sent: 32 MiB.
inline constexpr std::size_t kMostSentParts = 500'000;
/// Meshes with more triangles all together are sent as their boxes.
inline constexpr std::size_t kMostSentTriangles = 1'000'000;

/// ESPG.
std::string mesh_message(std::uint32_t table, const MeshTable& meshes);
/// ESPG of one mesh, or of the box around it where it has more triangles.
std::string mesh_message(std::uint32_t table, const Mesh& mesh, std::uint64_t most_triangles);

struct SentModel {
  std::string bytes;
  std::size_t parts = 0;   // sent
  bool truncated = false;  // not all of them
};
/// ESPM: what the model shows, proxies too. Parts whose frame is not finite are left out.
SentModel model_message(std::uint32_t number, std::uint32_t table, const GeneratorGraph& graph,
                        const Derivation& derivation, const Model& model);

struct CloudPoint {
  Vec3 at{0};
  std::uint32_t kind = 0;  // 0 start of a bone, 1 end of a bone, 2 middle of a part
};
/// ESPC.
std::string cloud_message(std::string_view rule, const std::vector<CloudPoint>& points);

}  // namespace espalier::studio
