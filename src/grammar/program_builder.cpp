#include "grammar/program_builder.h"

#include <algorithm>

#include "grammar/arithmetic.h"

namespace espalier {
namespace {

bool is_constant(const Operand& o) { return o.coefficient == 0; }

Operand linear(float coefficient, float bias, Register reg) {
  return {coefficient, bias, coefficient == 0 ? kZeroRegister : reg};
}
Operand plus(const Operand& a, const Operand& b) {
  return linear(a.coefficient + b.coefficient, a.bias + b.bias, a.reg);
}
Operand times(const Operand& a, float k) { return linear(a.coefficient * k, a.bias * k, a.reg); }

}  // namespace

Register ProgramBuilder::new_local(int count) {
  if (locals_ + static_cast<std::uint32_t>(count) > kMostLocals) {
    overflow_ = true;
    return kLocalTag;
  }
  const auto reg = static_cast<Register>(kLocalTag + locals_);
  locals_ += static_cast<std::uint32_t>(count);
  return reg;
}

Op& ProgramBuilder::emit(OpCode code) {
  if (program.ops.size() >= kMostOps) {
    overflow_ = true;
    program.ops.pop_back();
  }
  program.ops.emplace_back().code = code;
  return program.ops.back();
}

std::uint32_t ProgramBuilder::jump(OpCode code, const Operand& condition, std::uint16_t slot) {
  Op& op = emit(code);
  op.x = condition;
  op.a = slot;
  return here() - 1;
}

void ProgramBuilder::save() {
  emit(OpCode::save).a = static_cast<std::uint16_t>(save_depth_++);
  most_saves_ = std::max(most_saves_, save_depth_);
}

void ProgramBuilder::restore() { emit(OpCode::restore).a = static_cast<std::uint16_t>(--save_depth_); }

void ProgramBuilder::load(Register dst, const Operand& operand) {
  Op& op = emit(OpCode::load);
  op.dst = dst;
  op.x = operand;
}

Operand ProgramBuilder::unary(Arithmetic code, const Operand& a) {
  if (is_constant(a)) return constant_operand(apply_unary(code, a.bias));
  if (code == Arithmetic::negate) return times(a, -1);
  Op& op = emit(OpCode::unary);
  op.arithmetic = code;
  op.x = a;
  op.dst = new_local(1);
  return register_operand(op.dst);
}

Operand ProgramBuilder::binary(Arithmetic code, const Operand& a, const Operand& b) {
  if (is_constant(a) && is_constant(b)) return constant_operand(apply_binary(code, a.bias, b.bias));
  switch (code) {
    case Arithmetic::add:
      if (is_constant(a)) return plus(b, a);
      if (is_constant(b) || a.reg == b.reg) return plus(a, b);
      break;
    case Arithmetic::subtract:
      if (is_constant(a)) return plus(times(b, -1), a);
      if (is_constant(b) || a.reg == b.reg) return plus(a, times(b, -1));
      break;
    case Arithmetic::multiply:
      if (is_constant(a)) return times(b, a.bias);
      if (is_constant(b)) return times(a, b.bias);
      break;
    case Arithmetic::divide:
      if (is_constant(b) && b.bias != 0) return linear(a.coefficient / b.bias, a.bias / b.bias, a.reg);
      break;
    default: break;
  }
  Op& op = emit(OpCode::binary);
  op.arithmetic = code;
  op.x = a;
  op.y = b;
  op.dst = new_local(1);
  return register_operand(op.dst);
}

Operand ProgramBuilder::ternary(Arithmetic code, const Operand& a, const Operand& b, const Operand& c) {
  if (is_constant(a) && is_constant(b) && is_constant(c))
    return constant_operand(apply_ternary(code, a.bias, b.bias, c.bias));
  if (code == Arithmetic::select && is_constant(a)) return a.bias != 0 ? b : c;
  Op& op = emit(OpCode::ternary);
  op.arithmetic = code;
  op.x = a;
  op.y = b;
  op.z = c;
  op.dst = new_local(1);
  return register_operand(op.dst);
}

Operand ProgramBuilder::capture(const Operand& operand) {
  if (is_constant(operand) || operand.reg > kScopeRegister + 2) return operand;  // only the scope's registers change
  const Register reg = new_local(1);
  load(reg, operand);
  return register_operand(reg);
}

Register ProgramBuilder::store3(const std::array<Operand, 3>& parts) {
  Op& op = emit(OpCode::load3);
  op.x = parts[0];
  op.y = parts[1];
  op.z = parts[2];
  op.dst = new_local(3);
  return op.dst;
}

namespace {

void relocate(Register& reg, Register local_base) {
  if (reg >= ProgramBuilder::kLocalTag) reg = static_cast<Register>(reg - ProgramBuilder::kLocalTag + local_base);
}

}  // namespace

void mark_last_slots(Program& program) {
  for (std::size_t i = 0; i + 1 < program.ops.size(); ++i) {
    if (program.ops[i].code == OpCode::slot && program.ops[i + 1].code == OpCode::end) program.ops[i].flags = kLast;
  }
}

void relocate(Program& program, Register local_base) {
  for (Op& op : program.ops) {
    if (op.code != OpCode::slot) relocate(op.dst, local_base);
    relocate(op.x.reg, local_base);
    relocate(op.y.reg, local_base);
    relocate(op.z.reg, local_base);
    if (op.code == OpCode::turn || op.code == OpCode::resize_run || op.code == OpCode::aim || op.code == OpCode::bone)
      relocate(op.a, local_base);
    if (op.code == OpCode::bone) {
      auto to = static_cast<Register>(op.b);
      relocate(to, local_base);
      op.b = to;
    }
  }
  for (CallSite& call : program.calls)
    for (Operand& arg : call.args) relocate(arg.reg, local_base);
  for (PaintSite& paint : program.paints)
    for (Operand& arg : paint.args) relocate(arg.reg, local_base);
  for (SlotCode& slot : program.slots)
    for (Operand& arg : slot.args) relocate(arg.reg, local_base);
}

}  // namespace espalier
