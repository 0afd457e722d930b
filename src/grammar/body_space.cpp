// BodyCompiler: statements that move, turn and size.

#include "base/check.h"
#include "grammar/body_compiler.h"

namespace espalier {
namespace {

constexpr int kX = 0, kY = 1, kZ = 2;

bool constant(const Value& vector, int axis, float value) {
  return vector.parts[axis].coefficient == 0 && vector.parts[axis].bias == value;
}

/// The plain contents of three registers in a row, as a draw of a vector leaves them.
bool is_run(const Value& vector) {
  for (int i = 0; i < 3; ++i) {
    const Operand& part = vector.parts[i];
    if (part.coefficient != 1 || part.bias != 0 || part.reg != vector.parts[0].reg + i) return false;
  }
  return true;
}

}  // namespace

void BodyCompiler::move_along(int axis, const Operand& distance) {
  Op& op = builder_.emit(OpCode::move_axis);
  op.axis = static_cast<std::uint8_t>(axis);
  op.x = distance;
}

void BodyCompiler::turn_about(int axis, const Operand& angle) {
  Op& op = builder_.emit(OpCode::turn_axis);
  op.axis = static_cast<std::uint8_t>(axis);
  op.x = angle;
}

// size and resize: of one axis, or of all (a number spreads).
void BodyCompiler::resize(const ast::Stmt& stmt, const NameScope& scope, OpCode along_axis, OpCode all) {
  if (stmt.axis) {
    const Operand size = expressions_.scalar(*stmt.exprs[0], scope);
    Op& op = builder_.emit(along_axis);
    op.axis = static_cast<std::uint8_t>(*stmt.axis);
    op.x = size;
    return;
  }
  const Value size = expressions_.compile_vector(*stmt.exprs[0], scope);
  if (all == OpCode::resize && is_run(size)) {
    builder_.emit(OpCode::resize_run).a = size.parts[0].reg;
    return;
  }
  Op& op = builder_.emit(all);
  op.x = size.parts[0], op.y = size.parts[1], op.z = size.parts[2];
}

void BodyCompiler::aim(const ast::Stmt& stmt, const NameScope& scope) {
  const Register towards = builder_.store3(expressions_.compile_vector(*stmt.exprs[0], scope).parts);
  const Operand share = stmt.exprs.size() > 1 ? expressions_.scalar(*stmt.exprs[1], scope) : constant_operand(1);
  Op& op = builder_.emit(OpCode::aim);
  op.axis = static_cast<std::uint8_t>(*stmt.axis);
  op.flags = stmt.at ? kAimAt : 0;
  op.a = towards;
  op.x = share;
}

// size z = |d|, then half of d along z: the face becomes a slab that stands on it.
void BodyCompiler::extrude(const Operand& depth) {
  const Operand size = builder_.unary(Arithmetic::absolute, depth);
  const Operand half = builder_.binary(Arithmetic::multiply, depth, constant_operand(0.5f));
  const Operand move = builder_.capture(half);  // the depth may read the scope, which changes now
  Op& op = builder_.emit(OpCode::size_axis);
  op.axis = kZ;
  op.x = size;
  move_along(kZ, move);
}

void BodyCompiler::space(const ast::Stmt& stmt, const NameScope& scope) {
  switch (stmt.kind) {
    case ast::StmtKind::move: {
      if (stmt.axis) return move_along(static_cast<int>(*stmt.axis), expressions_.scalar(*stmt.exprs[0], scope));
      const Value by = expressions_.compile_vector(*stmt.exprs[0], scope);
      int moving = 0, axis = 0;
      for (int i = 0; i < 3; ++i)
        if (!constant(by, i, 0)) ++moving, axis = i;
      if (moving == 0) return;
      if (moving == 1) return move_along(axis, by.parts[axis]);
      Op& op = builder_.emit(OpCode::move);
      op.x = by.parts[0], op.y = by.parts[1], op.z = by.parts[2];
      return;
    }
    case ast::StmtKind::scale: {
      Value by = stmt.axis ? Value{Kind::vector, {constant_operand(1), constant_operand(1), constant_operand(1)}, {}}
                           : expressions_.compile_vector(*stmt.exprs[0], scope);
      if (stmt.axis) by.parts[static_cast<int>(*stmt.axis)] = expressions_.scalar(*stmt.exprs[0], scope);
      Op& op = builder_.emit(OpCode::scale);
      op.x = by.parts[0], op.y = by.parts[1], op.z = by.parts[2];
      return;
    }
    case ast::StmtKind::size: return resize(stmt, scope, OpCode::size_axis, OpCode::size);
    case ast::StmtKind::resize: return resize(stmt, scope, OpCode::resize_axis, OpCode::resize);
    case ast::StmtKind::turn: {
      if (stmt.axis) return turn_about(static_cast<int>(*stmt.axis), expressions_.scalar(*stmt.exprs[0], scope));
      const Register about = builder_.store3(expressions_.compile_vector(*stmt.exprs[0], scope).parts);
      const Operand angle = expressions_.scalar(*stmt.exprs[1], scope);
      Op& op = builder_.emit(OpCode::turn);
      op.a = about;
      op.x = angle;
      return;
    }
    case ast::StmtKind::reflect:
      builder_.emit(OpCode::reflect).axis = static_cast<std::uint8_t>(*stmt.axis);
      return;
    case ast::StmtKind::aim: return aim(stmt, scope);
    case ast::StmtKind::forward: return move_along(kY, expressions_.scalar(*stmt.exprs[0], scope));
    case ast::StmtKind::yaw: return turn_about(kZ, expressions_.scalar(*stmt.exprs[0], scope));
    case ast::StmtKind::pitch: return turn_about(kX, expressions_.scalar(*stmt.exprs[0], scope));
    case ast::StmtKind::roll: return turn_about(kY, expressions_.scalar(*stmt.exprs[0], scope));
    case ast::StmtKind::extrude: return extrude(expressions_.scalar(*stmt.exprs[0], scope));
    case ast::StmtKind::paint: {
      const Operand material = expressions_.scalar(*stmt.exprs[0], scope);
      builder_.emit(OpCode::paint).x = material;
      return;
    }
    case ast::StmtKind::reseed: {
      const Operand seed = expressions_.scalar(*stmt.exprs[0], scope);
      builder_.emit(OpCode::reseed).x = seed;
      return;
    }
    default: CHECK(false);
  }
}

}  // namespace espalier
