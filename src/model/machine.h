#pragma once
// Machine: the interpreter of programs. It runs one program in one context (a gene's copy, or a call of a detail) and
// hands instances, bones, children and calls to its sinks. Internal to expansion.

#include <cstdint>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"

namespace espalier {

/// What the statements of a block change and its end brings back (language.md 23); the scope size is in the registers.
struct State {
  Frame frame;
  float material = 0;
  std::int32_t bone = -1;
  std::uint64_t key = 0;
  bool broken = false;  // a size was negative or not a number: emits nothing, nor does what stands below
};

/// A gene or a detail call waiting to be run. Its arguments (counted depths first, then parameters) lie in the arena of
/// the queue that it waits in.
struct Pending {
  State state;
  Vec3 scope{1};
  std::uint32_t depth = 0;
  GenePosition at;          // gene, first slot state, first draw
  std::uint16_t program = 0;  // details: which
};

/// Contexts with `stride` floats each.
class PendingQueue {
 public:
  void reset(std::uint32_t stride) {
    stride_ = stride;
    items_.clear();
    floats_.clear();
  }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  const Pending& operator[](std::size_t i) const { return items_[i]; }
  const float* floats(std::size_t i) const { return floats_.data() + i * stride_; }
  /// The floats of the new item, uninitialised.
  float* push(const Pending& item) {
    items_.push_back(item);
    floats_.resize(floats_.size() + stride_);
    return floats_.data() + floats_.size() - stride_;
  }
  void pop_back() {
    items_.pop_back();
    floats_.resize(floats_.size() - stride_);
  }

 private:
  std::uint32_t stride_ = 0;
  std::vector<Pending> items_;
  std::vector<float> floats_;
};

class Machine {
 public:
  explicit Machine(const GeneratorGraph& graph);

  /// Copies the counted depths and parameters of item i to their registers; before `run`.
  void load_floats(const PendingQueue& queue, std::size_t i) {
    const float* floats = queue.floats(i);
    for (std::uint32_t k = 0; k < counted_; ++k) registers_[kFirstDepthOfRegister + k] = *floats++;
    for (std::uint32_t k = 0; k < graph_.registers.parameters; ++k) registers_[graph_.registers.local_base + k] = *floats++;
  }

  /// Runs `program` in `context`. Rules: `derivation` holds the gene. Details: null, and draws come from the key.
  void run(const Program& program, const Pending& context, const Derivation* derivation, const Variant* variant);

  PendingQueue children;  // last in, first out
  PendingQueue calls;     // first in, first out
  Model* model = nullptr;
  bool details_wanted = false;
  std::uint32_t parts_left = 0;  // emits and calls still allowed; at 0 the model is truncated
  std::uint32_t turns_left = 0;  // turns of loops, likewise

 private:
  float value(const Operand& o) const {
    return o.coefficient == 0 ? o.bias : o.coefficient * registers_[o.reg] + o.bias;
  }
  float quantile(const Op& op, const std::uint32_t* draws) const;
  float draw_normal(const Op& op, float u) const;
  void place_children(const Derivation& derivation, const Pending& context, const Variant& variant);
  void turn(const Op& op);
  void aim(const Op& op);
  void emit(const Op& op, bool rule);
  void make_bone(const Op& op);
  void run_slot(const Program& program, const Op& op, const Derivation& derivation);
  void call(const Program& program, std::uint16_t call_site);
  bool spend_part();
  bool take_turn(float counter);
  Vec3 vector_at(std::uint32_t reg) const {
    return {registers_[reg], registers_[reg + 1], registers_[reg + 2]};
  }
  void set_scope(int axis, float size) {
    registers_[kScopeRegister + axis] = size;
    if (!(size >= 0)) state_.broken = true;
  }

  struct Saved {
    State state;
    Vec3 scope;
  };

  const GeneratorGraph& graph_;
  std::uint32_t counted_;  // number of counted rules
  std::vector<float> registers_;
  std::vector<Saved> saved_;
  State state_;
  // Of the gene that runs:
  const Pending* context_ = nullptr;
  std::vector<GenePosition> child_at_;  // per slot of the variant; meaningful where filled
};

}  // namespace espalier
