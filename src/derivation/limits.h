#pragma once
// LimitLedger: how many more genes of each rule a derivation may take (`limit n`, language.md 7).

#include <cstdint>
#include <vector>

#include "derivation/position.h"

namespace espalier {

class LimitLedger {
 public:
  /// An empty derivation's. Where no rule of the graph has a limit, everything below costs nothing.
  void reset(const GeneratorGraph& graph);
  /// The ledger of `derivation`.
  void reset(const GeneratorGraph& graph, const Derivation& derivation);

  bool active() const { return !left_.empty(); }
  bool has_room(RuleId rule) const { return left_.empty() || left_[rule] > 0; }
  /// Counts one gene in. False if that is one too many.
  bool add(RuleId rule) { return left_.empty() || --left_[rule] >= 0; }

  void add(const GeneratorGraph& graph, const Derivation& derivation, const SubtreeSlice& slice);
  void remove(const GeneratorGraph& graph, const Derivation& derivation, const SubtreeSlice& slice);
  /// No rule is above its limit.
  bool holds() const;

 private:
  std::vector<std::int64_t> left_;  // per rule; empty where the graph has no limits
};

}  // namespace espalier
