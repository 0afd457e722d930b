#include "run/model_sketch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.h"

namespace espalier {
namespace {

// Steps across a part along one of its axes, so that neighbouring samples are at most a cell apart.
int steps_across(const Vec3& axis, float cell) {
  const float length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  return static_cast<int>(std::min(length / cell, 2.0f * ModelSketcher::kCells)) + 1;
}

}  // namespace

double distance(const ModelSketch& a, const ModelSketch& b) {
  CHECK(a.bits.size() == b.bits.size());
  std::uint64_t both = 0, either = 0;
  for (std::size_t i = 0; i < a.bits.size(); ++i) {
    both += static_cast<std::uint64_t>(std::popcount(a.bits[i] & b.bits[i]));
    either += static_cast<std::uint64_t>(std::popcount(a.bits[i] | b.bits[i]));
  }
  return either == 0 ? 0 : 1 - static_cast<double>(both) / static_cast<double>(either);
}

ModelSketcher::ModelSketcher(const GeneratorGraph& graph, const Bounds& box, bool full)
    : full_(full), min_(box.min), expander_(graph) {
  const Vec3 size = box.size();
  cell_ = std::max({size.x, size.y, size.z}) / kCells;
  CHECK(cell_ > 0);
  for (int i = 0; i < 3; ++i) {
    cells_[i] = std::clamp(static_cast<std::uint32_t>(size[i] / cell_ + 0.999f), 1u, kCells);
  }
}

void ModelSketcher::draw(const Derivation& derivation, ModelSketch& sketch) {
  expander_.expand(derivation, full_ ? ExpandTo::full : ExpandTo::parts, model_);
  draw(model_, sketch);
}

void ModelSketcher::draw(const Model& model, ModelSketch& sketch) const {
  sketch.bits.assign((std::size_t{cells_[0]} * cells_[1] * cells_[2] + 63) / 64, 0);
  for (const Instance& instance : model.instances) {
    if (full_ ? in_full(instance) : in_parts(instance)) touch(instance, sketch);
  }
}

void ModelSketcher::touch(const Instance& instance, ModelSketch& sketch) const {
  const Mat3& basis = instance.model_from_mesh.basis;
  int n[3];
  for (int i = 0; i < 3; ++i) n[i] = steps_across(basis[i], cell_);
  // In cells: corner + (i + 1/2) / n along each axis of the part's box.
  const Vec3 x = basis[0] / (cell_ * static_cast<float>(n[0])), y = basis[1] / (cell_ * static_cast<float>(n[1])),
             z = basis[2] / (cell_ * static_cast<float>(n[2]));
  const Vec3 corner = (instance.model_from_mesh.point(Vec3(-0.5f)) - min_) / cell_ + 0.5f * (x + y + z);
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      Vec3 p = corner + static_cast<float>(k) * z + static_cast<float>(j) * y;
      for (int i = 0; i < n[0]; ++i, p += x) {
        const bool inside = p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < static_cast<float>(cells_[0]) &&
                            p.y < static_cast<float>(cells_[1]) && p.z < static_cast<float>(cells_[2]);
        if (!inside) continue;
        const std::size_t cell = static_cast<std::size_t>(p.x) +
                                 cells_[0] * (static_cast<std::size_t>(p.y) + cells_[1] * static_cast<std::size_t>(p.z));
        sketch.bits[cell / 64] |= std::uint64_t{1} << cell % 64;
      }
    }
  }
}

}  // namespace espalier
