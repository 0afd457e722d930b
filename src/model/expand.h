#pragma once
// Expansion: one forward sweep over a derivation, parents first, running the program of each gene's (rule, variant).

#include <memory>

#include "derivation/derivation.h"
#include "model/model.h"

namespace espalier {

/// The phases of a grammar, each including those before (Guiding curves 2018, section 3).
enum class ExpandTo : std::uint8_t {
  bones,  // the skeleton: rules run, and their bones are all that they make
  parts,  // emits of rules
  full,   // details, and what open slots show
};

struct ExpandLimits {
  std::uint32_t most_parts = 1'000'000;  // emits and detail calls; then details stop and Model::truncated is set
  std::uint32_t most_turns = 16'000'000;  // of all loops, likewise
  std::uint32_t most_copies = 4'000'000;  // genes shown, copies of `mirror` and others included; more are left out
  /// Whether recipes are followed. Where nobody looks at materials, the middle one of each will do and costs nothing.
  bool make_materials = true;
};

/// Runs programs; holds the scratch memory of one thread. The graph must outlive it.
class Expander {
 public:
  explicit Expander(const GeneratorGraph& graph, const ExpandLimits& limits = {});
  ~Expander();
  Expander(Expander&&) noexcept;

  /// Replaces `model` by the model of `derivation`, a valid derivation of the graph. No allocation once warm.
  void expand(const Derivation& derivation, ExpandTo phase, Model& model);

 private:
  struct Scratch;
  const GeneratorGraph* graph_;
  ExpandLimits limits_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace espalier
