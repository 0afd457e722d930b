#include "run/model_sketch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/matrix.hpp>

#include "base/check.h"

namespace espalier {
namespace {

// Parts longer than this many cells are looked at from the cells' side.
constexpr float kLongest = 4.0f * ModelSketcher::kCells;

float length_of(const Vec3& axis) { return std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z); }

void set(ModelSketch& sketch, std::size_t cell) { sketch.bits[cell / 64] |= std::uint64_t{1} << cell % 64; }

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
    : full_(full), min_(box.min), expander_(graph, {.make_materials = false}) {
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
  Frame cells_from_part = instance.model_from_mesh;
  cells_from_part.origin = (cells_from_part.origin - min_) / cell_;
  int steps[3];
  for (int i = 0; i < 3; ++i) {
    cells_from_part.basis[i] /= cell_;
    const float length = length_of(cells_from_part.basis[i]);
    if (!(length < kLongest)) return touch_by_cells(cells_from_part, sketch);
    steps[i] = static_cast<int>(length) + 1;  // neighbouring samples are at most a cell apart
  }
  touch_by_samples(cells_from_part, steps, sketch);
}

void ModelSketcher::touch_by_samples(const Frame& cells_from_part, const int (&steps)[3], ModelSketch& sketch) const {
  const Mat3& basis = cells_from_part.basis;
  const Vec3 x = basis[0] / static_cast<float>(steps[0]), y = basis[1] / static_cast<float>(steps[1]),
             z = basis[2] / static_cast<float>(steps[2]);
  const Vec3 corner = cells_from_part.point(Vec3(-0.5f)) + 0.5f * (x + y + z);
  for (int k = 0; k < steps[2]; ++k) {
    for (int j = 0; j < steps[1]; ++j) {
      Vec3 p = corner + static_cast<float>(k) * z + static_cast<float>(j) * y;
      for (int i = 0; i < steps[0]; ++i, p += x) {
        const bool inside = p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < static_cast<float>(cells_[0]) &&
                            p.y < static_cast<float>(cells_[1]) && p.z < static_cast<float>(cells_[2]);
        if (!inside) continue;
        set(sketch, index(static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y), static_cast<std::size_t>(p.z)));
      }
    }
  }
}

// A part far larger than the grid: the cells whose centres it covers. One that is thin besides may be missed.
void ModelSketcher::touch_by_cells(const Frame& cells_from_part, ModelSketch& sketch) const {
  const Mat3 part_from_cells = glm::inverse(cells_from_part.basis);
  for (std::uint32_t z = 0; z < cells_[2]; ++z) {
    for (std::uint32_t y = 0; y < cells_[1]; ++y) {
      for (std::uint32_t x = 0; x < cells_[0]; ++x) {
        const Vec3 centre = Vec3(0.5f) + Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const Vec3 p = part_from_cells * (centre - cells_from_part.origin);
        // False for a flat part, whose inverse is not finite.
        if (std::fabs(p.x) <= 0.5f && std::fabs(p.y) <= 0.5f && std::fabs(p.z) <= 0.5f) set(sketch, index(x, y, z));
      }
    }
  }
}

}  // namespace espalier
