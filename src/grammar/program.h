#pragma once
// Program: the straight-line code of one (rule, variant) or one detail rule. Operations are coarse (a move, a turn, a
// resize at a time) and take operands of the form coefficient * register + bias, which absorb most arithmetic; so an
// interpreter costs next to nothing over compiled code.
//
// Registers are 32-bit floats; a vector takes three in a row. From the front:
//   0..2  scope size, live          3  depth of the gene        4  childless (0 or 1)
//   5..   depth(R) per counted rule, then the draws and lets of the start rule, seen everywhere
//   local_base..  parameters, draws, lets and temporaries of the program that runs
// Register `kZeroCoefficient` operands (coefficient 0) read nothing and are the constant `bias`.

#include <cstdint>
#include <vector>

namespace espalier {

using Register = std::uint16_t;

inline constexpr Register kScopeRegister = 0;
inline constexpr Register kDepthRegister = 3;
inline constexpr Register kChildlessRegister = 4;
inline constexpr Register kFirstDepthOfRegister = 5;

struct RegisterLayout {
  Register global_base = kFirstDepthOfRegister;  // first register of the start rule's draws and lets
  Register local_base = kFirstDepthOfRegister;   // first register of what is local to a program
  std::uint32_t count = kFirstDepthOfRegister;   // of all registers, the largest program included
  std::uint32_t save_depth = 0;                  // most frames saved at once
};

enum class Arithmetic : std::uint8_t {
  // unary
  negate, logical_not, absolute, floor, ceil, round, sqrt, exp, log, sin, cos, tan, asin, acos, atan,
  // binary
  add, subtract, multiply, divide, modulo, power, minimum, maximum, atan2,
  less, less_equal, greater, greater_equal, equal, not_equal, logical_and, logical_or,
  // ternary
  select, clamp, mix, smooth,
};

/// coefficient * registers[reg] + bias; the constant bias when coefficient is 0.
struct Operand {
  float coefficient = 0;
  float bias = 0;
  Register reg = 0;
};

enum class OpCode : std::uint8_t {
  end,
  // Frame and scope. axis: 0..2. Angles in radians.
  move_axis,    // along axis by x
  move,         // by (x, y, z)
  turn_axis,    // about axis by x
  turn,         // about the vector (y register run) by x
  scale,        // frame by (x, y, z)
  reflect,      // axis
  aim,          // axis; direction or point in registers a..a+2; flag = at; x = fraction of the angle
  size_axis,    // scope[axis] = x
  size,         // scope = (x, y, z)
  resize_axis,  // scope[axis] *= x
  resize,       // scope *= (x, y, z)
  save,         // frame, scope, paint, bone, key to save slot a
  restore,      // from save slot a
  // Output
  emit,    // mesh x, shape number y; flags kEmitAsIs, kEmitProxy
  bone,    // from registers a..a+2 to registers b..b+2
  paint,   // material x
  slot,    // slot a (index in the variant's slot list); arguments: list of operands; open_detail/empty_detail call ids
  detail,  // call site a
  // Values
  draw_uniform,      // dst = x + (y - x) * u[a]
  draw_normal,       // mean x, sd y, lo z, hi in register b
  draw_loguniform,   // x * (y / x)^u
  draw_integer,      // x + floor((y - x + 1) u)
  draw_chance,       // u < x
  draw_pick,         // registers b..: weights table a2; picks constant or register values
  load,              // dst = x
  load3,             // dst..dst+2 = (x, y, z)
  unary,             // dst = arithmetic(x)
  binary,            // dst = arithmetic(x, y)
  ternary,           // dst = arithmetic(x, y, z)
  mix_material,      // dst = blend table a at step round(16 x)
  // Control; targets are op indices
  jump,          // to b
  jump_if_zero,  // to b if x == 0
  jump_unless_used,  // to b if slot a is neither filled nor shows anything
  loop_begin,    // counter dst from 0 to below round(x) clamped to 1..1024, jump to b when done
  loop_end,      // to b
  key,           // detail key = key_below(key, x)
  reseed,        // detail key = hash of the bits of x
};

struct Op {
  OpCode code = OpCode::end;
  std::uint8_t axis = 0;
  Arithmetic arithmetic = Arithmetic::negate;
  std::uint8_t flags = 0;
  Register dst = 0;
  std::uint16_t a = 0;
  std::uint32_t b = 0;
  Operand x, y, z;
};

/// A call of a detail rule or the arguments of a spawn: values are copied to the callee's parameter registers.
struct CallSite {
  std::uint16_t detail = 0;      // index into GeneratorGraph::details
  std::uint32_t site = 0;        // names the call site in detail keys; unique in the grammar
  std::vector<Operand> args;     // one per float
};

inline constexpr std::uint16_t kNoCall = 0xffff;

/// What a slot shows and passes on.
struct SlotCode {
  std::uint16_t on_empty = kNoCall;  // call site shown when empty or absent
  std::uint16_t on_open = kNoCall;   // call site shown when open
  std::vector<Operand> args;         // one per float of the child's parameters
};

struct Program {
  std::vector<Op> ops;
  std::vector<CallSite> calls;
  std::vector<SlotCode> slots;  // one per slot of the variant
  std::vector<float> table;     // constants of picks
  std::uint16_t parameters = 0;  // floats, at local_base
  std::uint16_t draws = 0;       // details: how many keyed quantiles it takes
};

}  // namespace espalier
