#pragma once
// GaGains: how often each kind of variation made a child better than its parent, in the last generations.

#include <array>
#include <cstdint>
#include <vector>

#include "search/state_stream.h"
#include "search/variation_kind.h"

namespace espalier {

class GaGains {
 public:
  /// Generations that are looked back on, the present one included.
  static constexpr std::size_t kWindow = 20;

  void begin_generation();
  /// A child that came to a score, or that was found not acceptable. Only after `begin_generation`.
  void add(VariationKind kind, bool better);

  std::uint64_t made(VariationKind kind) const { return sum(kind).made; }
  std::uint64_t better(VariationKind kind) const { return sum(kind).better; }

  void save(StateWriter& writer) const;
  /// Throws Error for what cannot be.
  static GaGains load(StateReader& reader);

 private:
  struct Gain {
    std::uint64_t made = 0, better = 0;
  };
  using Generation = std::array<Gain, kVariationKinds>;

  Gain sum(VariationKind kind) const;

  std::vector<Generation> last_;  // at most kWindow, the present one last
};

}  // namespace espalier
