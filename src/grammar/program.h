#pragma once
// Program: the straight-line code of one (rule, variant) or one detail rule. Operations are coarse (a move, a turn, a
// resize at a time) and take operands of the form coefficient * register + bias, which absorb most arithmetic; so an
// interpreter costs next to nothing over compiled code.
//
// Registers are 32-bit floats; a vector takes three in a row. From the front:
//   0..2  scope size, live     3  depth of the gene     4  childless (0 or 1)     5  always 0: what constants read
//   6..   depth(R) per counted rule, then the draws and lets of the start rule, seen everywhere
//   local_base..  parameters, draws, lets and temporaries of the program that runs

#include <cstdint>
#include <vector>

namespace espalier {

using Register = std::uint16_t;

inline constexpr Register kScopeRegister = 0;
inline constexpr Register kDepthRegister = 3;
inline constexpr Register kChildlessRegister = 4;
inline constexpr Register kZeroRegister = 5;
inline constexpr Register kFirstDepthOfRegister = 6;

struct RegisterLayout {
  Register global_base = kFirstDepthOfRegister;  // first register of the start rule's draws and lets
  Register local_base = kFirstDepthOfRegister;   // first register of what is local to a program
  std::uint32_t count = kFirstDepthOfRegister;   // of all registers, the largest program included
  std::uint32_t save_depth = 0;                  // most frames saved at once
  std::uint16_t parameters = 0;                  // most parameters of any rule or detail, in floats
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

/// coefficient * registers[reg] + bias. A constant has coefficient 0 and reads the zero register.
struct Operand {
  float coefficient = 0;
  float bias = 0;
  Register reg = kZeroRegister;
};

enum class OpCode : std::uint8_t {
  end,
  // Frame and scope. axis: 0..2. Angles in radians.
  move_axis,    // along axis by x
  move,         // by (x, y, z)
  turn_axis,    // about axis by x
  turn,         // about the vector in registers a.. by x
  scale,        // frame by (x, y, z)
  reflect,      // axis
  aim,          // axis to the direction (flags kAimAt: the point) in registers a.., by x of the angle
  size_axis,    // scope[axis] = x
  size,         // scope = (x, y, z)
  resize_axis,  // scope[axis] *= x
  resize,       // scope *= (x, y, z)
  resize_run,   // scope *= registers a..a+2
  face,         // to face `axis` of the scope: its centre, z outward, size z = 0
  save,         // frame, scope, paint, bone and key to save slot a
  restore,      // from save slot a
  // Output
  emit,    // mesh x, top y; flags kEmitAsIs, kEmitProxy
  bone,    // from registers a.. to registers b..
  bone_along,  // from x to y on `axis`
  paint,   // material x
  slot,    // slot a of the variant, with slot code dst; b names it in detail keys; flags kLast: the program ends here
  detail,  // call site a
  // Draws: quantile a of the gene, or in details the one keyed by b
  draw_uniform,     // dst = x + (y - x) u
  draw_uniform1,    // dst = bias + coefficient * (quantile / 256) of x: one quantile, constant range
  draw_uniform3,    // dst.. = bias + coefficient * (quantile / 256) of x, y, z: three quantiles, constant ranges
  draw_normal,      // mean x, sd y, low z, high in dst
  draw_loguniform,  // x (y / x)^u
  draw_integer,     // x + floor((y - x + 1) u)
  // Values
  load,          // dst = x
  load3,         // dst.. = (x, y, z)
  unary,         // dst = arithmetic(x)
  binary,        // dst = arithmetic(x, y)
  ternary,       // dst = arithmetic(x, y, z)
  mix_material,  // dst = a + round(16 clamp(x)): one of 17 blends in a row
  make_material,  // dst = the material that paint site a makes
  // Control; b is the index of an op
  jump,              // to b
  jump_if_zero,      // to b if x == 0
  jump_unless_used,  // to b unless slot a is filled
  loop_test,         // to b once dst >= x, or once it made kMostTurns turns
  key,               // detail key = key_below(key, x rounded)
  reseed,            // detail key = a function of the bits of x alone
};

/// A loop of a detail or an `around` ends after this many turns, whatever its bounds say.
inline constexpr int kMostTurns = 100'000;  // of one loop
inline constexpr int kMostAround = 1024;    // copies of one `around`

inline constexpr std::uint8_t kEmitAsIs = 1, kEmitProxy = 2, kAimAt = 1, kLast = 1;

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

/// A call of a detail rule: values are copied to the callee's parameter registers.
struct CallSite {
  std::uint16_t detail = 0;   // index into GeneratorGraph::details
  std::uint32_t site = 0;     // names the call in detail keys
  std::vector<Operand> args;  // one per float
};

inline constexpr std::uint16_t kNoCall = 0xffff;

/// What a slot shows and passes on.
struct SlotCode {
  std::uint16_t on_empty = kNoCall;  // call site shown when empty or absent
  std::uint16_t on_open = kNoCall;   // call site shown when open
  std::vector<Operand> args;         // one per float of the child's parameters
};

/// A material made with the model: values are rounded to the steps of the recipe's slots.
struct PaintSite {
  std::uint16_t recipe = 0;   // index into GeneratorGraph::recipes
  std::vector<Operand> args;  // one per slot
};

struct Program {
  std::vector<Op> ops;
  std::vector<CallSite> calls;
  std::vector<PaintSite> paints;
  std::vector<SlotCode> slots;  // one per slot operation: the copies of a mirror have one each
  std::uint16_t parameters = 0;  // floats, at local_base
};

}  // namespace espalier
