#pragma once
// GrowthPool: derivations that grow side by side and share what they have in common. Each step of growth is a *shoot*:
// a gene that fills a slot, or the decision that a slot stays empty. Shoots are appended and never change, so a
// derivation that grows is no more than its newest shoot, which leads to all before it, and the slots that it has still
// open: it is copied in a block and goes on by itself (Guiding curves 2018, section 4.1; Ritchie et al. 2015).

#include <cstdint>
#include <span>
#include <vector>

#include "base/random.h"
#include "derivation/derivation.h"
#include "derivation/limits.h"
#include "derivation/sample.h"

namespace espalier {

using ShootId = std::uint32_t;
using BudId = std::uint32_t;
inline constexpr std::uint32_t kNoShoot = 0xffffffff;

/// One derivation of a pool. A value.
struct GrowingDerivation {
  ShootId last = kNoShoot;      // grown last
  std::uint32_t genes = 0;
  std::uint64_t detail_seed = 0;
  std::vector<BudId> open;      // slots that may be decided, in no particular order but a fixed one
  LimitLedger ledger;
};

/// Where shoots and buds went; kNoShoot: they are forgotten.
struct GrowthRenumbering {
  std::vector<ShootId> shoots;
  std::vector<BudId> buds;
};

class GrowthPool {
 public:
  struct Shoot {
    ShootId previous = kNoShoot;  // grown before it in the same derivation
    BudId bud = kNoShoot;         // where it stands; none for the start gene
    BudId first_bud = 0;          // its own, one per slot of the variant; copies share them, and draws
    std::uint32_t first_draw = 0;
    EdgeId edge = 0;
    std::uint16_t variant = 0;
    bool filled = true;           // else the bud stays empty, and the rest is meaningless
  };
  /// A slot of a gene.
  struct Bud {
    ShootId shoot = 0;         // the gene, or one of its copies
    EdgeId edge = 0;
    std::uint16_t slot = 0;    // index into the variant's slots
    bool absent = false;
  };

  /// Keeps a reference to the graph.
  explicit GrowthPool(const GeneratorGraph& graph);

  /// Of the same graph.
  void swap(GrowthPool& other);
  /// Forgets all shoots: derivations made before are of no use.
  void clear();
  std::size_t shoots() const { return shoots_.size(); }
  std::size_t buds() const { return buds_.size(); }
  const Shoot& shoot(ShootId id) const { return shoots_[id]; }
  const Bud& bud(BudId id) const { return buds_[id]; }
  const std::uint32_t* draws(const Shoot& shoot) const { return draws_.data() + shoot.first_draw; }
  /// How many genes are above a gene.
  DepthCounts counts_above(ShootId id) const { return {depths_[id], {counts_.data() + id * counted_, counted_}}; }
  const Variant& variant_of(const Shoot& shoot) const { return graph_.rule_of(shoot.edge).variants[shoot.variant]; }
  /// As of variants; decisions for nothing make nothing.
  bool makes_something(const Shoot& shoot) const {
    return shoot.filled && makes_[first_variant_[graph_.edges[shoot.edge].child] + shoot.variant];
  }

  /// One gene of the start rule, as `seedling` draws it. Throws Error where all weights of its alternatives are 0.
  GrowingDerivation begin(RandomStream& random);
  /// The genes of a derivation, parents first; its open slots are open.
  GrowingDerivation begin(const Derivation& derivation);
  /// One gene in a slot of `edge`, `above` that many others. No gene (`last` = kNoShoot) where none may stand.
  GrowingDerivation begin_at(EdgeId edge, const DepthCounts& above, RandomStream& random);

  /// One step of growth, as `grow_open_slot` in random order and lenient: visit(shoot) for each gene, in order, as soon
  /// as it is there. Nothing is grown beyond `most_genes`: then it is finished.
  template <class Visit>
  GrowthStep grow(GrowingDerivation& growing, RandomStream& random, std::uint32_t most_genes, const Visit& visit) {
    const ShootId before = growing.last;
    for (std::uint32_t fresh = 0; fresh < kMostFresh && !growing.open.empty() && growing.genes < most_genes;) {
      const ShootId shoot = decide(growing, random);
      if (shoot == kNoShoot) continue;
      ++fresh;
      visit(shoot);
      if (makes_something(shoots_[shoot])) break;
    }
    return growing.last == before ? GrowthStep::finished : GrowthStep::grown;
  }

  /// The derivation, depth first. What is open stays open.
  Derivation pack(const GrowingDerivation& growing) const;

  /// All shoots of a derivation, the first one first.
  void history(const GrowingDerivation& growing, std::vector<ShootId>& shoots) const;

  /// parents[i] = place in the history of the gene that the i-th shoot stands on; 0 for the first.
  void parents(const std::vector<ShootId>& history, std::vector<std::uint32_t>& parents) const;

  /// A copy without those shoots of its `history` for which cut[i] != 0 and without all that stands below them: their
  /// slots are open again. The start gene stays. Its shoots are copies too, which share buds and draws with what they
  /// are copies of: kept[k] = place in the history of the copy's k-th shoot.
  GrowingDerivation cut_back(const GrowingDerivation& growing, const std::vector<ShootId>& history,
                             const std::vector<std::uint32_t>& parents, const std::vector<std::uint8_t>& cut,
                             std::vector<std::uint32_t>& kept);

  /// Appends shoots that are known from elsewhere; what is open then is not kept in order.
  void leave_empty(GrowingDerivation& growing, BudId bud);
  ShootId append_gene(GrowingDerivation& growing, BudId bud, EdgeId edge, std::uint16_t variant,
                      std::span<const std::uint32_t> draws);

  /// Forgets what none of these holds, and renumbers the rest, which keeps its order.
  void keep_only(std::span<GrowingDerivation* const> living, GrowthRenumbering& renumbering);

 private:
  static constexpr std::uint32_t kMostFresh = 1000;  // genes of one step: grammars need not make anything at all

  /// Decides one open bud; the new gene, or kNoShoot where it stays empty or cannot be filled.
  ShootId decide(GrowingDerivation& growing, RandomStream& random);
  /// The draws are to be appended before.
  ShootId append(GrowingDerivation& growing, BudId bud, EdgeId edge, std::uint16_t variant, std::size_t first_draw,
                 const DepthCounts& above);
  /// What counts_above says of what stands in a bud of this gene.
  DepthCounts counts_below(ShootId id);
  const GeneratorGraph& graph_;
  std::uint32_t counted_;
  std::vector<std::uint32_t> first_variant_;  // per rule, into makes_
  std::vector<std::uint8_t> makes_;
  std::vector<Shoot> shoots_;
  std::vector<Bud> buds_;
  std::vector<std::uint32_t> draws_;
  std::vector<std::uint32_t> depths_, counts_;  // per shoot: what counts_above says
  // Scratch.
  std::vector<std::uint32_t> below_, above_;
  std::vector<std::uint8_t> stays_;
  mutable std::vector<ShootId> in_bud_;  // kNoShoot between calls
};

}  // namespace espalier
