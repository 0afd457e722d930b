#include "model/machine.h"

#include <bit>
#include <cmath>

#include "base/check.h"
#include "base/hash.h"
#include "base/math.h"
#include "grammar/arithmetic.h"

namespace espalier {
namespace {

void turn_about_axis(Mat3& m, int axis, float angle) {
  float s, c;
  sin_cos(angle, s, c);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vec3 u = m[i], v = m[j];
  m[i] = c * u + s * v;
  m[j] = c * v - s * u;
}

/// The rotation about the unit vector `u` whose angle has this sine and cosine (Rodrigues).
Mat3 rotation(const Vec3& u, float s, float c) {
  const float t = 1 - c;
  return Mat3(Vec3(c + t * u.x * u.x, t * u.x * u.y + s * u.z, t * u.x * u.z - s * u.y),
              Vec3(t * u.x * u.y - s * u.z, c + t * u.y * u.y, t * u.y * u.z + s * u.x),
              Vec3(t * u.x * u.z + s * u.y, t * u.y * u.z - s * u.x, c + t * u.z * u.z));
}

float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
float length(const Vec3& v) { return std::sqrt(dot(v, v)); }

bool finite(const Mat3& m, const Vec3& t) {
  const float sum = std::fabs(m[0].x) + std::fabs(m[0].y) + std::fabs(m[0].z) + std::fabs(m[1].x) +
                    std::fabs(m[1].y) + std::fabs(m[1].z) + std::fabs(m[2].x) + std::fabs(m[2].y) +
                    std::fabs(m[2].z) + std::fabs(t.x) + std::fabs(t.y) + std::fabs(t.z);
  return sum - sum == 0;
}

}  // namespace

Machine::Machine(const GeneratorGraph& graph)
    : graph_(graph),
      counted_(static_cast<std::uint32_t>(graph.counted_rules.size())),
      registers_(graph.registers.count + 4),
      saved_(graph.registers.save_depth + 1) {}

float Machine::quantile(const Op& op, const std::uint32_t* draws) const {
  const std::uint32_t q = draws ? draws[op.a] : static_cast<std::uint32_t>(key_below(state_.key, op.b) >> 32);
  return static_cast<float>(q >> 8) * 0x1.0p-24f;
}

float Machine::draw_normal(const Op& op, float u) const {
  const float mean = value(op.x), sd = value(op.y), low = value(op.z), high = registers_[op.dst];
  const double p_low = normal_cdf((low - mean) / sd), p_high = normal_cdf((high - mean) / sd);
  const double p = p_low + (p_high - p_low) * u;
  if (!(p > 0 && p < 1)) return u < 0.5f ? low : high;
  const float drawn = mean + sd * inverse_normal_cdf(p);
  return std::min(std::max(drawn, low), high);
}

void Machine::place_children(const Derivation& derivation, const Pending& context, const Variant& variant) {
  GenePosition next{context.at.gene + 1, context.at.slot + static_cast<std::uint32_t>(variant.slots.size()),
                    context.at.draw + static_cast<std::uint32_t>(variant.draws.size())};
  child_at_.resize(variant.slots.size());
  for (std::size_t i = 0; i < variant.slots.size(); ++i) {
    if (derivation.slots[context.at.slot + i] != SlotState::filled) continue;
    child_at_[i] = next;
    const GeneRecord& child = derivation.genes[next.gene];
    const Variant& grown = variant_of(graph_, child);
    next.gene += 1 + child.genes_below;
    next.slot += static_cast<std::uint32_t>(grown.slots.size()) + child.slots_below;
    next.draw += static_cast<std::uint32_t>(grown.draws.size()) + child.draws_below;
  }
}

void Machine::turn(const Op& op) {
  const Vec3 about = vector_at(op.a);
  const float size = length(about);
  if (!(size > 0)) return;
  float s, c;
  sin_cos(value(op.x), s, c);
  state_.frame.basis = state_.frame.basis * rotation(about / size, s, c);
}

// Turns the local axis, as it stands in model space, by the shortest arc towards a direction (language.md 30).
void Machine::aim(const Op& op) {
  const Vec3 wanted = op.flags & kAimAt ? vector_at(op.a) - state_.frame.origin : vector_at(op.a);
  const Vec3 axis = state_.frame.basis[op.axis];
  const float size = length(wanted) * length(axis);
  if (!(size > 0)) return;
  const float c = std::min(std::max(dot(axis, wanted) / size, -1.0f), 1.0f);
  Vec3 about = cross(axis, wanted);
  if (length(about) < 1e-6f * size) {
    if (c > 0) return;
    about = state_.frame.basis[(op.axis + 1) % 3];  // opposite: about the next axis
  }
  about /= length(about);
  float s, turned;
  sin_cos(value(op.x) * std::acos(c), s, turned);
  state_.frame.basis = rotation(about, s, turned) * state_.frame.basis;
}

bool Machine::spend_part() {
  if (parts_left == 0) {
    model->truncated = true;
    return false;
  }
  --parts_left;
  return true;
}

bool Machine::take_turn(float counter) {
  if (counter >= kMostTurns || turns_left == 0) model->truncated = true;
  if (model->truncated) return false;
  --turns_left;
  return true;
}

void Machine::emit(const Op& op, bool rule) {
  Instance instance;
  const float x = registers_[0], y = registers_[1], z = registers_[2];
  const Mat3& basis = state_.frame.basis;
  instance.model_from_mesh.basis = op.flags & kEmitAsIs ? basis : Mat3(x * basis[0], y * basis[1], z * basis[2]);
  instance.model_from_mesh.origin = state_.frame.origin;
  if (state_.broken || !finite(instance.model_from_mesh.basis, instance.model_from_mesh.origin)) {
    ++model->dropped;
    return;
  }
  if (!spend_part()) return;
  instance.top = value(op.y);
  instance.mesh = static_cast<std::uint16_t>(value(op.x));
  instance.material = static_cast<std::uint16_t>(state_.material);
  instance.gene = context_->at.gene;
  instance.layer = !rule ? Layer::detail : op.flags & kEmitProxy ? Layer::proxy : Layer::rule;
  model->instances.push_back(instance);
}

void Machine::make_bone(const Op& op) {
  const Vec3 from = state_.frame.point(vector_at(op.a)), to = state_.frame.point(vector_at(op.b));
  if (state_.broken || !(length(to - from) < INFINITY)) {
    ++model->dropped;
    return;
  }
  model->bones.push_back({from, to, state_.bone, context_->at.gene});
  state_.bone = static_cast<std::int32_t>(model->bones.size()) - 1;
}

void Machine::call(const Program& program, std::uint16_t call_site) {
  if (!details_wanted || call_site == kNoCall) return;
  if (state_.broken) {
    ++model->dropped;
    return;
  }
  if (!spend_part()) return;
  const CallSite& site = program.calls[call_site];
  Pending pending{state_, vector_at(kScopeRegister), context_->depth, context_->at, site.detail};
  pending.state.key = key_below(state_.key, site.site);
  float* floats = calls.push(pending);
  for (std::uint32_t i = 0; i < counted_; ++i) *floats++ = registers_[kFirstDepthOfRegister + i];
  for (const Operand& arg : site.args) *floats++ = value(arg);
}

void Machine::run_slot(const Program& program, const Op& op, const Derivation& derivation) {
  const SlotCode& code = program.slots[op.dst];
  switch (derivation.slots[context_->at.slot + op.a]) {
    case SlotState::open: call(program, code.on_open); return;
    case SlotState::empty:
    case SlotState::absent: call(program, code.on_empty); return;
    case SlotState::filled: break;
  }
  if (state_.broken) {
    ++model->dropped;
    return;
  }
  Pending pending{state_, vector_at(kScopeRegister), context_->depth + 1, child_at_[op.a], 0};
  if (graph_.uses_details) pending.state.key = key_below(state_.key, op.b);
  float* floats = children.push(pending);
  if (counted_ > 0) {
    const GeneRecord& gene = derivation.genes[context_->at.gene];
    const auto counted = rule_of(graph_, gene).counted;
    for (std::uint32_t i = 0; i < counted_; ++i)
      *floats++ = registers_[kFirstDepthOfRegister + i] + (counted && *counted == i ? 1.0f : 0.0f);
  }
  for (const Operand& arg : code.args) *floats++ = value(arg);
}

void Machine::run(const Program& program, const Pending& context, const Derivation* derivation,
                  const Variant* variant) {
  context_ = &context;
  state_ = context.state;
  for (int i = 0; i < 3; ++i) registers_[kScopeRegister + i] = context.scope[i];
  registers_[kDepthRegister] = static_cast<float>(context.depth);
  const std::uint32_t* draws = nullptr;
  if (derivation) {
    place_children(*derivation, context, *variant);
    draws = derivation->draws.data() + context.at.draw;
    if (graph_.uses_childless) {
      bool childless = true;
      for (std::size_t i = 0; i < variant->slots.size(); ++i)
        childless &= derivation->slots[context.at.slot + i] != SlotState::filled;
      registers_[kChildlessRegister] = childless;
    }
  }

  Mat3& basis = state_.frame.basis;
  Vec3& origin = state_.frame.origin;
  const Op* const ops = program.ops.data();
  for (const Op* next = ops;;) {
    const Op& op = *next++;
    switch (op.code) {
      case OpCode::end: return;
      case OpCode::move_axis: origin += value(op.x) * basis[op.axis]; break;
      case OpCode::move: origin += value(op.x) * basis[0] + value(op.y) * basis[1] + value(op.z) * basis[2]; break;
      case OpCode::turn_axis: turn_about_axis(basis, op.axis, value(op.x)); break;
      case OpCode::turn: turn(op); break;
      case OpCode::scale:
        basis[0] *= value(op.x);
        basis[1] *= value(op.y);
        basis[2] *= value(op.z);
        break;
      case OpCode::reflect: basis[op.axis] = -basis[op.axis]; break;
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
      case OpCode::save: saved_[op.a] = {state_, vector_at(kScopeRegister)}; break;
      case OpCode::restore:
        state_ = saved_[op.a].state;
        for (int i = 0; i < 3; ++i) registers_[kScopeRegister + i] = saved_[op.a].scope[i];
        break;
      case OpCode::emit: emit(op, derivation != nullptr); break;
      case OpCode::bone: make_bone(op); break;
      case OpCode::paint: state_.material = value(op.x); break;
      case OpCode::slot: run_slot(program, op, *derivation); break;
      case OpCode::detail: call(program, op.a); break;
      case OpCode::draw_uniform: {
        const float low = value(op.x);
        registers_[op.dst] = low + (value(op.y) - low) * quantile(op, draws);
        break;
      }
      case OpCode::draw_normal: registers_[op.dst] = draw_normal(op, quantile(op, draws)); break;
      case OpCode::draw_loguniform: {
        const float low = value(op.x);
        registers_[op.dst] = low * std::pow(value(op.y) / low, quantile(op, draws));
        break;
      }
      case OpCode::draw_integer: {
        const float low = value(op.x), high = value(op.y);
        registers_[op.dst] = std::min(low + std::floor((high - low + 1) * quantile(op, draws)), std::max(low, high));
        break;
      }
      case OpCode::load: registers_[op.dst] = value(op.x); break;
      case OpCode::load3: {
        const float x = value(op.x), y = value(op.y), z = value(op.z);
        registers_[op.dst] = x, registers_[op.dst + 1] = y, registers_[op.dst + 2] = z;
        break;
      }
      case OpCode::unary: registers_[op.dst] = apply_unary(op.arithmetic, value(op.x)); break;
      case OpCode::binary: registers_[op.dst] = apply_binary(op.arithmetic, value(op.x), value(op.y)); break;
      case OpCode::ternary:
        registers_[op.dst] = apply_ternary(op.arithmetic, value(op.x), value(op.y), value(op.z));
        break;
      case OpCode::mix_material:
        registers_[op.dst] =
            static_cast<float>(op.a) + std::floor(16 * apply_ternary(Arithmetic::clamp, value(op.x), 0, 1) + 0.5f);
        break;
      case OpCode::jump: next = ops + op.b; break;
      case OpCode::jump_if_zero:
        if (value(op.x) == 0) next = ops + op.b;
        break;
      case OpCode::jump_unless_used:
        if (derivation->slots[context.at.slot + op.a] != SlotState::filled) next = ops + op.b;
        break;
      case OpCode::loop_test:
        if (!(registers_[op.dst] < value(op.x)) || !take_turn(registers_[op.dst])) next = ops + op.b;
        break;
      case OpCode::key:
        state_.key = key_below(state_.key, static_cast<std::uint64_t>(static_cast<std::int64_t>(value(op.x))));
        break;
      case OpCode::reseed: state_.key = scatter(std::bit_cast<std::uint32_t>(value(op.x)) + 0x5eedull); break;
    }
  }
}

}  // namespace espalier
