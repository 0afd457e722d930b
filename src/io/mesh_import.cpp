#include "io/mesh_import.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/check.h"
#include "base/error.h"
#include "base/hash.h"
#include "io/child_process.h"
#include "io/file.h"

namespace espalier {
namespace {

constexpr float kFarthest = 1e9f;  // metres; beyond, single precision no longer holds a shape
constexpr float kFarthestUv = 1e6f;
constexpr std::uint32_t kNone = 0xffffffffu;

struct Vertex {
  Vec3 position, normal;
  Vec2 uv{0};

  bool operator==(const Vertex&) const = default;
};

/// Gives equal vertices one index, in order of first appearance: open addressing over the finished vertices.
class Welder {
 public:
  Welder() : table_(1024, kNone) {}

  std::uint32_t index_of(Vertex v) {
    v.position += Vec3(0), v.normal += Vec3(0), v.uv += Vec2(0);  // -0 becomes 0
    if (2 * vertices_.size() >= table_.size()) grow();
    const std::size_t place = find(v);
    if (table_[place] == kNone) {
      table_[place] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(v);
    }
    return table_[place];
  }
  const std::vector<Vertex>& vertices() const { return vertices_; }

 private:
  std::size_t find(const Vertex& v) const {
    std::uint64_t hash = 0;
    for (const Vec3& part : {v.position, v.normal, Vec3(v.uv, 0)}) {
      for (int axis = 0; axis < 3; ++axis) hash = key_below(hash, std::bit_cast<std::uint32_t>(part[axis]));
    }
    std::size_t place = hash & (table_.size() - 1);
    while (table_[place] != kNone && !(vertices_[table_[place]] == v)) place = (place + 1) & (table_.size() - 1);
    return place;
  }
  void grow() {
    table_.assign(2 * table_.size(), kNone);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) table_[find(vertices_[i])] = i;
  }

  std::vector<std::uint32_t> table_;
  std::vector<Vertex> vertices_;
};

Frame to_frame(const aiMatrix4x4& m) {
  Frame frame;
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 3; ++column) frame.basis[column][row] = m[row][column];
    frame.origin[row] = m[row][3];
  }
  return frame;
}

Frame operator*(const Frame& a, const Frame& b) { return {a.basis * b.basis, a.point(b.origin)}; }

Vec3 to_vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Unit length, or 0 where the direction is unknown.
Vec3 unit_or_zero(const Vec3& v) {
  const float length = glm::length(v);
  return length > 0 && length < INFINITY ? v / length : Vec3(0);
}

/// Collects the triangles of a scene into one mesh.
class Flattener {
 public:
  explicit Flattener(const ImportLimits& limits) : limits_(limits) {}

  Mesh flatten(const aiScene& scene) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      shaded_ |= scene.mMeshes[i]->HasNormals();
      mapped_ |= scene.mMeshes[i]->HasTextureCoords(0);
    }
    std::vector<std::pair<const aiNode*, Frame>> open{{scene.mRootNode, Frame{}}};
    while (!open.empty()) {
      const auto [node, world_from_parent] = open.back();
      open.pop_back();
      const Frame world_from_node = world_from_parent * to_frame(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] < scene.mNumMeshes) add(*scene.mMeshes[node->mMeshes[i]], world_from_node);
      }
      for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], world_from_node);
    }
    return finish();
  }

 private:
  void add(const aiMesh& source, const Frame& world_from_node) {
    const bool mirrored = glm::determinant(world_from_node.basis) < 0;
    const Mat3 cofactors = glm::mat3(glm::cross(world_from_node.basis[1], world_from_node.basis[2]),
                                     glm::cross(world_from_node.basis[2], world_from_node.basis[0]),
                                     glm::cross(world_from_node.basis[0], world_from_node.basis[1]));
    known_.assign(source.mNumVertices, kNone);
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      if (++triangle_count_ > limits_.most_triangles) {
        throw Error(fmt::format("more than {} triangles", limits_.most_triangles));
      }
      std::array<Vec3, 3> positions;
      for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= source.mNumVertices) {
          throw Error(fmt::format("a face names vertex {} of {}", face.mIndices[k], source.mNumVertices));
        }
        positions[k] = checked(world_from_node.point(checked(to_vec(source.mVertices[face.mIndices[k]]))));
      }
      const Vec3 across = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
      const Vec3 flat = unit_or_zero(mirrored ? -across : across);
      Triangle t;
      for (unsigned k = 0; k < 3; ++k) {
        t[k] = corner(source, face.mIndices[k], positions[k], (mirrored ? -1.0f : 1.0f) * cofactors, flat);
      }
      if (mirrored) std::swap(t[1], t[2]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
    }
  }

  /// The index of a corner's vertex. A corner without a usable normal takes that of its face.
  std::uint32_t corner(const aiMesh& source, unsigned index, const Vec3& position, const Mat3& normals_from_node,
                       const Vec3& flat) {
    if (known_[index] != kNone) return known_[index];
    const Vec2 uv = uv_of(source, index);
    if (!shaded_) return known_[index] = welder_.index_of({position, Vec3(0), uv});
    const Vec3 given = source.HasNormals() ? unit_or_zero(normals_from_node * to_vec(source.mNormals[index])) : Vec3(0);
    if (given != Vec3(0)) return known_[index] = welder_.index_of({position, given, uv});
    return welder_.index_of({position, flat == Vec3(0) ? Vec3(0, 1, 0) : flat, uv});
  }

  /// Of the first set; 0 where a part has none. Textures repeat, so what is beyond all sense counts as 0.
  static Vec2 uv_of(const aiMesh& source, unsigned index) {
    if (!source.HasTextureCoords(0)) return Vec2(0);
    const aiVector3D& uv = source.mTextureCoords[0][index];
    const bool usable = std::abs(uv.x) <= kFarthestUv && std::abs(uv.y) <= kFarthestUv;
    return usable ? Vec2(uv.x, uv.y) : Vec2(0);
  }

  Vec3 checked(const Vec3& p) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(p[axis])) throw Error(fmt::format("a coordinate is not finite ({})", std::abs(p[axis])));
      if (std::abs(p[axis]) > kFarthest) throw Error(fmt::format("coordinate {} is beyond +-{}", p[axis], kFarthest));
    }
    return p;
  }

  Mesh finish() {
    if (triangles_.empty()) throw Error("holds no triangles");
    Mesh mesh;
    mesh.positions.reserve(welder_.vertices().size());
    for (const Vertex& v : welder_.vertices()) {
      mesh.positions.push_back(v.position);
      if (shaded_) mesh.normals.push_back(v.normal);
      if (mapped_) mesh.uvs.push_back(v.uv);
    }
    mesh.triangles = std::move(triangles_);
    return mesh;
  }

  const ImportLimits& limits_;
  bool shaded_ = false;  // some part has normals
  bool mapped_ = false;  // some part has texture coordinates
  Welder welder_;
  std::vector<std::uint32_t> known_;  // per vertex of the part at hand
  std::vector<Triangle> triangles_;
  std::uint64_t triangle_count_ = 0;
};

/// Runs in the child: assimp trips over some damaged files. Errors do not name the file.
Mesh import(const std::string& path, const ImportLimits& limits) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene || !scene->mRootNode) throw Error(fmt::format("not a readable mesh: {}", importer.GetErrorString()));
  return Flattener(limits).flatten(*scene);
}

template <typename Element>
void append_bytes(std::string& out, const std::vector<Element>& elements) {
  const std::uint64_t count = elements.size();
  out.append(reinterpret_cast<const char*>(&count), sizeof count);
  out.append(reinterpret_cast<const char*>(elements.data()), count * sizeof(Element));
}

template <typename Element>
void take_bytes(std::string_view& in, std::vector<Element>& elements) {
  std::uint64_t count = 0;
  CHECK(in.size() >= sizeof count);
  std::memcpy(&count, in.data(), sizeof count);
  in.remove_prefix(sizeof count);
  CHECK(in.size() / sizeof(Element) >= count);
  elements.resize(count);
  if (count > 0) std::memcpy(elements.data(), in.data(), count * sizeof(Element));
  in.remove_prefix(count * sizeof(Element));
}

/// What the child sends back: the arrays of a mesh.
std::string packed(const Mesh& mesh) {
  std::string bytes;
  append_bytes(bytes, mesh.positions);
  append_bytes(bytes, mesh.normals);
  append_bytes(bytes, mesh.uvs);
  append_bytes(bytes, mesh.triangles);
  return bytes;
}

Mesh unpacked(std::string_view bytes) {
  Mesh mesh;
  take_bytes(bytes, mesh.positions);
  take_bytes(bytes, mesh.normals);
  take_bytes(bytes, mesh.uvs);
  take_bytes(bytes, mesh.triangles);
  return mesh;
}

}  // namespace

Mesh AssimpMeshSource::load(const std::string& path) {
  const std::string bytes = read_file(path, limits_.most_bytes);
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending.empty() || !Assimp::Importer().IsExtensionSupported(ending)) {
    throw Error(fmt::format("{}: not a mesh format that can be read; the ending \"{}\" is unknown", path, ending));
  }
  if (bytes.empty()) throw Error(fmt::format("{}: the file is empty", path));
  const ChildLimits child_limits{.most_memory = (4ull << 30) + 64 * bytes.size()};
  Mesh mesh;
  try {
    mesh = unpacked(run_in_child([&] { return packed(import(path, limits_)); }, child_limits));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", path, e.what()));
  }
  mesh.name = std::filesystem::path(path).stem().string();
  mesh.source_hash = content_hash(bytes);
  return mesh;
}

}  // namespace espalier
