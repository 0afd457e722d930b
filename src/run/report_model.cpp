#include "run/report_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "model/parts.h"
#include "render/crease.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kPlaceBytes = 12 * 4 + 2 * 4;

std::uint64_t bytes_of(const Mesh& mesh) { return mesh.positions.size() * (12 + 8) + mesh.triangles.size() * 12; }

void put(std::string& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(word >> shift & 255);
}
void put(std::string& out, float value) { put(out, std::bit_cast<std::uint32_t>(value)); }
void put(std::string& out, const Vec3& v) { put(out, v.x), put(out, v.y), put(out, v.z); }

void put_normal(std::string& out, const Vec3& n) {
  for (const float component : {n.x, n.y, n.z, 0.0f}) {
    const float scaled = std::clamp(component, -1.0f, 1.0f) * 32767.0f;
    const auto whole = static_cast<std::int16_t>(scaled < 0 ? scaled - 0.5f : scaled + 0.5f);
    const auto bits = static_cast<std::uint16_t>(whole);
    out += static_cast<char>(bits & 255);
    out += static_cast<char>(bits >> 8);
  }
}

/// How large a part looks: half the surface of its box, turned as it is.
float size_of(const Parts& parts, const Part& part) {
  const Vec3 box = parts.shapes[part.shape].box.size();
  const Mat3& basis = part.model_from_shape.basis;
  float side[3];
  for (int i = 0; i < 3; ++i) {
    side[i] = box[i] * std::sqrt(basis[i].x * basis[i].x + basis[i].y * basis[i].y + basis[i].z * basis[i].z);
  }
  return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

/// The largest parts that fit, in the model's order; shapes that none of them has are emptied.
void reduce(Parts& parts, const ReportBudget& budget) {
  std::vector<std::size_t> order(parts.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<float> sizes;
  for (const Part& part : parts.parts) sizes.push_back(size_of(parts, part));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<bool> kept(parts.parts.size()), has(parts.shapes.size());
  std::uint64_t bytes = 0, triangles = 0;
  for (const std::size_t i : order) {
    const std::uint32_t shape = parts.parts[i].shape;
    const Mesh& mesh = parts.shapes[shape].mesh;
    const std::uint64_t cost = kPlaceBytes + (has[shape] ? 0 : bytes_of(mesh));
    if (bytes + cost > budget.model_bytes || triangles + mesh.triangles.size() > budget.triangles) continue;
    bytes += cost, triangles += mesh.triangles.size();
    kept[i] = has[shape] = true;
  }
  std::vector<Part> left;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) left.push_back(parts.parts[i]);
  }
  parts.parts = std::move(left);
  for (std::size_t i = 0; i < has.size(); ++i) {
    if (!has[i]) parts.shapes[i].mesh = {};
  }
}

std::vector<Mesh> fitting_targets(const std::vector<Mesh>& targets, const ReportBudget& budget) {
  std::vector<Mesh> fitting;
  std::uint64_t bytes = 0, triangles = 0;
  for (const Mesh& target : targets) {
    if (target.triangles.size() > budget.triangles) continue;  // too large for making its normals, too
    Mesh mesh = with_crease_normals(target);
    if (bytes + bytes_of(mesh) > budget.target_bytes || triangles + mesh.triangles.size() > budget.triangles) continue;
    bytes += bytes_of(mesh), triangles += mesh.triangles.size();
    fitting.push_back(std::move(mesh));
  }
  return fitting;
}

ordered_json materials_json(const std::vector<Material>& materials) {
  ordered_json list = ordered_json::array();
  for (const Material& m : materials) {
    list.push_back({{"color", {m.color.x, m.color.y, m.color.z}},
                    {"roughness", m.roughness},
                    {"metal", m.metal},
                    {"opacity", m.opacity},
                    {"glow", m.glow}});
  }
  return list;
}

std::string bytes_of_all(const std::vector<const Mesh*>& meshes, const std::vector<Part>& parts) {
  std::string out;
  for (const Mesh* mesh : meshes) {
    for (const Vec3& p : mesh->positions) put(out, p);
  }
  for (const Mesh* mesh : meshes) {
    CHECK(mesh->normals.size() == mesh->positions.size());
    for (const Vec3& n : mesh->normals) put_normal(out, n);
  }
  for (const Mesh* mesh : meshes) {
    for (const Triangle& t : mesh->triangles) put(out, t[0]), put(out, t[1]), put(out, t[2]);
  }
  for (const Part& part : parts) {
    for (int i = 0; i < 3; ++i) put(out, part.model_from_shape.basis[i]);
    put(out, part.model_from_shape.origin);
  }
  for (const Part& part : parts) put(out, part.shape), put(out, std::uint32_t{part.material});
  return out;
}

}  // namespace

ReportModel make_report_model(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
                              const std::vector<Mesh>& targets, const ReportBudget& budget) {
  Parts parts = collect_parts(model, meshes, true);
  const std::size_t all = parts.parts.size();
  reduce(parts, budget);
  const std::vector<Mesh> ghosts = fitting_targets(targets, budget);

  ReportModel out;
  if (parts.parts.size() < all) {
    out.note = fmt::format("The model is too large for a page: {} of its {} parts are shown, the largest. ",
                           parts.parts.size(), all);
  }
  if (ghosts.size() < targets.size()) {
    out.note += fmt::format("{} of {} target meshes are too large for a page and left out. ",
                            targets.size() - ghosts.size(), targets.size());
  }
  if (!out.note.empty()) out.note.pop_back();

  std::vector<const Mesh*> shapes;
  for (const Shape& shape : parts.shapes) shapes.push_back(&shape.mesh);
  ordered_json target_shapes = ordered_json::array();
  for (const Mesh& ghost : ghosts) {
    target_shapes.push_back(shapes.size());
    shapes.push_back(&ghost);
  }
  ordered_json sizes = ordered_json::array();
  for (const Mesh* mesh : shapes) sizes.push_back({mesh->positions.size(), mesh->triangles.size()});
  for (const Part& part : parts.parts) out.triangles += parts.shapes[part.shape].mesh.triangles.size();
  out.bytes = bytes_of_all(shapes, parts.parts);
  const ordered_json header = {{"shapes", sizes},       {"parts", parts.parts.size()},
                               {"triangles", out.triangles}, {"materials", materials_json(materials)},
                               {"targets", target_shapes},   {"note", out.note}};
  out.header = header.dump();
  return out;
}

}  // namespace espalier
