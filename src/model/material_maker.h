#pragma once
// MaterialMaker: numbers the materials that a model's draws make, equal ones once. Internal to expansion.

#include <array>
#include <cstdint>

#include "model/model.h"

namespace espalier {

class MaterialMaker {
 public:
  explicit MaterialMaker(const GeneratorGraph& graph) : graph_(graph) {}

  /// Forgets what it numbered: a new model begins.
  void reset() { ++model_number_; }

  /// The material of these steps of a recipe: an index beyond the graph's materials, or the recipe's middle one
  /// where the model is full.
  std::uint16_t number(std::uint16_t recipe, std::uint64_t steps, Model& model);

 private:
  /// Twice as many as materials, so that a search ends soon.
  static constexpr std::size_t kPlaces = 2 * Model::kMostMaterials;
  struct Place {
    std::uint64_t steps = 0;
    std::uint64_t model_number = 0;  // stale unless it is the current one
    std::uint16_t recipe = 0, material = 0;
  };

  const GeneratorGraph& graph_;
  std::uint64_t model_number_ = 0;
  std::array<Place, kPlaces> places_{};
};

}  // namespace espalier
