// BodyCompiler: conditions, loops, copies, choices, and the slots that genes stand in.

#include <algorithm>

#include <fmt/core.h>

#include "base/math.h"
#include "grammar/body_compiler.h"
#include "grammar/depth_compiler.h"

namespace espalier {
void BodyCompiler::condition(const ast::Stmt& stmt, const NameScope& scope, bool tail) {
  const Operand test = expressions_.scalar(*stmt.exprs[0], scope);
  if (test.coefficient == 0) {
    if (test.bias != 0) block(stmt.blocks[0], scope, tail);
    else if (stmt.blocks.size() > 1) block(stmt.blocks[1], scope, tail);
    return;
  }
  const std::uint32_t over = builder_.jump(OpCode::jump_if_zero, test);
  block(stmt.blocks[0], scope, tail);
  if (stmt.blocks.size() == 1) return builder_.land(over);
  const std::uint32_t out = builder_.jump(OpCode::jump);
  builder_.land(over);
  block(stmt.blocks[1], scope, tail);
  builder_.land(out);
}

void BodyCompiler::loop(const ast::Stmt& stmt, const NameScope& scope) {
  std::vector<Value> values;
  for (const auto& expr : stmt.list.values) values.push_back(expressions_.compile(*expr, scope));
  if (!stmt.list.range) return unrolled(stmt, values, scope);
  const Operand first = values[0].parts[0], last = values[1].parts[0];
  if (first.coefficient == 0 && last.coefficient == 0) {
    const int count = static_cast<int>(std::clamp(std::floor(last.bias - first.bias) + 1, 0.0f, 1e5f));
    if (is_rule() || count <= 8) {
      values.clear();
      for (int i = 0; i < count; ++i) values.push_back(number_value(first.bias + static_cast<float>(i)));
      return unrolled(stmt, values, scope);
    }
  }
  turning(stmt, first, builder_.binary(Arithmetic::add, builder_.binary(Arithmetic::subtract, last, first),
                                       constant_operand(1)), scope);
}

void BodyCompiler::unrolled(const ast::Stmt& stmt, const std::vector<Value>& values, const NameScope& scope) {
  for (std::size_t i = 0; i < values.size() && !builder_.overflow(); ++i) {
    NameScope inner(&scope);
    inner.bind(stmt.name, values[i]);
    turns_.push_back(static_cast<int>(i));
    if (is_rule()) {
      const ast::Stmt* sole = sole_spawn(stmt.blocks[0], 0);
      const std::uint32_t jump = sole ? builder_.jump(OpCode::jump_unless_used, {}, slot_of(*sole)) : 0;
      block(stmt.blocks[0], inner, false);
      if (sole) builder_.land(jump);
    } else {
      // Draws of details are told apart by the key, so each turn has its own.
      builder_.save();
      builder_.emit(OpCode::key).x = constant_operand(static_cast<float>(i));
      block(stmt.blocks[0], inner, true);
      builder_.restore();
    }
    turns_.pop_back();
  }
}

// A loop at run time: `turn` is compiled once, with the counter that runs from 0 to below `count`.
void BodyCompiler::counted(const Operand& count, const std::function<void(const Operand& counter)>& turn) {
  const Operand end = builder_.capture(count);
  const Register counter = builder_.new_local(1);
  builder_.load(counter, constant_operand(0));
  const std::uint32_t test = builder_.jump(OpCode::loop_test, end);
  builder_.program.ops[test].dst = counter;
  builder_.save();
  turn(register_operand(counter));
  builder_.restore();
  builder_.load(counter, {1, 1, counter});
  builder_.emit(OpCode::jump).b = test;
  builder_.land(test);
}

void BodyCompiler::turning(const ast::Stmt& stmt, const Operand& first_in, const Operand& count,
                           const NameScope& scope) {
  const Operand first = builder_.capture(first_in);
  counted(count, [&](const Operand& counter) {
    builder_.emit(OpCode::key).x = counter;
    const Register variable = builder_.new_local(1);
    Op& op = builder_.emit(OpCode::binary);
    op.arithmetic = Arithmetic::add;
    op.dst = variable;
    op.x = first;
    op.y = counter;
    NameScope inner(&scope);
    inner.bind(stmt.name, {Kind::number, {register_operand(variable)}, {}});
    block(stmt.blocks[0], inner, true);
  });
}

// B, turned by i * 360deg / n, i < n: copies that are equal in everything, so the key stays.
void BodyCompiler::around(const ast::Stmt& stmt, const NameScope& scope) {
  const Operand wanted = builder_.unary(Arithmetic::round, expressions_.scalar(*stmt.exprs[0], scope));
  const Operand count =
      builder_.capture(builder_.ternary(Arithmetic::clamp, wanted, constant_operand(1), constant_operand(kMostAround)));
  counted(count, [&](const Operand& counter) {
    const Operand share = builder_.binary(Arithmetic::divide, counter, count);
    turn_about(static_cast<int>(*stmt.axis),
               builder_.binary(Arithmetic::multiply, share, constant_operand(static_cast<float>(2 * kPi))));
    block(stmt.blocks[0], scope, true);
  });
}

void BodyCompiler::mirror(const ast::Stmt& stmt, const NameScope& scope, bool tail) {
  const ast::Stmt* sole = sole_spawn(stmt.blocks[0], 0);
  const std::uint32_t jump = sole ? builder_.jump(OpCode::jump_unless_used, {}, slot_of(*sole)) : 0;
  block(stmt.blocks[0], scope, false);
  if (!tail) builder_.save();
  builder_.emit(OpCode::reflect).axis = static_cast<std::uint8_t>(*stmt.axis);
  block(stmt.blocks[0], scope, true);
  if (!tail) builder_.restore();
  if (sole) builder_.land(jump);
}

void BodyCompiler::choose(const ast::Stmt& stmt, const NameScope& scope, bool tail) {
  if (finding_shape()) {
    for (const ast::Case& alternative : stmt.cases) block(alternative.block, scope, false);
    return;
  }
  const Site site{&stmt, turns_};
  auto decided = decided_.find(site);
  if (decided == decided_.end()) {
    const std::size_t nth = choices_->offered.size();
    choices_->offered.push_back(stmt.cases.size());
    if (nth >= choices_->taken.size()) choices_->taken.push_back(0);
    decided = decided_.emplace(site, choices_->taken[nth]).first;
    std::vector<const ast::Expr*> weights;
    for (const ast::Case& alternative : stmt.cases) weights.push_back(alternative.value.get());
    variant_->probability = product(variant_->probability, share_of(weights, decided->second, scope, tables_));
    variant_->name += fmt::format("{}{}", variant_->name.empty() ? "" : ",", decided->second + 1);
  }
  block(stmt.cases[decided->second].block, scope, tail);
}

// In a detail: drawn by weight when the geometry is made.
void BodyCompiler::choose_at_random(const ast::Stmt& stmt, const NameScope& scope, bool tail) {
  const Operand zero = constant_operand(0);
  std::vector<Operand> up_to;
  Operand total = zero;
  for (const ast::Case& alternative : stmt.cases) {
    total = builder_.binary(Arithmetic::add, total, expressions_.scalar(*alternative.value, scope));
    up_to.push_back(total);
  }
  const auto [it, fresh] = ordinals_.try_emplace({&stmt, turns_}, site_ordinals_["choose"]);
  if (fresh) ++site_ordinals_["choose"];
  draw_site_ = {&stmt, turns_};
  const Operand u = draw_component(OpCode::draw_uniform, zero, total, zero, nullptr, 0,
                                   fmt::format("{}.choose#{}", decl_.name, it->second));
  std::vector<std::uint32_t> outs;
  for (std::size_t i = 0; i < stmt.cases.size(); ++i) {
    const bool last = i + 1 == stmt.cases.size();
    const std::uint32_t over =
        last ? 0 : builder_.jump(OpCode::jump_if_zero, builder_.binary(Arithmetic::less, u, up_to[i]));
    block(stmt.cases[i].block, scope, tail);
    if (last) break;
    outs.push_back(builder_.jump(OpCode::jump));
    builder_.land(over);
  }
  for (const std::uint32_t out : outs) builder_.land(out);
}

EdgeId BodyCompiler::edge_of(const ast::Stmt& stmt, const NameScope& scope) {
  // One edge per spawn of the text, whatever loops stand around it: probabilities read no loop variable.
  const auto [it, fresh] = shape_->edges.try_emplace(&stmt, static_cast<EdgeId>(tables_.graph.edges.size()));
  if (!fresh) return it->second;
  Edge edge;
  edge.parent = shape_->id;
  edge.child = tables_.rule_ids.at(stmt.target->name);
  edge.required = !stmt.probability;
  if (stmt.probability) edge.probability = compile_depth_value(*stmt.probability, scope, tables_);
  edge.name = fmt::format("{}/{}", decl_.name, stmt.target->name);
  edge.span = stmt.span;
  if (const std::size_t nth = ++tables_.edges_of_name[edge.name]; nth > 1) edge.name += fmt::format("#{}", nth);
  tables_.graph.edges.push_back(std::move(edge));
  return it->second;
}

std::uint16_t BodyCompiler::slot_of(const ast::Stmt& stmt) {
  const Site site{&stmt, turns_};
  const auto [it, fresh] = variant_slots_.try_emplace(site, static_cast<std::uint16_t>(variant_->slots.size()));
  if (fresh) variant_->slots.push_back(shape_->slots.at(site));
  return it->second;
}

void BodyCompiler::spawn(const ast::Stmt& stmt, const NameScope& scope) {
  const EdgeId edge = edge_of(stmt, scope);
  Rule& rule = tables_.graph.rules[shape_->id];
  if (finding_shape()) {
    const auto [it, fresh] = shape_->slots.try_emplace({&stmt, turns_}, static_cast<std::uint16_t>(rule.slots.size()));
    static_cast<void>(it);
    if (fresh) rule.slots.push_back({stmt.target->name, edge});
    return;
  }
  const std::uint16_t slot = slot_of(stmt);
  SlotCode code;
  code.args = arguments(*stmt.target, scope);
  if (stmt.on_empty) code.on_empty = call_site(*stmt.on_empty, scope);
  if (stmt.on_open) code.on_open = call_site(*stmt.on_open, scope);
  else code.on_open = code.on_empty;  // `otherwise` is `else` unless it says otherwise
  builder_.program.slots.push_back(std::move(code));
  Op& op = builder_.emit(OpCode::slot);
  op.a = slot;
  op.dst = static_cast<Register>(builder_.program.slots.size() - 1);
  op.b = name_hash(rule.slots[shape_->slots.at({&stmt, turns_})].name);
}

}  // namespace espalier
