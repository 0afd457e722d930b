#include "model/machine.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/check.h"
#include "base/hash.h"
#include "grammar/arithmetic.h"

namespace espalier {

Machine::Machine(const GeneratorGraph& graph)
    : materials(std::make_unique<MaterialMaker>(graph)),
      graph_(graph),
      counted_(static_cast<std::uint32_t>(graph.counted_rules.size())),
      parameters_(graph.registers.parameters),
      register_file_(graph.registers.count + 4),
      registers_(register_file_.data()),
      saved_(graph.registers.save_depth + 1) {
  std::vector<std::uint32_t> first_of_rule;
  std::size_t most_slots = 0;
  for (const Rule& rule : graph.rules) {
    first_of_rule.push_back(static_cast<std::uint32_t>(codes_.size()));
    for (const Variant& variant : rule.variants) {
      codes_.push_back({&variant.program, static_cast<std::uint32_t>(variant.slots.size()),
                        static_cast<std::uint32_t>(variant.draws.size()), rule.counted ? *rule.counted : -1});
      most_slots = std::max(most_slots, variant.slots.size());
    }
  }
  for (const Edge& edge : graph.edges) first_code_.push_back(first_of_rule[edge.child]);
  child_at_.resize(most_slots);
}

void Machine::take(const PendingQueue& queue, std::size_t i) {
  // Field by field: wider loads than the stores that made them would wait for those to reach the cache.
  const Pending& item = queue[i];
  current_.state = item.state;
  current_.at.gene = item.at.gene;
  current_.at.slot = item.at.slot;
  current_.at.draw = item.at.draw;
  current_.depth = item.depth;
  current_.program = item.program;
  const float* floats = queue.floats(i);
  for (std::uint32_t k = 0; k < counted_; ++k) registers_[kFirstDepthOfRegister + k] = *floats++;
  for (std::uint32_t k = 0; k < parameters_; ++k) registers_[graph_.registers.local_base + k] = *floats++;
  for (int k = 0; k < 3; ++k) registers_[kScopeRegister + k] = current_.state.scope[k];
  registers_[kDepthRegister] = static_cast<float>(current_.depth);
}

void Machine::place_children(const Derivation& derivation) {
  const SlotState* const states = derivation.slots.data() + current_.at.slot;
  GenePosition next{current_.at.gene + 1, current_.at.slot + code_->slots, current_.at.draw + code_->draws};
  bool childless = true;
  for (std::uint32_t i = 0; i < code_->slots; ++i) {
    if (states[i] != SlotState::filled) continue;
    childless = false;
    child_at_[i] = next;
    const GeneRecord& child = derivation.genes[next.gene];
    const VariantCode& grown = code_of(child);
    next.gene += 1 + child.genes_below;
    next.slot += grown.slots + child.slots_below;
    next.draw += grown.draws + child.draws_below;
  }
  registers_[kChildlessRegister] = childless;
}

void Machine::run_gene(const Derivation& derivation) {
  do {
    code_ = &code_of(derivation.genes[current_.at.gene]);
    draws_ = derivation.draws.data() + current_.at.draw;
    place_children(derivation);
  } while (run<true>(*code_->program, &derivation));
}

void Machine::run_apart(EdgeId edge, std::uint16_t variant, const std::uint32_t* draws, const Derivation& slots) {
  code_ = &codes_[first_code_[edge] + variant];
  draws_ = draws;
  current_.at = {};
  for (std::uint32_t i = 0; i < code_->slots; ++i) child_at_[i] = {i, 0, 0};
  registers_[kChildlessRegister] = 0;
  if (!run<true>(*code_->program, &slots)) return;
  // The last child took the gene's place: it is to wait as the others do.
  float* floats;
  Pending& child = children.push(floats);
  child = current_;
  child.state.scope = lanes_at(kScopeRegister);
  for (std::uint32_t k = 0; k < counted_; ++k) *floats++ = registers_[kFirstDepthOfRegister + k];
  for (std::uint32_t k = 0; k < parameters_; ++k) *floats++ = registers_[graph_.registers.local_base + k];
}

void Machine::run_detail() { run<false>(graph_.details[current_.program], nullptr); }

template <bool kGene>
float Machine::high_bits(const Op& op, std::uint32_t component) const {
  const std::uint32_t q = kGene ? draws_[op.a + component]
                                : static_cast<std::uint32_t>(key_below(current_.state.key, op.b + component) >> 32);
  return static_cast<float>(static_cast<std::int32_t>(q >> 8));
}

void Machine::emit(const Op& op, Layer layer) {
  const State& s = current_.state;
  Lanes column[4] = {s.axis[0], s.axis[1], s.axis[2], s.origin};
  if (!(op.flags & kEmitAsIs))
    for (int i = 0; i < 3; ++i) column[i] *= registers_[i];
  // The sum is finite just when all terms are (or so large that they might as well not be); so with `top`.
  const Lanes sum = (column[0] + column[1]) + (column[2] + column[3]);
  const Lanes zero = sum - sum;
  const float top = value(op.y);
  if (broken_scope() || !(zero[0] + zero[1] + zero[2] + (top - top) == 0)) {
    ++model->dropped;
    return;
  }
  if (!spend_part()) return;
  Instance& instance = model->instances.emplace_back();
  static_assert(sizeof(Frame) == 12 * sizeof(float) && offsetof(Instance, top) == sizeof(Frame));
  char* const frame = reinterpret_cast<char*>(&instance);
  for (int i = 0; i < 4; ++i) std::memcpy(frame + 12 * i, &column[i], sizeof(Lanes));  // each overwrites a fourth lane
  instance.top = top;
  instance.mesh = static_cast<std::uint16_t>(value(op.x));
  instance.material = static_cast<std::uint16_t>(s.material);
  instance.gene = current_.at.gene;
  instance.layer = layer == Layer::rule && op.flags & kEmitProxy ? Layer::proxy : layer;
}

void Machine::call(const Program& program, std::uint16_t call_site) {
  if (!details_wanted || call_site == kNoCall) return;
  if (broken_scope()) {
    ++model->dropped;
    return;
  }
  if (!spend_part()) return;
  const CallSite& site = program.calls[call_site];
  float* floats;
  Pending& pending = calls.push(floats);
  pending = current_;
  pending.state.scope = lanes_at(kScopeRegister);
  pending.state.key = key_below(current_.state.key, site.site);
  pending.program = site.detail;
  for (std::uint32_t i = 0; i < counted_; ++i) *floats++ = registers_[kFirstDepthOfRegister + i];
  for (const Operand& arg : site.args) *floats++ = value(arg);
}

void Machine::run_slot(const Program& program, const Op& op, const Derivation& derivation) {
  const SlotCode& code = program.slots[op.dst];
  switch (derivation.slots[current_.at.slot + op.a]) {
    case SlotState::open: call(program, code.on_open); return;
    case SlotState::empty:
    case SlotState::absent: call(program, code.on_empty); return;
    case SlotState::filled: break;
  }
  if (broken_scope()) {
    ++model->dropped;
    return;
  }
  if (copies_left == 0) {
    model->truncated = true;
    return;
  }
  --copies_left;
  float* floats;
  Pending& child = children.push(floats);
  child.state = current_.state;
  child.state.scope = lanes_at(kScopeRegister);
  if (details_wanted) child.state.key = key_below(current_.state.key, op.b);
  child.at = child_at_[op.a];
  child.depth = current_.depth + 1;
  for (std::uint32_t i = 0; i < counted_; ++i)
    *floats++ = registers_[kFirstDepthOfRegister + i] + (code_->counted == static_cast<std::int32_t>(i) ? 1.0f : 0.0f);
  for (const Operand& arg : code.args) *floats++ = value(arg);
}

// A gene that ends with a slot hands its state to the child there: nothing is queued, nothing copied.
void Machine::enter_child(const SlotCode& code, const Op& op) {
  --copies_left;
  if (details_wanted) current_.state.key = key_below(current_.state.key, op.b);
  current_.at = child_at_[op.a];
  ++current_.depth;
  registers_[kDepthRegister] = static_cast<float>(current_.depth);
  if (code_->counted >= 0) registers_[kFirstDepthOfRegister + static_cast<std::uint32_t>(code_->counted)] += 1;
  if (code.args.empty()) return;
  arguments_.clear();
  for (const Operand& arg : code.args) arguments_.push_back(value(arg));  // all before any is overwritten
  std::copy(arguments_.begin(), arguments_.end(), registers_ + graph_.registers.local_base);
}

// Longer than other functions by design: one place where every operation is told.
template <bool kGene>
bool Machine::run(const Program& program, const Derivation* derivation) {
  State& state = current_.state;
  const Op* const ops = program.ops.data();
  for (const Op* next = ops;;) {
    const Op& op = *next++;
    switch (op.code) {
      case OpCode::end: return false;
      case OpCode::move_axis: state.origin += value(op.x) * state.axis[op.axis]; break;
      case OpCode::move:
        state.origin += value(op.x) * state.axis[0] + value(op.y) * state.axis[1] + value(op.z) * state.axis[2];
        break;
      case OpCode::turn_axis: turn_axis(op.axis, value(op.x)); break;
      case OpCode::turn: turn(op); break;
      case OpCode::scale:
        state.axis[0] *= value(op.x);
        state.axis[1] *= value(op.y);
        state.axis[2] *= value(op.z);
        break;
      case OpCode::reflect: state.axis[op.axis] = -state.axis[op.axis]; break;
      case OpCode::aim: aim(op); break;
      case OpCode::size_axis: set_scope(op.axis, value(op.x)); break;
      case OpCode::size: {
        const float x = value(op.x), y = value(op.y), z = value(op.z);
        set_scope(0, x), set_scope(1, y), set_scope(2, z);
        break;
      }
      case OpCode::resize_axis: set_scope(op.axis, registers_[op.axis] * value(op.x)); break;
      case OpCode::resize: {
        const float x = value(op.x), y = value(op.y), z = value(op.z);
        set_scope(0, registers_[0] * x), set_scope(1, registers_[1] * y), set_scope(2, registers_[2] * z);
        break;
      }
      case OpCode::resize_run:
        for (int i = 0; i < 3; ++i) set_scope(i, registers_[i] * registers_[op.a + i]);
        break;
      case OpCode::face: enter_face(static_cast<Face>(op.axis)); break;
      case OpCode::save:
        state.scope = lanes_at(kScopeRegister);
        saved_[op.a] = state;
        break;
      case OpCode::restore:
        state = saved_[op.a];
        for (int i = 0; i < 3; ++i) registers_[kScopeRegister + i] = state.scope[i];
        break;
      case OpCode::emit:
        if (parts_wanted) emit(op, kGene ? Layer::rule : Layer::detail);
        break;
      case OpCode::bone: make_bone(op); break;
      case OpCode::bone_along:
        make_bone(state.origin + value(op.x) * state.axis[op.axis], state.origin + value(op.y) * state.axis[op.axis]);
        break;
      case OpCode::paint: state.material = value(op.x); break;
      case OpCode::slot:
        if (op.flags & kLast && derivation->slots[current_.at.slot + op.a] == SlotState::filled && !broken_scope() &&
            copies_left > 0) {
          enter_child(program.slots[op.dst], op);
          return true;
        }
        run_slot(program, op, *derivation);
        break;
      case OpCode::detail: call(program, op.a); break;
      case OpCode::draw_uniform: {
        const float low = value(op.x);
        registers_[op.dst] = low + (value(op.y) - low) * quantile<kGene>(op, 0);
        break;
      }
      case OpCode::draw_uniform1:
        registers_[op.dst] = op.x.bias + op.x.coefficient * high_bits<kGene>(op, 0);
        break;
      case OpCode::draw_uniform3:
        registers_[op.dst] = op.x.bias + op.x.coefficient * high_bits<kGene>(op, 0);
        registers_[op.dst + 1] = op.y.bias + op.y.coefficient * high_bits<kGene>(op, 1);
        registers_[op.dst + 2] = op.z.bias + op.z.coefficient * high_bits<kGene>(op, 2);
        break;
      case OpCode::draw_normal: registers_[op.dst] = draw_normal(op, quantile<kGene>(op, 0)); break;
      case OpCode::draw_loguniform: {
        const float low = value(op.x);
        registers_[op.dst] = low * power(value(op.y) / low, quantile<kGene>(op, 0));
        break;
      }
      case OpCode::draw_integer: {
        const float low = value(op.x), high = value(op.y);
        const float drawn = low + std::floor((high - low + 1) * quantile<kGene>(op, 0));
        registers_[op.dst] = std::min(drawn, std::max(low, high));
        break;
      }
      case OpCode::load: registers_[op.dst] = value(op.x); break;
      case OpCode::load3: {
        const float x = value(op.x), y = value(op.y), z = value(op.z);
        registers_[op.dst] = x, registers_[op.dst + 1] = y, registers_[op.dst + 2] = z;
        break;
      }
      case OpCode::unary: registers_[op.dst] = apply_unary(op.arithmetic, value(op.x)); break;
      case OpCode::binary:
        registers_[op.dst] = op.arithmetic == Arithmetic::multiply
                                 ? value(op.x) * value(op.y)
                                 : apply_binary(op.arithmetic, value(op.x), value(op.y));
        break;
      case OpCode::ternary:
        registers_[op.dst] = apply_ternary(op.arithmetic, value(op.x), value(op.y), value(op.z));
        break;
      case OpCode::mix_material: {
        const float given = value(op.x), t = given > 0 ? std::min(given, 1.0f) : 0.0f;  // 0 for what is no number
        registers_[op.dst] = static_cast<float>(op.a) + std::floor(16 * t + 0.5f);
        break;
      }
      case OpCode::make_material: make_material(program, op); break;
      case OpCode::jump: next = ops + op.b; break;
      case OpCode::jump_if_zero:
        if (value(op.x) == 0) next = ops + op.b;
        break;
      case OpCode::jump_unless_used:
        if (derivation->slots[current_.at.slot + op.a] != SlotState::filled) next = ops + op.b;
        break;
      case OpCode::loop_test:
        if (!(registers_[op.dst] < value(op.x)) || !take_turn(registers_[op.dst])) next = ops + op.b;
        break;
      case OpCode::key:
        state.key = key_below(state.key, static_cast<std::uint64_t>(static_cast<std::int64_t>(value(op.x))));
        break;
      case OpCode::reseed: state.key = scatter(std::bit_cast<std::uint32_t>(value(op.x)) + 0x5eedull); break;
      default: __builtin_unreachable();
    }
  }
}

}  // namespace espalier
