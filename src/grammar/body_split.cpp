// BodyCompiler: `split` and `comp`, which cut the scope box into parts and visit its faces (Mueller et al., Procedural
// Modeling of Buildings, 2006, section 2).

#include "base/check.h"
#include "grammar/body_compiler.h"
#include "grammar/face.h"

namespace espalier {
namespace {

using Sizing = ast::Case::Sizing;

/// A repeat counts one tile more where so little of its size is missing: sizes are rounded sums.
constexpr float kTileSlack = 1e-4f;

bool is_percent(const ast::Expr& size) {
  return size.kind == ast::ExprKind::number && size.unit == ast::Unit::percent;
}

}  // namespace

/// The lengths of the parts of one split, worked out before the first is run.
struct BodyCompiler::SplitLengths {
  std::vector<Operand> of;  // by part; of a repeat: of one tile
  Operand tiles = constant_operand(0);
};

// The size of a part as written, at least 0: a length, or for a floating part its share.
Operand BodyCompiler::split_size(const ast::Case& part, const Operand& whole, const NameScope& scope) {
  if (is_percent(*part.value))
    return builder_.binary(Arithmetic::multiply, whole, constant_operand(static_cast<float>(part.value->value / 100)));
  const Operand size = builder_.capture(expressions_.scalar(*part.value, scope));
  return builder_.binary(Arithmetic::maximum, size, constant_operand(0));
}

BodyCompiler::SplitLengths BodyCompiler::split_lengths(const ast::Stmt& stmt, const Operand& whole,
                                                       const NameScope& scope) {
  const auto combine = [&](Arithmetic op, const Operand& a, const Operand& b) { return builder_.binary(op, a, b); };
  const Operand zero = constant_operand(0), tiny = constant_operand(1e-30f);
  SplitLengths lengths;
  Operand fixed = zero, shares = zero, tile = zero;
  bool floats = false, repeats = false;
  for (const ast::Case& part : stmt.cases) {
    const Operand size = split_size(part, whole, scope);
    lengths.of.push_back(size);
    if (part.sizing == Sizing::plain) fixed = combine(Arithmetic::add, fixed, size);
    if (part.sizing == Sizing::floating) floats = true, shares = combine(Arithmetic::add, shares, size);
    if (part.sizing == Sizing::repeat) repeats = true, tile = combine(Arithmetic::maximum, size, tiny);
  }
  // Fixed sizes too large shrink together; what they leave is room for the others.
  const Operand shrink = combine(Arithmetic::minimum, constant_operand(1),
                                 combine(Arithmetic::divide, whole, combine(Arithmetic::maximum, fixed, tiny)));
  Operand room = combine(Arithmetic::maximum, combine(Arithmetic::subtract, whole, fixed), zero);
  if (repeats) {
    const Operand fits = combine(Arithmetic::divide, room, tile);
    if (floats) {
      lengths.tiles = builder_.unary(Arithmetic::floor, combine(Arithmetic::add, fits, constant_operand(kTileSlack)));
      const Operand tiled = combine(Arithmetic::multiply, lengths.tiles, tile);
      room = combine(Arithmetic::maximum, combine(Arithmetic::subtract, room, tiled), zero);
    } else {
      const Operand at_least_one = combine(Arithmetic::maximum, builder_.unary(Arithmetic::round, fits),
                                           combine(Arithmetic::greater, room, zero));
      lengths.tiles = builder_.capture(at_least_one);
      tile = combine(Arithmetic::divide, room, combine(Arithmetic::maximum, lengths.tiles, constant_operand(1)));
    }
  }
  const Operand per_share = combine(Arithmetic::divide, room, combine(Arithmetic::maximum, shares, tiny));
  for (std::size_t i = 0; i < stmt.cases.size(); ++i) {
    Operand& length = lengths.of[i];
    switch (stmt.cases[i].sizing) {
      case Sizing::plain: length = combine(Arithmetic::multiply, length, shrink); break;
      case Sizing::floating: length = combine(Arithmetic::multiply, length, per_share); break;
      case Sizing::repeat: length = tile; break;
    }
  }
  return lengths;
}

// One part: its block, in a scope of that length whose centre stands at `centre` along the axis.
void BodyCompiler::split_part(const ast::Case& part, int axis, const Operand& centre, const Operand& length,
                              const NameScope& scope) {
  move_along(axis, centre);
  Op& op = builder_.emit(OpCode::size_axis);
  op.axis = static_cast<std::uint8_t>(axis);
  op.x = length;
  block(part.block, scope, true);
}

void BodyCompiler::split(const ast::Stmt& stmt, const NameScope& scope) {
  const int axis = static_cast<int>(*stmt.axis);
  const Operand whole = builder_.capture(register_operand(static_cast<Register>(kScopeRegister + axis)));
  const SplitLengths lengths = split_lengths(stmt, whole, scope);
  const Operand half = constant_operand(0.5f);
  Operand begin = builder_.binary(Arithmetic::multiply, whole, constant_operand(-0.5f));
  for (std::size_t i = 0; i < stmt.cases.size(); ++i) {
    const ast::Case& part = stmt.cases[i];
    const Operand length = lengths.of[i];
    const auto centre = [&](const Operand& from) {
      return builder_.binary(Arithmetic::add, from, builder_.binary(Arithmetic::multiply, length, half));
    };
    if (part.sizing == Sizing::repeat) {
      // Tiles share genes, but each has details of its own.
      counted(lengths.tiles, [&](const Operand& tile) {
        builder_.emit(OpCode::key).x = tile;
        const Operand before = builder_.binary(Arithmetic::multiply, tile, length);
        split_part(part, axis, centre(builder_.binary(Arithmetic::add, begin, before)), length, scope);
      });
    } else {
      // Not run where it has no length; a length that is no number is run, and so reported.
      const Operand empty = builder_.binary(Arithmetic::less_equal, length, constant_operand(0));
      const std::uint32_t over =
          builder_.jump(OpCode::jump_if_zero, builder_.unary(Arithmetic::logical_not, empty));
      builder_.save();
      split_part(part, axis, centre(begin), length, scope);
      builder_.restore();
      builder_.land(over);
    }
    const bool repeat = part.sizing == Sizing::repeat;
    const Operand taken = repeat ? builder_.binary(Arithmetic::multiply, lengths.tiles, length) : length;
    begin = builder_.binary(Arithmetic::add, begin, taken);
  }
}

void BodyCompiler::comp(const ast::Stmt& stmt, const NameScope& scope) {
  std::uint8_t left = 0b111111;
  for (int face = 0; face < kFaces; ++face) {
    for (const ast::Case& line : stmt.cases) {
      const auto named = faces_named(line.face);
      CHECK(named);
      if (!(*named & left & (1u << face))) continue;
      left = static_cast<std::uint8_t>(left & ~(1u << face));
      builder_.save();
      builder_.emit(OpCode::key).x = constant_operand(static_cast<float>(face));
      builder_.emit(OpCode::face).axis = static_cast<std::uint8_t>(face);
      block(line.block, scope, true);
      builder_.restore();
    }
  }
}

}  // namespace espalier
