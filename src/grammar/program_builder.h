#pragma once
// ProgramBuilder: writes the operations of one program and hands out its registers. Arithmetic on constants is done
// here and now; sums and multiples of one register become operands and cost nothing at run time.

#include <cstdint>

#include "grammar/program.h"
#include "grammar/value.h"

namespace espalier {

class ProgramBuilder {
 public:
  /// Local registers carry this tag until the size of the global area is known; see `relocate`.
  static constexpr Register kLocalTag = 0x8000;
  static constexpr std::uint32_t kMostLocals = 0x7000;
  static constexpr std::size_t kMostOps = 200'000;

  Register new_local(int count);
  Operand unary(Arithmetic op, const Operand& a);
  Operand binary(Arithmetic op, const Operand& a, const Operand& b);
  Operand ternary(Arithmetic op, const Operand& a, const Operand& b, const Operand& c);
  /// The operand's value as it is now, in a register of its own unless it is constant or cannot change.
  Operand capture(const Operand& operand);
  /// Stores the operands in consecutive registers and returns the first.
  Register store3(const std::array<Operand, 3>& parts);
  void load(Register dst, const Operand& operand);

  Op& emit(OpCode code);
  std::uint32_t here() const { return static_cast<std::uint32_t>(program.ops.size()); }
  /// Emits a jump whose target is set later by land().
  std::uint32_t jump(OpCode code, const Operand& condition = {}, std::uint16_t slot = 0);
  void land(std::uint32_t jump_at) { program.ops[jump_at].b = here(); }

  /// Everything up to the matching restore() is undone there.
  void save();
  void restore();

  bool overflow() const { return overflow_; }
  std::uint32_t locals() const { return locals_; }
  std::uint32_t most_saves() const { return most_saves_; }

  Program program;

 private:
  std::uint32_t locals_ = 0;
  std::uint32_t save_depth_ = 0;
  std::uint32_t most_saves_ = 0;
  bool overflow_ = false;
};

/// Marks the slots that a program ends with: their children may take over where the gene leaves off.
void mark_last_slots(Program& program);

/// Replaces tagged local registers by `local_base + index`.
void relocate(Program& program, Register local_base);

}  // namespace espalier
