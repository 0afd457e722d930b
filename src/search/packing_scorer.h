#pragma once
// PackingScorer: scores what grows by packing it and asking a BatchScorer: for targets that must see whole models.

#include <vector>

#include "derivation/growth_pool.h"
#include "score/objective.h"

namespace espalier {

class PackingScorer final : public GrowthScorer {
 public:
  /// The scorer must outlive it.
  explicit PackingScorer(BatchScorer& scorer) : scorer_(scorer) {}

  void begin(std::size_t) override {}
  void clear(std::size_t) override {}
  void grown(std::size_t, const GrowthPool&, ShootId) override {}
  void grown_again(std::size_t, ShootId, ShootId) override {}
  void follow(std::span<const std::uint32_t>) override {}
  void score(const GrowthPool& pool, std::span<const GrowingDerivation> growing, std::span<double> scores) override;
  /// 0: nothing is known.
  void promise(const GrowthPool& pool, std::span<const GrowingDerivation> growing,
               std::span<double> promises) override;
  /// 0: what a gene adds is not known by itself.
  double worth(ShootId) const override { return 0; }
  void renumber(const GrowthRenumbering&) override {}

 private:
  BatchScorer& scorer_;
  std::vector<Derivation> packed_;
  std::vector<const Derivation*> batch_;
};

}  // namespace espalier
