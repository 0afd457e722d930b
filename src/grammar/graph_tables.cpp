#include "grammar/graph_tables.h"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "base/check.h"

namespace espalier {
namespace {

bool same(const MeshRef& a, const MeshRef& b) {
  return a.kind == b.kind && a.sides == b.sides && a.as_is == b.as_is && a.path == b.path;
}

bool same(const Material& a, const Material& b) { return a.looks_like(b); }

template <typename T>
std::uint16_t find_or_add(std::vector<T>& items, const T& item, std::size_t from) {
  for (std::size_t i = from; i < items.size(); ++i)
    if (same(items[i], item)) return static_cast<std::uint16_t>(i);
  items.push_back(item);
  return static_cast<std::uint16_t>(items.size() - 1);
}

}  // namespace

std::string GraphTables::path_from_grammar(const std::string& path, const SourceSpan& span) const {
  const auto& files = grammar.ast.files;
  CHECK(span.file < files.size());
  return (std::filesystem::path(files[span.file]).parent_path() / path).generic_string();
}

std::uint16_t GraphTables::mesh_index(const MeshRef& mesh) { return find_or_add(graph.meshes, mesh, 0); }
std::uint16_t GraphTables::material_index(const Material& material) {
  return find_or_add(graph.materials, material, 1);
}

std::uint16_t GraphTables::recipe_index(MaterialRecipe recipe) {
  for (std::size_t i = 0; i < graph.recipes.size(); ++i) {
    const MaterialRecipe& known = graph.recipes[i];
    if (known.base.name == recipe.base.name && same(known.base, recipe.base) && known.slots == recipe.slots)
      return static_cast<std::uint16_t>(i);
  }
  recipe.middle = static_cast<std::uint16_t>(graph.materials.size());
  graph.materials.push_back(recipe.base);
  graph.recipes.push_back(std::move(recipe));
  return static_cast<std::uint16_t>(graph.recipes.size() - 1);
}

std::uint16_t GraphTables::blend_index(std::uint16_t a, std::uint16_t b) {
  const auto [it, fresh] = blends_.try_emplace({a, b}, static_cast<std::uint16_t>(graph.materials.size()));
  if (!fresh) return it->second;
  const Material from = graph.materials[a], to = graph.materials[b];
  for (int step = 0; step <= kBlendSteps; ++step) {
    Material between = blend(from, to, static_cast<float>(step) / kBlendSteps);
    between.name = fmt::format("{}-{}-{}", from.name, to.name, step);
    graph.materials.push_back(std::move(between));
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

}  // namespace espalier
