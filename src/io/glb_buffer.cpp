#include "io/glb_buffer.h"

#include "base/check.h"

namespace espalier {
namespace {

/// How glTF 2.0 (sections 3.6 and 5.1) names what a view holds.
struct ViewFacts {
  std::uint32_t component;    // unsigned short, unsigned int or float
  std::string_view type;      // of its accessors
  std::string_view members;   // of the bufferView
};
constexpr ViewFacts kViewFacts[] = {
    {5126, "VEC3", ",\"byteStride\":12,\"target\":34962"},
    {5126, "VEC2", ",\"byteStride\":8,\"target\":34962"},
    {5123, "SCALAR", ",\"target\":34963"},
    {5125, "SCALAR", ",\"target\":34963"},
    {5126, "VEC3", ""},
    {5126, "VEC4", ""},
};

}  // namespace

std::uint32_t GlbBuffer::add_accessor(View view, std::size_t count, const std::optional<Bounds>& range) {
  accessors_.push_back({view, views_[view].size(), count, range});
  return static_cast<std::uint32_t>(accessors_.size() - 1);
}

GlbBuffer::ShapeAccessors GlbBuffer::add_shape(const Mesh& mesh) {
  CHECK(!mesh.triangles.empty() && mesh.normals.size() == mesh.positions.size());
  ShapeAccessors out;
  out.position = add_accessor(vertices, mesh.positions.size(), bounds(mesh));
  for (const Vec3& p : mesh.positions) views_[vertices].raw(p);
  out.normal = add_accessor(vertices, mesh.normals.size());
  for (const Vec3& n : mesh.normals) views_[vertices].raw(n);
  const bool fits_short = mesh.positions.size() <= 0xffff;  // 0xffff itself restarts strips
  const View view = fits_short ? short_indices : long_indices;
  out.indices = add_accessor(view, 3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      if (fits_short) {
        views_[view].raw(static_cast<std::uint16_t>(corner));
      } else {
        views_[view].raw(corner);
      }
    }
  }
  return out;
}

std::uint32_t GlbBuffer::add_uvs(const Mesh& mesh) {
  CHECK(mesh.uvs.size() == mesh.positions.size());
  const std::uint32_t accessor = add_accessor(uvs, mesh.uvs.size());
  for (const Vec2& uv : mesh.uvs) views_[uvs].raw(uv.x).raw(1 - uv.y);
  return accessor;
}

std::uint32_t GlbBuffer::add_image(std::string bytes) {
  images_.push_back(std::move(bytes));
  return static_cast<std::uint32_t>(images_.size() - 1);
}

std::uint32_t GlbBuffer::add_rows(std::span<const float> values, std::uint32_t width) {
  CHECK(width == 3 || width == 4);
  const View view = width == 3 ? rows3 : rows4;
  const std::uint32_t accessor = add_accessor(view, values.size() / width);
  for (const float value : values) views_[view].raw(value);
  return accessor;
}

std::string GlbBuffer::finish(TextBuffer& json) const {
  std::string bytes;
  std::array<std::uint32_t, view_count> number{};
  TextBuffer view_json;
  std::uint32_t used = 0;
  const auto add_view = [&](const std::string& view_bytes, std::string_view members) {
    bytes.append((4 - bytes.size() % 4) % 4, '\0');
    view_json << (used > 0 ? "," : "") << "{\"buffer\":0,\"byteOffset\":" << std::uint64_t{bytes.size()}
              << ",\"byteLength\":" << std::uint64_t{view_bytes.size()} << members << "}";
    bytes += view_bytes;
    return used++;
  };
  for (const std::string& image : images_) add_view(image, "");
  for (std::uint32_t v = 0; v < view_count; ++v) {
    if (!views_[v].text().empty()) number[v] = add_view(views_[v].text(), kViewFacts[v].members);
  }
  json << "\"accessors\":[";
  for (const Accessor& a : accessors_) {
    json << (&a == accessors_.data() ? "" : ",") << "{\"bufferView\":" << number[a.view]
         << ",\"byteOffset\":" << a.offset << ",\"componentType\":" << kViewFacts[a.view].component
         << ",\"count\":" << a.count << ",\"type\":\"" << kViewFacts[a.view].type << "\"";
    if (a.range) {
      (json << ",\"min\":[").vector(a.range->min, ",") << "]";
      (json << ",\"max\":[").vector(a.range->max, ",") << "]";
    }
    json << "}";
  }
  json << "],\"bufferViews\":[" << view_json.text() << "],\"buffers\":[{\"byteLength\":" << std::uint64_t{bytes.size()}
       << "}]";
  return bytes;
}

}  // namespace espalier
