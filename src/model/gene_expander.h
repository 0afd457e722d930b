#pragma once
// GeneExpander: the skeleton of derivations that grow in a pool, gene by gene. A gene is run once, when it is new; where
// and with which arguments its children would stand is kept with its buds, for all derivations that share it. The bones
// are those of Expander, bit for bit, up to 10 000 copies of one gene: of more (mirrors within mirrors) the rest is left
// out here.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "derivation/growth_pool.h"
#include "model/model.h"

namespace espalier {

class GeneExpander {
 public:
  /// The graph must outlive it.
  explicit GeneExpander(const GeneratorGraph& graph);
  ~GeneExpander();

  /// Forgets all buds.
  void clear();
  /// Runs a gene of the pool, parents before children: its bones, valid until the next call. The start gene stands at the
  /// origin. Bones' parents are not told.
  std::span<const Bone> run(const GrowthPool& pool, ShootId shoot);
  /// The frame in which a bud's child would stand; of several copies the first. None (false) where nothing is shown.
  bool frame(BudId bud, Frame& world_from_bud) const;
  /// Follows the pool's keep_only.
  void renumber(const GrowthRenumbering& renumbering);
  /// Runs the first gene of a derivation with the arguments and the size that the child in a bud of another pool has,
  /// but at the origin.
  std::span<const Bone> run_at_origin(const GrowthPool& pool, ShootId shoot, const GeneExpander& from, BudId bud);

  /// What it holds, bytes.
  std::size_t bytes() const;

 private:
  struct Items;  // what waits in buds: Pending items, first to last

  void run_item(const GrowthPool& pool, const GrowthPool::Shoot& shoot);
  void file_children(const GrowthPool::Shoot& shoot, std::size_t slots, std::size_t first_item);

  const GeneratorGraph& graph_;
  std::unique_ptr<Items> items_;
  std::vector<std::uint32_t> first_item_, next_item_;  // per bud; per item: the next copy in the same bud
  std::uint32_t stride_ = 0, globals_ = 0;             // floats per item; of these, at its end, the start rule's
  Model model_;
  Derivation slots_;                                   // states of the gene that runs
};

}  // namespace espalier
