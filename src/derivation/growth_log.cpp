#include "derivation/growth_log.h"

#include <algorithm>

#include "base/error.h"
#include "derivation/chances.h"

namespace espalier {
namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw Error(std::string("growth log: ") + rule);
}

/// The gene of a history that has a bud: their first buds ascend.
std::uint32_t owner_of(const GrowthPool& pool, const std::vector<ShootId>& genes, BudId bud) {
  const auto behind = std::upper_bound(genes.begin(), genes.end(), bud, [&](BudId b, ShootId gene) {
    return b < pool.shoot(gene).first_bud;
  });
  return static_cast<std::uint32_t>(behind - genes.begin()) - 1;
}

}  // namespace

GrowthLog log_of(const GrowthPool& pool, const GrowingDerivation& growing) {
  GrowthLog log;
  log.detail_seed = growing.detail_seed;
  std::vector<ShootId> history;
  pool.history(growing, history);
  std::vector<std::uint32_t> parents;
  pool.parents(history, parents);
  std::vector<ShootId> genes;
  std::vector<std::uint32_t> places;  // of the genes in the history
  for (std::uint32_t i = 0; i < history.size(); ++i) {
    const GrowthPool::Shoot& shoot = pool.shoot(history[i]);
    GrowthLog::Entry entry;
    entry.above = parents[i];
    if (shoot.bud != kNoShoot) entry.slot = pool.bud(shoot.bud).slot;
    entry.filled = shoot.filled;
    if (shoot.filled) {
      genes.push_back(history[i]);
      places.push_back(i);
      entry.edge = shoot.edge;
      entry.variant = shoot.variant;
      log.draws.insert(log.draws.end(), pool.draws(shoot), pool.draws(shoot) + pool.variant_of(shoot).draws.size());
    }
    log.entries.push_back(entry);
  }
  for (const BudId bud : growing.open) {
    log.open.push_back({places[owner_of(pool, genes, bud)], pool.bud(bud).slot});
  }
  return log;
}

GrowingDerivation restore(const GeneratorGraph& graph, const GrowthLog& log, GrowthPool& pool) {
  require(!log.entries.empty() && log.entries[0].filled && log.entries[0].edge == 0, "must begin with the start gene");
  GrowingDerivation growing;
  growing.detail_seed = log.detail_seed;
  growing.ledger.reset(graph);
  std::vector<ShootId> shoots;
  std::vector<std::vector<bool>> decided;  // per entry and slot
  std::size_t draw = 0;
  const auto bud_of = [&](std::uint32_t entry, std::uint16_t slot) {
    require(entry < shoots.size() && shoots[entry] != kNoShoot && slot < decided[entry].size(),
            "a slot must be of a gene that came before");
    require(!decided[entry][slot], "a slot must be decided or open, and once");
    decided[entry][slot] = true;
    const BudId bud = pool.shoot(shoots[entry]).first_bud + slot;
    require(!pool.bud(bud).absent, "a slot that is absent must not be named");
    return bud;
  };
  for (const GrowthLog::Entry& entry : log.entries) {
    const BudId bud = shoots.empty() ? kNoShoot : bud_of(entry.above, entry.slot);
    shoots.push_back(kNoShoot);
    decided.emplace_back();
    if (!entry.filled) {
      require(!graph.edges[pool.bud(bud).edge].required, "a required slot must not be empty");
      pool.leave_empty(growing, bud);
      continue;
    }
    if (bud != kNoShoot) {
      const GrowthPool::Bud& slot = pool.bud(bud);
      require(slot.edge == entry.edge, "a gene must be of its slot's rule");
      require(fill_probability(graph.edges[slot.edge], pool.counts_above(slot.shoot)) > 0,
              "a slot that is filled with probability 0 must not be");
    }
    const Rule& rule = graph.rule_of(entry.edge);
    require(entry.variant < rule.variants.size(), "a variant must be one of its rule's");
    const Variant& variant = rule.variants[entry.variant];
    require(log.draws.size() - draw >= variant.draws.size(), "every draw must be there");
    require(growing.ledger.add(graph.edges[entry.edge].child), "a rule must keep its limit");
    shoots.back() = pool.append_gene(growing, bud, entry.edge, entry.variant,
                                     std::span(log.draws).subspan(draw, variant.draws.size()));
    require(variant_probability(variant, pool.counts_above(shoots.back())) > 0,
            "a variant must not have probability 0");
    draw += variant.draws.size();
    decided.back().resize(variant.slots.size());
  }
  require(draw == log.draws.size(), "there must be no more draws than genes need");
  growing.open.clear();
  for (const GrowthLog::Place& place : log.open) growing.open.push_back(bud_of(place.entry, place.slot));
  for (std::size_t entry = 0; entry < shoots.size(); ++entry) {
    for (std::uint32_t slot = 0; slot < decided[entry].size(); ++slot) {
      const GrowthPool::Bud& bud = pool.bud(pool.shoot(shoots[entry]).first_bud + slot);
      // Required ones may have been found to have no room.
      require(decided[entry][slot] || bud.absent || graph.edges[bud.edge].required,
              "an optional slot must be decided or open");
    }
  }
  return growing;
}

}  // namespace espalier
