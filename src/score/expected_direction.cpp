#include "score/expected_direction.h"

#include "base/vec.h"
#include "derivation/growth_pool.h"
#include "model/gene_expander.h"

namespace espalier {
namespace {

/// The mean of what a model's bones say.
class MeanBone {
 public:
  void add(std::span<const Bone> bones) {
    for (const Bone& bone : bones) sum_ += DVec3(bone.to) - DVec3(bone.from);
    bones_ += static_cast<double>(bones.size());
  }
  DVec3 mean() const { return bones_ > 0 ? sum_ / bones_ : DVec3(0); }

 private:
  DVec3 sum_{0};
  double bones_ = 0;
};

/// Models that grew from the start: where rules were met.
class Wild {
 public:
  Wild(const GeneratorGraph& graph, std::uint64_t seed, const ExpectationSettings& settings)
      : pool_(graph), expander_(graph), met_(graph.rules.size()) {
    // Large enough to meet what stands deep, small enough to cost nothing.
    constexpr std::uint32_t kSteps = 60, kMostGenes = 2000;
    for (std::uint32_t i = 0; i < settings.samples; ++i) {
      RandomStream random({seed, Purpose::probe, 1, i, 0});
      GrowingDerivation growing = pool_.begin(random);
      const auto run = [&](ShootId shoot) { meet(graph, shoot, settings.samples); };
      run(growing.last);
      for (std::uint32_t step = 0; step < kSteps; ++step) {
        if (pool_.grow(growing, random, kMostGenes, run) == GrowthStep::finished) break;
      }
    }
  }

  const GrowthPool& pool() const { return pool_; }
  const GeneExpander& expander() const { return expander_; }
  const std::vector<ShootId>& met(RuleId rule) const { return met_[rule]; }

 private:
  void meet(const GeneratorGraph& graph, ShootId shoot, std::uint32_t most) {
    expander_.run(pool_, shoot);
    std::vector<ShootId>& met = met_[graph.edges[pool_.shoot(shoot).edge].child];
    Frame frame;
    const BudId bud = pool_.shoot(shoot).bud;
    if (met.size() < most && bud != kNoShoot && expander_.frame(bud, frame)) met.push_back(shoot);
  }

  GrowthPool pool_;
  GeneExpander expander_;
  std::vector<std::vector<ShootId>> met_;  // per rule, but not the start gene
};

}  // namespace

std::vector<Vec3> expected_directions(const GeneratorGraph& graph, std::uint64_t seed,
                                      const ExpectationSettings& settings) {
  constexpr std::uint32_t kMostGenes = 1000;
  const Wild wild(graph, seed, settings);
  GrowthPool pool(graph);
  GeneExpander expander(graph);
  std::vector<Vec3> expected;
  for (RuleId rule = 0; rule < graph.rules.size(); ++rule) {
    const std::vector<ShootId>& met = wild.met(rule);
    DVec3 sum{0};
    for (std::uint32_t i = 0; i < settings.samples && !met.empty(); ++i) {
      pool.clear();
      expander.clear();
      const ShootId where = met[i % met.size()];
      const GrowthPool::Shoot& model = wild.pool().shoot(where);
      RandomStream random({seed, Purpose::probe, 2, i, rule});
      GrowingDerivation growing = pool.begin_at(model.edge, wild.pool().counts_above(where), random);
      if (growing.last == kNoShoot) continue;
      MeanBone bones;
      bones.add(expander.run_at_origin(pool, growing.last, wild.expander(), model.bud));
      const auto run = [&](ShootId shoot) { bones.add(expander.run(pool, shoot)); };
      for (std::uint32_t step = 0; step < settings.steps; ++step) {
        if (pool.grow(growing, random, kMostGenes, run) == GrowthStep::finished) break;
      }
      sum += bones.mean();
    }
    expected.push_back(Vec3(sum / static_cast<double>(settings.samples)));
  }
  return expected;
}

}  // namespace espalier
