#pragma once
// ShownModel: a model as it was published. Never changes; whoever holds it may look into it from any thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "run/setup.h"

namespace espalier::studio {

struct ShownModel {
  std::uint32_t number = 0;
  std::int64_t revision = 0;           // of the document
  std::shared_ptr<const Setup> setup;  // its grammar, meshes and targets
  Derivation derivation;
  std::string encoded;                 // the derivation as JSON
  std::optional<double> score;         // none without targets
  double optimum = 0;
  std::string words;
  std::vector<std::string> locks;      // paths
  /// Found by the search of `setup` in so many steps, so that the same search finds it again; 0: made otherwise.
  std::uint64_t steps = 0;
};
using ShownModelPtr = std::shared_ptr<const ShownModel>;

}  // namespace espalier::studio
