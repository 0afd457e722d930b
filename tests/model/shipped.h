#pragma once
// A shipped grammar, grown and expanded, with what tests ask of it: parents, rules, parts and bones of a gene.

#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "derivation/moves.h"
#include "derivation/sample.h"
#include "model/expand.h"
#include "shipped_grammar.h"

namespace espalier::test {

inline constexpr float kDegree = 3.14159265f / 180;

inline RandomStream stream_of(std::uint32_t index) { return RandomStream({2018, Purpose::test, 0, index}); }

/// Grown move by move to so many genes, or as far as it goes.
inline Derivation grown(const GeneratorGraph& graph, std::size_t genes, std::uint32_t index) {
  RandomStream random = stream_of(index);
  Derivation derivation = seedling(graph, random);
  EXPECT_TRUE(close_open_slots(graph, derivation, random));
  while (derivation.size() < genes && grow(graph, derivation, {}, random)) {}
  return derivation;
}

struct Grown {
  const GeneratorGraph& graph;
  Derivation derivation;
  Model model;
  std::vector<int> parent, slot;  // of each gene; -1 for the start

  Grown(const GeneratorGraph& g, Derivation d, ExpandTo phase = ExpandTo::parts) : graph(g), derivation(std::move(d)) {
    Expander(graph).expand(derivation, phase, model);
    parent.assign(derivation.size(), -1), slot.assign(derivation.size(), -1);
    std::size_t gene = 0, state = 0;
    place(-1, -1, gene, state);
  }

  const std::string& rule(std::size_t gene) const { return rule_of(graph, derivation.genes[gene]).name; }

  std::vector<const Bone*> bones(std::size_t gene) const {
    std::vector<const Bone*> found;
    for (const Bone& bone : model.bones)
      if (bone.gene == gene) found.push_back(&bone);
    return found;
  }

  /// Its parts on a layer, in the order in which they were made.
  std::vector<const Instance*> parts(std::size_t gene, Layer layer = Layer::rule) const {
    std::vector<const Instance*> found;
    for (const Instance& part : model.instances)
      if (part.gene == gene && part.layer == layer) found.push_back(&part);
    return found;
  }

 private:
  void place(int above, int at, std::size_t& gene, std::size_t& state) {
    const std::size_t self = gene++, first = state;
    parent[self] = above, slot[self] = at;
    const auto& slots = variant_of(graph, derivation.genes[self]).slots;
    state += slots.size();
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (derivation.slots[first + i] == SlotState::filled) place(static_cast<int>(self), slots[i], gene, state);
    }
  }
};

inline float length_of(const Bone& bone) { return glm::length(bone.to - bone.from); }
inline Vec3 direction_of(const Bone& bone) { return glm::normalize(bone.to - bone.from); }
inline float angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(1.0f, std::max(-1.0f, glm::dot(glm::normalize(a), glm::normalize(b)))));
}
/// The size of a part: the lengths of its axes.
inline Vec3 size_of(const Instance& part) {
  const Mat3& m = part.model_from_mesh.basis;
  return Vec3(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
}
/// A point or vector in the unit box's own coordinates.
inline Vec3 in_part(const Instance& part, const Vec3& point) {
  const Vec3 d = point - part.model_from_mesh.origin;
  Vec3 local;
  for (int k = 0; k < 3; ++k) {
    const Vec3& axis = part.model_from_mesh.basis[k];
    local[k] = glm::dot(d, axis) / glm::dot(axis, axis);
  }
  return local;
}

}  // namespace espalier::test
