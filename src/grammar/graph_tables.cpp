#include "grammar/graph_tables.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace espalier {
namespace {

float linear_light(int byte) {
  const float s = static_cast<float>(byte) / 255;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool same(const MeshRef& a, const MeshRef& b) {
  return a.kind == b.kind && a.sides == b.sides && a.as_is == b.as_is && a.path == b.path;
}

bool same(const Material& a, const Material& b) {
  return a.color == b.color && a.roughness == b.roughness && a.metal == b.metal && a.opacity == b.opacity &&
         a.glow == b.glow;
}

template <typename T>
std::uint16_t find_or_add(std::vector<T>& items, const T& item, std::size_t from) {
  for (std::size_t i = from; i < items.size(); ++i)
    if (same(items[i], item)) return static_cast<std::uint16_t>(i);
  items.push_back(item);
  return static_cast<std::uint16_t>(items.size() - 1);
}

}  // namespace

std::uint16_t GraphTables::mesh_index(const MeshRef& mesh) { return find_or_add(graph.meshes, mesh, 0); }
std::uint16_t GraphTables::material_index(const Material& material) {
  return find_or_add(graph.materials, material, 1);
}

std::uint16_t GraphTables::blend_index(std::uint16_t a, std::uint16_t b) {
  const auto [it, fresh] = blends_.try_emplace({a, b}, static_cast<std::uint16_t>(graph.materials.size()));
  if (!fresh) return it->second;
  for (int step = 0; step <= kBlendSteps; ++step) {
    const float t = static_cast<float>(step) / kBlendSteps;
    const Material from = graph.materials[a], to = graph.materials[b];
    const auto blend = [t](float x, float y) { return x + (y - x) * t; };
    graph.materials.push_back({fmt::format("{}-{}-{}", from.name, to.name, step),
                               from.color + (to.color - from.color) * t,
                               blend(from.roughness, to.roughness), blend(from.metal, to.metal),
                               blend(from.opacity, to.opacity), blend(from.glow, to.glow)});
  }
  return it->second;
}

std::uint16_t GraphTables::counted_index(const std::string& rule) {
  const RuleId id = rule_ids.at(rule);
  const auto found = std::find(graph.counted_rules.begin(), graph.counted_rules.end(), id);
  if (found != graph.counted_rules.end()) return static_cast<std::uint16_t>(found - graph.counted_rules.begin());
  graph.counted_rules.push_back(id);
  graph.rules[id].counted = static_cast<std::uint16_t>(graph.counted_rules.size() - 1);
  return *graph.rules[id].counted;
}

std::optional<MeshKind> primitive_named(const std::string& name) {
  static const std::map<std::string, MeshKind> kinds = {
      {"box", MeshKind::box},     {"cylinder", MeshKind::cylinder}, {"cone", MeshKind::cone},
      {"sphere", MeshKind::sphere}, {"wedge", MeshKind::wedge},     {"pyramid", MeshKind::pyramid},
      {"quad", MeshKind::quad},   {"leaf", MeshKind::leaf}};
  const auto it = kinds.find(name);
  return it == kinds.end() ? std::nullopt : std::optional(it->second);
}

std::optional<Vec3> parse_color(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Vec3 color;
  for (int i = 0; i < 3; ++i) {
    const int high = hex_digit(text[1 + 2 * i]), low = hex_digit(text[2 + 2 * i]);
    if (high < 0 || low < 0) return std::nullopt;
    color[i] = linear_light(16 * high + low);
  }
  return color;
}

}  // namespace espalier
