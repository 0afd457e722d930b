#include "model/gene_expander.h"

#include <algorithm>

#include "base/check.h"
#include "model/machine.h"

namespace espalier {
namespace {

constexpr std::uint32_t kNoItem = 0xffffffff;
constexpr std::uint32_t kMostCopies = 10'000;  // of one gene: mirrors within mirrors double at every level

}  // namespace

struct GeneExpander::Items {
  explicit Items(const GeneratorGraph& graph) : machine(graph) {}
  Machine machine;  // its queue of children holds the items
};

GeneExpander::GeneExpander(const GeneratorGraph& graph) : graph_(graph), items_(std::make_unique<Items>(graph)) {
  Machine& machine = items_->machine;
  machine.model = &model_;
  machine.parts_wanted = machine.details_wanted = machine.materials_wanted = false;
  globals_ = static_cast<std::uint32_t>(machine.globals().size());
  stride_ = static_cast<std::uint32_t>(graph.counted_rules.size()) + graph.registers.parameters + globals_;
  clear();
}

GeneExpander::~GeneExpander() = default;

void GeneExpander::clear() {
  items_->machine.children.reset(stride_);
  first_item_.clear();
  next_item_.clear();
}

std::size_t GeneExpander::bytes() const {
  return items_->machine.children.size() * (sizeof(Pending) + stride_ * sizeof(float) + sizeof(std::uint32_t)) +
         first_item_.size() * sizeof(std::uint32_t);
}

/// Runs the machine's current item.
void GeneExpander::run_item(const GrowthPool& pool, const GrowthPool::Shoot& shoot) {
  Machine& machine = items_->machine;
  machine.turns_left = 1'000'000;
  machine.copies_left = kMostCopies;
  machine.run_apart(shoot.edge, shoot.variant, pool.draws(shoot), slots_);
}

std::span<const Bone> GeneExpander::run(const GrowthPool& pool, ShootId id) {
  Machine& machine = items_->machine;
  PendingQueue& queue = machine.children;
  const GrowthPool::Shoot& shoot = pool.shoot(id);
  DCHECK(shoot.filled);
  model_.clear();
  const std::size_t slots = pool.variant_of(shoot).slots.size();
  slots_.slots.resize(slots);
  for (std::size_t k = 0; k < slots; ++k) {
    slots_.slots[k] = pool.bud(shoot.first_bud + static_cast<BudId>(k)).absent ? SlotState::absent : SlotState::filled;
  }
  const std::size_t first = queue.size();
  if (shoot.bud == kNoShoot) {
    // As the start gene: an item of its own, taken back before its children come.
    float* floats;
    queue.push(floats) = Pending{};
    std::fill_n(floats, stride_, 0.0f);
    machine.take(queue, first);
    queue.pop_back();
    run_item(pool, shoot);
  } else {
    std::uint32_t copies = 0;
    for (std::uint32_t item = first_item_[shoot.bud]; item != kNoItem && copies < kMostCopies; item = next_item_[item]) {
      machine.take(queue, item);
      const float* globals = queue.floats(item) + (stride_ - globals_);
      std::copy_n(globals, globals_, machine.globals().begin());
      run_item(pool, shoot);
      ++copies;
    }
  }
  file_children(shoot, slots, first);
  return model_.bones;
}

std::span<const Bone> GeneExpander::run_at_origin(const GrowthPool& pool, ShootId id, const GeneExpander& from,
                                                  BudId bud) {
  Machine& machine = items_->machine;
  PendingQueue& queue = machine.children;
  const PendingQueue& others = from.items_->machine.children;
  CHECK(pool.shoot(id).bud == kNoShoot && from.first_item_[bud] != kNoItem);
  const std::size_t first = queue.size();
  const std::size_t other = from.first_item_[bud];
  model_.clear();
  const GrowthPool::Shoot& shoot = pool.shoot(id);
  const std::size_t slots = pool.variant_of(shoot).slots.size();
  slots_.slots.resize(slots);
  for (std::size_t k = 0; k < slots; ++k) {
    slots_.slots[k] = pool.bud(shoot.first_bud + static_cast<BudId>(k)).absent ? SlotState::absent : SlotState::filled;
  }
  float* floats;
  Pending& item = queue.push(floats);
  item = others[other];
  std::copy_n(others.floats(other), stride_, floats);
  const State identity;
  item.state.origin = identity.origin;
  for (int axis = 0; axis < 3; ++axis) item.state.axis[axis] = identity.axis[axis];
  machine.take(queue, first);
  std::copy_n(floats + (stride_ - globals_), globals_, machine.globals().begin());
  queue.pop_back();
  run_item(pool, shoot);
  file_children(shoot, slots, first);
  return model_.bones;
}

/// Links what the gene's slots have queued since `first_item` to their buds.
void GeneExpander::file_children(const GrowthPool::Shoot& shoot, std::size_t slots, std::size_t first_item) {
  PendingQueue& queue = items_->machine.children;
  first_item_.resize(std::max(first_item_.size(), shoot.first_bud + slots), kNoItem);
  next_item_.resize(queue.size(), kNoItem);
  const std::span<float> globals = items_->machine.globals();
  for (std::size_t i = queue.size(); i-- > first_item;) {
    // From behind, so that the first copy comes first.
    const std::size_t bud = shoot.first_bud + queue[i].at.gene;
    next_item_[i] = first_item_[bud];
    first_item_[bud] = static_cast<std::uint32_t>(i);
    if (globals_ > 0) std::copy(globals.begin(), globals.end(), queue.floats(i) + (stride_ - globals_));
  }
}

bool GeneExpander::frame(BudId bud, Frame& world_from_bud) const {
  if (bud >= first_item_.size() || first_item_[bud] == kNoItem) return false;
  const State& state = items_->machine.children[first_item_[bud]].state;
  for (int axis = 0; axis < 3; ++axis) {
    world_from_bud.basis[axis] = Vec3(state.axis[axis][0], state.axis[axis][1], state.axis[axis][2]);
  }
  world_from_bud.origin = Vec3(state.origin[0], state.origin[1], state.origin[2]);
  return true;
}

void GeneExpander::renumber(const GrowthRenumbering& renumbering) {
  PendingQueue& queue = items_->machine.children;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> next;
  PendingQueue kept;
  kept.reset(stride_);
  for (std::size_t bud = 0; bud < std::min(renumbering.buds.size(), first_item_.size()); ++bud) {
    if (renumbering.buds[bud] == kNoShoot) continue;
    first.resize(renumbering.buds[bud] + 1, kNoItem);
    std::uint32_t* link = &first.back();
    for (std::uint32_t item = first_item_[bud]; item != kNoItem; item = next_item_[item]) {
      *link = static_cast<std::uint32_t>(kept.size());
      float* floats;
      kept.push(floats) = queue[item];
      std::copy_n(queue.floats(item), stride_, floats);
      next.push_back(kNoItem);
      link = &next.back();
    }
  }
  queue = std::move(kept);
  first_item_ = std::move(first);
  next_item_ = std::move(next);
}

}  // namespace espalier
