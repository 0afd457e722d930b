#include "grammar/body_compiler.h"

#include <algorithm>

#include <fmt/core.h>

#include "base/check.h"
#include "base/math.h"
#include "grammar/depth_compiler.h"

namespace espalier {
namespace {

bool changes_state(const ast::Block& block) {
  return std::any_of(block.statements.begin(), block.statements.end(), [](const ast::StmtPtr& stmt) {
    using enum ast::StmtKind;
    switch (stmt->kind) {
      case move: case scale: case size: case resize: case turn: case reflect: case aim: case forward: case yaw:
      case pitch: case roll: case extrude: case paint: case reseed: case bone: return true;
      default: return false;
    }
  });
}

bool is_zero(const Operand& operand) { return operand.coefficient == 0 && operand.bias == 0; }

}  // namespace

std::uint32_t name_hash(const std::string& text) {
  std::uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

BodyCompiler::BodyCompiler(GraphTables& tables, const ast::Decl& decl, RuleShape& shape, Choices* choices)
    : tables_(tables), decl_(decl), shape_(&shape), choices_(choices), expressions_(tables, builder_) {}

BodyCompiler::BodyCompiler(GraphTables& tables, const ast::Decl& decl)
    : tables_(tables), decl_(decl), expressions_(tables, builder_) {}

Program BodyCompiler::compile(Variant* variant) {
  variant_ = variant;
  if (variant_) variant_->probability = DepthValue(1);
  NameScope scope(&tables_.globals);
  bind_parameters(scope);
  statements(decl_.body, scope, true);
  builder_.emit(OpCode::end);
  mark_last_slots(builder_.program);
  if (builder_.overflow())
    tables_.diagnostics.error(
        "E0903", decl_.name_span,
        fmt::format("'{}' is too large: at most {} operations and {} values once its loops are unrolled", decl_.name,
                    ProgramBuilder::kMostOps, ProgramBuilder::kMostLocals));
  return std::move(builder_.program);
}

void BodyCompiler::bind_parameters(NameScope& scope) {
  const auto& kinds = tables_.grammar.parameter_kinds.at(decl_.name);
  for (std::size_t i = 0; i < decl_.params.size(); ++i) {
    Value value{kinds[i], {}, {}};
    const Register first = builder_.new_local(value.width());
    for (int k = 0; k < value.width(); ++k) value.parts[k] = register_operand(static_cast<Register>(first + k));
    scope.bind(decl_.params[i].name, value);
    builder_.program.parameters = static_cast<std::uint16_t>(builder_.program.parameters + value.width());
  }
}

void BodyCompiler::block(const ast::Block& body, const NameScope& outer, bool tail) {
  NameScope scope(&outer);
  const bool saves = changes_state(body) && !tail;
  if (saves) builder_.save();
  ++nesting_;
  statements(body, scope, tail);
  --nesting_;
  if (saves) builder_.restore();
}

void BodyCompiler::statements(const ast::Block& body, NameScope& scope, bool tail) {
  bool in_suffix = false;
  std::vector<std::uint32_t> jumps;
  for (std::size_t i = 0; i < body.statements.size(); ++i) {
    const ast::Stmt& stmt = *body.statements[i];
    const bool last = i + 1 == body.statements.size();
    if (tail && !in_suffix && !last) {
      if (const ast::Stmt* sole = sole_spawn(body, i)) {
        in_suffix = true;
        jumps.push_back(builder_.jump(OpCode::jump_unless_used, {}, slot_of(*sole)));
      }
    }
    statement(stmt, scope, tail && last);
  }
  for (const std::uint32_t jump : jumps) builder_.land(jump);
}

const ast::Stmt* BodyCompiler::sole_spawn(const ast::Block& body, std::size_t from) const {
  if (!is_rule() || finding_shape()) return nullptr;
  const ast::Stmt* sole = nullptr;
  for (std::size_t i = from; i < body.statements.size(); ++i) {
    const ast::Stmt& stmt = *body.statements[i];
    const ast::Stmt* found = nullptr;
    switch (stmt.kind) {
      case ast::StmtKind::spawn:
        if (stmt.on_empty || stmt.on_open) return nullptr;
        found = &stmt;
        break;
      case ast::StmtKind::block:
      case ast::StmtKind::mirror:
        found = sole_spawn(stmt.blocks[0], 0);
        if (!found) return nullptr;
        break;
      case ast::StmtKind::move: case ast::StmtKind::scale: case ast::StmtKind::size: case ast::StmtKind::resize:
      case ast::StmtKind::turn: case ast::StmtKind::reflect: case ast::StmtKind::forward: case ast::StmtKind::yaw:
      case ast::StmtKind::pitch: case ast::StmtKind::roll: case ast::StmtKind::paint: case ast::StmtKind::let: break;
      default: return nullptr;
    }
    if (found && sole) return nullptr;
    if (found) sole = found;
  }
  return sole && sole->probability ? sole : nullptr;
}

void BodyCompiler::statement(const ast::Stmt& stmt, NameScope& scope, bool tail) {
  switch (stmt.kind) {
    case ast::StmtKind::draw: return draw(stmt, scope);
    case ast::StmtKind::let: return bind(stmt, expressions_.compile(*stmt.exprs[0], scope), scope);
    case ast::StmtKind::block: {
      const ast::Stmt* sole = tail ? nullptr : sole_spawn(stmt.blocks[0], 0);
      const std::uint32_t jump = sole ? builder_.jump(OpCode::jump_unless_used, {}, slot_of(*sole)) : 0;
      block(stmt.blocks[0], scope, tail);
      if (sole) builder_.land(jump);
      return;
    }
    case ast::StmtKind::if_: return condition(stmt, scope, tail);
    case ast::StmtKind::for_: return loop(stmt, scope);
    case ast::StmtKind::choose:
      return is_rule() ? choose(stmt, scope, tail) : choose_at_random(stmt, scope, tail);
    case ast::StmtKind::spawn: return spawn(stmt, scope);
    case ast::StmtKind::detail: {
      const std::uint16_t site = call_site(*stmt.target, scope);
      builder_.emit(OpCode::detail).a = site;
      return;
    }
    case ast::StmtKind::mirror: return mirror(stmt, scope, tail);
    case ast::StmtKind::around: return around(stmt, scope);
    case ast::StmtKind::split: return split(stmt, scope);
    case ast::StmtKind::comp: return comp(stmt, scope);
    case ast::StmtKind::bone: return bone(stmt, scope);
    case ast::StmtKind::emit: return emit(stmt, scope);
    default: return space(stmt, scope);
  }
}

void BodyCompiler::bind(const ast::Stmt& stmt, const Value& value, NameScope& scope) {
  Value kept = value;
  const bool global = is_rule() && tables_.graph.rules[shape_->id].name == tables_.grammar.start && nesting_ == 0;
  for (int i = 0; i < kept.width(); ++i) {
    Operand& part = kept.parts[i];
    if (part.coefficient == 0) continue;
    if (!global) {
      part = builder_.capture(part);
      continue;
    }
    const Register reg = tables_.global_register(&stmt, i);
    builder_.load(reg, part);
    part = register_operand(reg);
  }
  scope.bind(stmt.name, kept);
  if (global) tables_.globals.bind(stmt.name, kept);
}

std::uint32_t BodyCompiler::name_of_site(const std::string& text) {
  std::string full = text;
  for (const int turn : turns_) full += fmt::format("[{}]", turn);
  return name_hash(full);
}

std::vector<Operand> BodyCompiler::arguments(const ast::Ref& ref, const NameScope& scope) {
  std::vector<Operand> operands;
  const auto& kinds = tables_.grammar.parameter_kinds.at(ref.name);
  for (std::size_t i = 0; i < ref.args.size(); ++i) {
    Value value = expressions_.compile(*ref.args[i], scope);
    if (kinds[i] == Kind::vector) value = spread(value);
    for (int k = 0; k < value.width(); ++k) operands.push_back(value.parts[k]);
  }
  return operands;
}

std::uint16_t BodyCompiler::call_site(const ast::Ref& ref, const NameScope& scope) {
  CallSite site;
  site.detail = tables_.detail_ids.at(ref.name);
  site.args = arguments(ref, scope);
  // The same reference in another copy of a mirror is the same call: equal in everything.
  const auto [it, fresh] = ordinals_.try_emplace({&ref, turns_}, site_ordinals_[ref.name]);
  if (fresh) ++site_ordinals_[ref.name];
  site.site = name_of_site(fmt::format("{}#{}", ref.name, it->second));
  tables_.graph.uses_details = true;
  builder_.program.calls.push_back(std::move(site));
  return static_cast<std::uint16_t>(builder_.program.calls.size() - 1);
}

void BodyCompiler::emit(const ast::Stmt& stmt, const NameScope& scope) {
  const Value mesh = expressions_.compile(*stmt.exprs[0], scope);
  Operand index = mesh.parts[0], top = mesh.parts[1];
  if (mesh.kind == Kind::text || mesh.kind != Kind::mesh) {
    tables_.diagnostics.error("E0906", stmt.exprs[0]->span, "emit needs a mesh: a primitive, or the name of a mesh");
    return;
  }
  if (stmt.as_is) {
    if (index.coefficient != 0) {
      tables_.diagnostics.error("E0907", stmt.span, "'as is' needs one mesh that is known before the search");
      return;
    }
    MeshRef ref = tables_.graph.meshes[static_cast<std::size_t>(index.bias)];
    if (ref.kind == MeshKind::file) {
      ref.as_is = true;
      index = constant_operand(tables_.mesh_index(ref));
    }
  }
  Op& op = builder_.emit(OpCode::emit);
  op.x = index;
  op.y = top;
  op.flags = static_cast<std::uint8_t>((stmt.as_is ? kEmitAsIs : 0) | (stmt.as_proxy ? kEmitProxy : 0));
  tables_.graph.uses_proxies |= stmt.as_proxy;
}

// Most bones lie along an axis of their frame, often from its origin.
void BodyCompiler::bone(const ast::Stmt& stmt, const NameScope& scope) {
  const Value a = expressions_.compile_vector(*stmt.exprs[0], scope);
  const Value b = expressions_.compile_vector(*stmt.exprs[1], scope);
  const auto none = [&](int axis) { return is_zero(a.parts[axis]) && is_zero(b.parts[axis]); };
  for (int axis = 0; axis < 3; ++axis) {
    if (!none((axis + 1) % 3) || !none((axis + 2) % 3)) continue;
    Op& op = builder_.emit(OpCode::bone_along);
    op.axis = static_cast<std::uint8_t>(axis);
    op.x = a.parts[axis], op.y = b.parts[axis];
    return;
  }
  const Register from = builder_.store3(a.parts), to = builder_.store3(b.parts);
  Op& op = builder_.emit(OpCode::bone);
  op.a = from;
  op.b = to;
}

}  // namespace espalier
