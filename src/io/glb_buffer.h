#pragma once
// GlbBuffer: the accessors of a GLB and the bytes behind them. Accessors of one kind share a bufferView. Images stand
// first, so that their numbers are known at once.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/text.h"
#include "model/mesh.h"

namespace espalier {

class GlbBuffer {
 public:
  /// The accessors of a shape; indices into "accessors".
  struct ShapeAccessors {
    std::uint32_t position, normal, indices;
  };
  ShapeAccessors add_shape(const Mesh& mesh);
  /// The mesh's texture coordinates, turned to glTF's, whose v runs downwards.
  std::uint32_t add_uvs(const Mesh& mesh);
  /// A bufferView of its own for the bytes of an image; its index.
  std::uint32_t add_image(std::string bytes);
  /// `values` in rows of 3 or 4: one row per instance of EXT_mesh_gpu_instancing.
  std::uint32_t add_rows(std::span<const float> values, std::uint32_t width);

  bool empty() const { return accessors_.empty(); }
  /// Appends `"accessors":[..],"bufferViews":[..],"buffers":[..]` to the JSON and gives the bytes of the buffer.
  std::string finish(TextBuffer& json) const;

 private:
  enum View : std::uint32_t { vertices, uvs, short_indices, long_indices, rows3, rows4, view_count };

  struct Accessor {
    View view;
    std::uint64_t offset;  // bytes into the view
    std::uint64_t count;
    std::optional<Bounds> range;  // positions must state theirs
  };
  std::uint32_t add_accessor(View view, std::size_t count, const std::optional<Bounds>& range = {});

  std::array<TextBuffer, view_count> views_;
  std::vector<Accessor> accessors_;
  std::vector<std::string> images_;
};

}  // namespace espalier
