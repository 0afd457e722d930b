// BodyCompiler: draws.

#include <algorithm>

#include <fmt/core.h>

#include "base/math.h"
#include "grammar/body_compiler.h"

namespace espalier {
namespace {

/// What takes 24 bits of a quantile to a value between constants. The power of two is folded in; that is exact.
Operand folded_range(const Operand& low, const Operand& high) {
  return {(high.bias - low.bias) * 0x1p-24f, low.bias, kZeroRegister};
}

}  // namespace

void BodyCompiler::register_draw(const Site& site, const std::string& name, int components, DrawShape shape,
                                 std::uint32_t values) {
  if (!is_rule()) return;
  Rule& rule = tables_.graph.rules[shape_->id];
  if (finding_shape()) {
    const auto [it, fresh] = shape_->draws.try_emplace(site, static_cast<std::uint16_t>(rule.draws.size()));
    static_cast<void>(it);
    for (int i = 0; fresh && i < components; ++i)
      rule.draws.push_back({components == 1 ? name : fmt::format("{}.{}", name, "xyz"[i]), shape, values});
    return;
  }
  const auto [it, fresh] =
      variant_draws_.try_emplace(site, static_cast<std::uint16_t>(variant_->draws.size()));
  static_cast<void>(it);
  const std::uint16_t first = shape_->draws.at(site);
  for (int i = 0; fresh && i < components; ++i) variant_->draws.push_back(static_cast<std::uint16_t>(first + i));
}

Operand BodyCompiler::draw_component(OpCode code, const Operand& x, const Operand& y, const Operand& z,
                                     const Operand* high, int component, const std::string& name) {
  const Register dst = builder_.new_local(1);
  if (high) builder_.load(dst, *high);
  Op& op = builder_.emit(code);
  op.dst = dst;
  op.x = x, op.y = y, op.z = z;
  if (is_rule() && !finding_shape()) op.a = static_cast<std::uint16_t>(variant_draws_.at(draw_site_) + component);
  op.b = name_hash(fmt::format("{}.{}", name, component));
  return register_operand(dst);
}

void BodyCompiler::draw(const ast::Stmt& stmt, NameScope& scope) {
  std::string name = fmt::format("{}.{}", decl_.name, stmt.name);
  for (const int turn : turns_) name += fmt::format("[{}]", turn);
  draw_site_ = {&stmt, turns_};
  bind(stmt, draw_value(stmt, scope, name), scope);
}

Value BodyCompiler::draw_value(const ast::Stmt& stmt, const NameScope& scope, const std::string& name) {
  const ast::Expr& call = *stmt.exprs[0];
  const Operand zero = constant_operand(0), one = constant_operand(1);
  if (call.name == "pick") return pick(call, scope, name);
  if (call.name == "angle") {
    register_draw(draw_site_, name, 1, DrawShape::circular, 0);
    const Operand full_turn = constant_operand(static_cast<float>(2 * kPi));
    return {Kind::angle, {draw_component(OpCode::draw_uniform, zero, full_turn, zero, nullptr, 0, name)}, {}};
  }
  std::vector<Value> args;
  for (const ast::Arg& arg : call.args) args.push_back(expressions_.compile(*arg.value, scope));
  if (call.name == "chance") {
    register_draw(draw_site_, name, 1, DrawShape::discrete, 2);
    const Operand u = draw_component(OpCode::draw_uniform, zero, one, zero, nullptr, 0, name);
    return {Kind::boolean, {builder_.binary(Arithmetic::less, u, args[0].parts[0])}, {}};
  }

  const bool integer = call.name == "integer";
  const OpCode code = integer                      ? OpCode::draw_integer
                      : call.name == "normal"      ? OpCode::draw_normal
                      : call.name == "loguniform"  ? OpCode::draw_loguniform
                                                   : OpCode::draw_uniform;
  Value value{args[0].kind, {}, {}};
  for (const Value& arg : args)
    if (arg.kind == Kind::vector) value.kind = Kind::vector;
  if (value.kind == Kind::vector)
    for (Value& arg : args) arg = spread(arg);
  std::uint32_t values = 0;
  if (integer && args[0].constant() && args[1].constant())
    values = static_cast<std::uint32_t>(std::clamp(std::floor(args[1].number() - args[0].number()) + 1, 1.0f, 1e6f));
  const DrawShape shape = integer && values ? DrawShape::discrete : DrawShape::continuous;
  register_draw(draw_site_, name, value.width(), shape, values);
  const bool fixed = args[0].constant() && args[1].constant();
  if (code == OpCode::draw_uniform && value.kind == Kind::vector && fixed) return draw_vector(args[0], args[1], name);
  if (code == OpCode::draw_uniform && fixed) {
    const Operand range = folded_range(args[0].parts[0], args[1].parts[0]);
    value.parts[0] = draw_component(OpCode::draw_uniform1, range, zero, zero, nullptr, 0, name);
    return value;
  }
  for (int i = 0; i < value.width(); ++i) {
    const Operand low = args.size() > 2 ? args[2].parts[i] : zero;
    const Operand* high = args.size() > 3 ? &args[3].parts[i] : nullptr;
    value.parts[i] = draw_component(code, args[0].parts[i], args[1].parts[i], low, high, i, name);
  }
  return value;
}

// Three components of constant ranges in one operation; the commonest draw of all.
Value BodyCompiler::draw_vector(const Value& low, const Value& high, const std::string& name) {
  const Register dst = builder_.new_local(3);
  Op& op = builder_.emit(OpCode::draw_uniform3);
  op.dst = dst;
  Operand* const operands[] = {&op.x, &op.y, &op.z};
  Value value{Kind::vector, {}, {}};
  for (int i = 0; i < 3; ++i) {
    *operands[i] = folded_range(low.parts[i], high.parts[i]);
    value.parts[i] = register_operand(static_cast<Register>(dst + i));
  }
  if (is_rule() && !finding_shape()) op.a = variant_draws_.at(draw_site_);
  op.b = name_hash(name);
  return value;
}

// One quantile decides: the first alternative whose cumulated weight exceeds u * total.
Value BodyCompiler::pick(const ast::Expr& call, const NameScope& scope, const std::string& name) {
  register_draw(draw_site_, name, 1, DrawShape::discrete, static_cast<std::uint32_t>(call.args.size()));
  const Operand zero = constant_operand(0);
  std::vector<Operand> up_to;
  std::vector<Value> values;
  Operand total = zero;
  for (const ast::Arg& arg : call.args) {
    const Operand weight = arg.label ? expressions_.scalar(*arg.label, scope) : constant_operand(1);
    total = builder_.binary(Arithmetic::add, total, weight);
    up_to.push_back(total);
    values.push_back(expressions_.compile(*arg.value, scope));
  }
  const Operand u = draw_component(OpCode::draw_uniform, zero, total, zero, nullptr, 0, name);
  Value chosen = values.back();
  for (std::size_t i = values.size() - 1; i-- > 0;)
    chosen = expressions_.select(builder_.binary(Arithmetic::less, u, up_to[i]), values[i], chosen);
  return chosen;
}

}  // namespace espalier
