#include "derivation/growth_pool.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/chances.h"
#include "derivation/growth.h"
#include "derivation/writer.h"

namespace espalier {

GrowthPool::GrowthPool(const GeneratorGraph& graph)
    : graph_(graph), counted_(static_cast<std::uint32_t>(graph.counted_rules.size())) {
  for (const Rule& rule : graph.rules) {
    first_variant_.push_back(static_cast<std::uint32_t>(makes_.size()));
    for (const Variant& variant : rule.variants) makes_.push_back(espalier::makes_something(variant));
  }
}

void GrowthPool::clear() {
  shoots_.clear();
  buds_.clear();
  draws_.clear();
  depths_.clear();
  counts_.clear();
}

void GrowthPool::swap(GrowthPool& other) {
  CHECK(&graph_ == &other.graph_);
  shoots_.swap(other.shoots_);
  buds_.swap(other.buds_);
  draws_.swap(other.draws_);
  depths_.swap(other.depths_);
  counts_.swap(other.counts_);
}

DepthCounts GrowthPool::counts_below(ShootId id) {
  below_.assign(counts_.begin() + id * counted_, counts_.begin() + (id + 1) * counted_);
  const Rule& rule = graph_.rule_of(shoots_[id].edge);
  if (rule.counted) ++below_[*rule.counted];
  return {depths_[id] + 1, below_};
}

GrowingDerivation GrowthPool::begin(RandomStream& random) {
  const std::uint64_t detail_seed = random.next_u64();
  above_.assign(counted_, 0);
  GrowingDerivation growing = begin_at(0, {0, above_}, random);
  if (growing.last == kNoShoot) {
    const Rule& rule = graph_.rules[graph_.start()];
    throw Error(fmt::format("grammar {}: rule {}: none of its alternatives may stand at the start", graph_.name,
                            rule.name));
  }
  growing.detail_seed = detail_seed;
  return growing;
}

GrowingDerivation GrowthPool::begin_at(EdgeId edge, const DepthCounts& above, RandomStream& random) {
  GrowingDerivation growing;
  growing.ledger.reset(graph_);
  const Rule& rule = graph_.rule_of(edge);
  if (!may_stand(graph_, edge, above) || !growing.ledger.add(graph_.edges[edge].child)) return growing;
  const std::optional<std::uint16_t> picked = pick_variant(rule, above, random);
  if (!picked) return growing;
  const std::size_t first_draw = draws_.size();
  append_draws(rule.variants[*picked], random, draws_);
  append(growing, kNoShoot, edge, *picked, first_draw, above);
  return growing;
}

GrowingDerivation GrowthPool::begin(const Derivation& derivation) {
  CHECK(!derivation.genes.empty());
  GrowingDerivation growing;
  growing.detail_seed = derivation.detail_seed;
  growing.ledger.reset(graph_, derivation);
  // Genes whose slots are being walked: the shoot, and the next of its slots.
  struct Level {
    ShootId shoot;
    std::uint32_t slot;
    std::size_t states;
  };
  std::vector<Level> stack;
  std::size_t gene = 0, states = 0, draws = 0;
  const auto push = [&](BudId bud, const DepthCounts& above) {
    const GeneRecord& record = derivation.genes[gene++];
    const Variant& variant = espalier::variant_of(graph_, record);
    const std::size_t first_draw = draws_.size();
    for (std::size_t k = 0; k < variant.draws.size(); ++k) draws_.push_back(derivation.draws[draws++]);
    stack.push_back({append(growing, bud, record.edge, record.variant, first_draw, above), 0, states});
    states += variant.slots.size();
  };
  above_.assign(counted_, 0);
  push(kNoShoot, {0, above_});
  growing.open.clear();  // all that `append` opens: here the derivation says what is
  while (!stack.empty()) {
    Level& top = stack.back();
    const Shoot shoot = shoots_[top.shoot];
    if (top.slot == variant_of(shoot).slots.size()) {
      stack.pop_back();
      continue;
    }
    const BudId bud = shoot.first_bud + top.slot;
    const SlotState state = derivation.slots[top.states + top.slot++];
    if (state == SlotState::open) growing.open.push_back(bud);
    if (state == SlotState::empty) leave_empty(growing, bud);
    if (state != SlotState::filled) continue;
    const std::size_t open = growing.open.size();
    push(bud, counts_below(top.shoot));
    growing.open.resize(open);
  }
  return growing;
}

void GrowthPool::leave_empty(GrowingDerivation& growing, BudId bud) {
  Shoot& shoot = shoots_.emplace_back();
  shoot.previous = growing.last;
  shoot.bud = bud;
  shoot.filled = false;
  growing.last = static_cast<ShootId>(shoots_.size() - 1);
  depths_.push_back(0);
  counts_.resize(counts_.size() + counted_);
}

ShootId GrowthPool::append_gene(GrowingDerivation& growing, BudId bud, EdgeId edge, std::uint16_t variant,
                                std::span<const std::uint32_t> draws) {
  DepthCounts above;
  above_.assign(counted_, 0);
  if (bud != kNoShoot) {
    above = counts_below(buds_[bud].shoot);
    above_.assign(above.of_rule.begin(), above.of_rule.end());
  }
  const std::size_t first_draw = draws_.size();
  draws_.insert(draws_.end(), draws.begin(), draws.end());
  return append(growing, bud, edge, variant, first_draw, {above.depth, above_});
}

ShootId GrowthPool::append(GrowingDerivation& growing, BudId bud, EdgeId edge, std::uint16_t variant,
                           std::size_t first_draw, const DepthCounts& above) {
  const auto id = static_cast<ShootId>(shoots_.size());
  const Rule& rule = graph_.rule_of(edge);
  Shoot& shoot = shoots_.emplace_back();
  shoot.previous = growing.last;
  shoot.bud = bud;
  shoot.first_bud = static_cast<BudId>(buds_.size());
  shoot.first_draw = static_cast<std::uint32_t>(first_draw);
  shoot.edge = edge;
  shoot.variant = variant;
  growing.last = id;
  ++growing.genes;
  depths_.push_back(above.depth);
  counts_.insert(counts_.end(), above.of_rule.begin(), above.of_rule.end());
  const DepthCounts below = counts_below(id);
  const std::vector<std::uint16_t>& slots = rule.variants[variant].slots;
  for (std::uint16_t k = 0; k < slots.size(); ++k) {
    const EdgeId child = rule.slots[slots[k]].edge;
    const bool absent = !may_stand(graph_, child, below);
    if (!absent) growing.open.push_back(static_cast<BudId>(buds_.size()));
    buds_.push_back({id, child, k, absent});
  }
  return id;
}

ShootId GrowthPool::decide(GrowingDerivation& growing, RandomStream& random) {
  const std::uint32_t place = random.below(static_cast<std::uint32_t>(growing.open.size()));
  const BudId id = growing.open[place];
  growing.open[place] = growing.open.back();
  growing.open.pop_back();
  const Bud bud = buds_[id];
  const Edge& edge = graph_.edges[bud.edge];
  const bool room = growing.ledger.has_room(edge.child);
  const bool wanted = edge.required || random.chance(fill_probability(edge, counts_above(bud.shoot)));
  if (!wanted) {
    leave_empty(growing, id);
    return kNoShoot;
  }
  const Rule& rule = graph_.rules[edge.child];
  const DepthCounts above = counts_below(bud.shoot);
  above_.assign(above.of_rule.begin(), above.of_rule.end());  // `append` needs the other array
  const DepthCounts kept{above.depth, above_};
  const std::optional<std::uint16_t> picked = room ? pick_variant(rule, kept, random) : std::nullopt;
  if (!picked) {
    if (!edge.required) leave_empty(growing, id);
    return kNoShoot;  // what is required stays open, and is asked no more
  }
  growing.ledger.add(edge.child);
  const std::size_t first_draw = draws_.size();
  append_draws(rule.variants[*picked], random, draws_);
  return append(growing, id, bud.edge, *picked, first_draw, kept);
}

void GrowthPool::history(const GrowingDerivation& growing, std::vector<ShootId>& shoots) const {
  shoots.clear();
  for (ShootId id = growing.last; id != kNoShoot; id = shoots_[id].previous) shoots.push_back(id);
  std::reverse(shoots.begin(), shoots.end());
}

Derivation GrowthPool::pack(const GrowingDerivation& growing) const {
  std::vector<ShootId> shoots;
  history(growing, shoots);
  in_bud_.resize(buds_.size(), kNoShoot);
  for (const ShootId id : shoots) {
    if (shoots_[id].bud != kNoShoot) in_bud_[shoots_[id].bud] = id;
  }
  Derivation out;
  out.detail_seed = growing.detail_seed;
  TreeWriter writer;
  writer.begin(out);
  struct Level {
    ShootId shoot;
    std::uint32_t slot;
    std::size_t states;
  };
  std::vector<Level> stack;
  const auto push = [&](ShootId id) {
    const Shoot& shoot = shoots_[id];
    const Variant& variant = variant_of(shoot);
    writer.open(shoot.edge, shoot.variant);
    stack.push_back({id, 0, out.slots.size()});
    for (std::size_t k = 0; k < variant.slots.size(); ++k) {
      out.slots.push_back(buds_[shoot.first_bud + k].absent ? SlotState::absent : SlotState::open);
    }
    out.draws.insert(out.draws.end(), draws(shoot), draws(shoot) + variant.draws.size());
    writer.opened();
  };
  push(shoots.front());
  while (!stack.empty()) {
    Level& top = stack.back();
    const Shoot& shoot = shoots_[top.shoot];
    if (top.slot == variant_of(shoot).slots.size()) {
      writer.close();
      stack.pop_back();
      continue;
    }
    const ShootId child = in_bud_[shoot.first_bud + top.slot];
    SlotState& state = out.slots[top.states + top.slot++];
    if (child == kNoShoot) continue;
    state = shoots_[child].filled ? SlotState::filled : SlotState::empty;
    if (state == SlotState::filled) push(child);
  }
  for (const ShootId id : shoots) {
    if (shoots_[id].bud != kNoShoot) in_bud_[shoots_[id].bud] = kNoShoot;
  }
  return out;
}

void GrowthPool::parents(const std::vector<ShootId>& history, std::vector<std::uint32_t>& parents) const {
  // Buds are numbered as genes come, and copies keep those numbers, so they ascend along a history.
  std::vector<std::uint32_t> genes;  // places in the history
  parents.assign(history.size(), 0);
  for (std::uint32_t i = 0; i < history.size(); ++i) {
    const Shoot& shoot = shoots_[history[i]];
    if (i > 0) {
      const auto behind = std::upper_bound(
          genes.begin(), genes.end(), shoot.bud,
          [&](BudId bud, std::uint32_t place) { return bud < shoots_[history[place]].first_bud; });
      parents[i] = *(behind - 1);
    }
    if (shoot.filled) genes.push_back(i);
  }
}

GrowingDerivation GrowthPool::cut_back(const GrowingDerivation& growing, const std::vector<ShootId>& history,
                                       const std::vector<std::uint32_t>& parents, const std::vector<std::uint8_t>& cut,
                                       std::vector<std::uint32_t>& kept) {
  GrowingDerivation out;
  out.detail_seed = growing.detail_seed;
  out.ledger.reset(graph_);
  kept.clear();
  stays_.assign(history.size(), 0);
  std::vector<BudId> decided;
  for (std::uint32_t i = 0; i < history.size(); ++i) {
    if (i > 0 && (cut[i] || !stays_[parents[i]])) continue;
    stays_[i] = 1;
    kept.push_back(i);
    Shoot copy = shoots_[history[i]];
    copy.previous = out.last;
    out.last = static_cast<ShootId>(shoots_.size());
    if (i > 0) decided.push_back(copy.bud);
    if (copy.filled) {
      ++out.genes;
      out.ledger.add(graph_.edges[copy.edge].child);
      const std::size_t slots = variant_of(copy).slots.size();
      for (BudId bud = copy.first_bud; bud < copy.first_bud + slots; ++bud) {
        if (!buds_[bud].absent) out.open.push_back(bud);
      }
    }
    shoots_.push_back(copy);
    depths_.push_back(depths_[history[i]]);
    for (std::uint32_t k = 0; k < counted_; ++k) counts_.push_back(counts_[history[i] * counted_ + k]);
  }
  // Both ascend, but for the order in which slots were decided.
  std::sort(decided.begin(), decided.end());
  std::erase_if(out.open, [&](BudId bud) { return std::binary_search(decided.begin(), decided.end(), bud); });
  return out;
}

void GrowthPool::keep_only(std::span<GrowingDerivation* const> living, GrowthRenumbering& renumbering) {
  renumbering.shoots.assign(shoots_.size(), kNoShoot);
  renumbering.buds.assign(buds_.size(), kNoShoot);
  for (const GrowingDerivation* growing : living) {
    for (ShootId id = growing->last; id != kNoShoot && renumbering.shoots[id] == kNoShoot; id = shoots_[id].previous) {
      renumbering.shoots[id] = 0;
    }
  }
  // Both are numbered anew in their old order, so that everything only moves down: copies are behind what they are
  // copies of, but their buds are before those of others.
  ShootId shoots = 0;
  for (ShootId id = 0; id < shoots_.size(); ++id) {
    if (renumbering.shoots[id] == kNoShoot) continue;
    const Shoot& shoot = shoots_[id];
    const std::size_t slots = shoot.filled ? variant_of(shoot).slots.size() : 0;
    for (std::size_t bud = shoot.first_bud; bud < shoot.first_bud + slots; ++bud) {
      if (renumbering.buds[bud] != kNoShoot) continue;  // the first of its copies that stays has it
      renumbering.buds[bud] = 0;
      buds_[bud].shoot = shoots;
    }
    renumbering.shoots[id] = shoots++;
  }
  std::vector<BudId> buds_before;  // that stay
  BudId buds = 0;
  for (BudId bud = 0; bud < buds_.size(); ++bud) {
    buds_before.push_back(buds);
    if (renumbering.buds[bud] == kNoShoot) continue;
    renumbering.buds[bud] = buds;
    buds_[buds++] = buds_[bud];
  }
  buds_before.push_back(buds);
  std::vector<std::uint32_t> new_draws;
  for (ShootId id = 0; id < shoots_.size(); ++id) {
    if (renumbering.shoots[id] == kNoShoot) continue;
    Shoot shoot = shoots_[id];
    if (shoot.previous != kNoShoot) shoot.previous = renumbering.shoots[shoot.previous];
    if (shoot.bud != kNoShoot) shoot.bud = renumbering.buds[shoot.bud];
    if (shoot.filled) {
      const auto first = draws_.begin() + shoot.first_draw;
      shoot.first_bud = buds_before[shoot.first_bud];
      shoot.first_draw = static_cast<std::uint32_t>(new_draws.size());
      new_draws.insert(new_draws.end(), first, first + static_cast<std::ptrdiff_t>(variant_of(shoot).draws.size()));
    }
    const ShootId place = renumbering.shoots[id];
    depths_[place] = depths_[id];
    std::copy_n(counts_.begin() + id * counted_, counted_, counts_.begin() + place * counted_);
    shoots_[place] = shoot;
  }
  shoots_.resize(shoots);
  buds_.resize(buds);
  draws_.swap(new_draws);
  depths_.resize(shoots);
  counts_.resize(std::size_t{shoots} * counted_);
  for (GrowingDerivation* growing : living) {
    growing->last = growing->last == kNoShoot ? kNoShoot : renumbering.shoots[growing->last];
    for (BudId& bud : growing->open) bud = renumbering.buds[bud];
  }
}

}  // namespace espalier
