#pragma once
// The syntax tree of an Espalier grammar: what the parser makes and the checker, compiler and formatter read.
// One struct per production of the EBNF in docs/language.md. Names are still text; nothing is resolved.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/kind.h"

namespace espalier::ast {

enum class Axis : std::uint8_t { x, y, z };

enum class Unit : std::uint8_t { none, degrees, radians, metres, centimetres, millimetres, percent };

enum class ExprKind : std::uint8_t {
  number,   // value, unit
  text,     // name holds the string's contents
  boolean,  // value is 0 or 1
  name,     // name; also `scope`, `depth`, `childless`
  call,     // name(args)
  vector,   // three children
  unary,    // op, one child
  binary,   // op, two children
  ternary,  // condition, then, else
  member,   // child.axis
};

enum class Operator : std::uint8_t {
  none, negate, logical_not, add, subtract, multiply, divide, modulo, power,
  less, less_equal, greater, greater_equal, equal, not_equal, logical_and, logical_or,
};

struct Expr;
using ExprPtr = std::unique_ptr<Expr>;

/// An argument of a call: `value`, or `label: value` where the label is a name (`top: 0.58`, a bare name expression)
/// or a weight (`3: white`).
struct Arg {
  ExprPtr label;  // null when there is none
  ExprPtr value;
};

struct Expr {
  ExprKind kind = ExprKind::number;
  SourceSpan span;
  double value = 0;  // as written; the unit is not applied
  Unit unit = Unit::none;
  Operator op = Operator::none;
  Axis axis = Axis::x;
  std::string name;
  std::vector<ExprPtr> children;
  std::vector<Arg> args;
  std::uint16_t height = 1;        // levels of the tree from here down; at most kDeepestNesting (parser.h)
  Kind value_kind = Kind::number;  // set by the checker
};

struct Block;
struct Stmt;
using StmtPtr = std::unique_ptr<Stmt>;

struct Block {
  SourceSpan span;
  std::vector<StmtPtr> statements;
};

/// NAME or NAME(args): a rule or detail that is spawned or called.
struct Ref {
  SourceSpan span;
  std::string name;
  std::vector<ExprPtr> args;
};

/// The list of a `for`: values, or first..last with both ends included.
struct List {
  SourceSpan span;
  bool range = false;
  std::vector<ExprPtr> values;  // range: exactly first and last
};

/// One alternative of `choose` (weight: block), one part of `split` ([~|repeat] size: block) or of `comp` (face:
/// block).
struct Case {
  SourceSpan span;
  enum class Sizing : std::uint8_t { plain, floating, repeat } sizing = Sizing::plain;
  ExprPtr value;     // weight or size; null in comp
  std::string face;  // comp only
  Block block;
};

enum class StmtKind : std::uint8_t {
  draw,     // name ~ exprs[0] (a call)
  let,      // name = exprs[0]
  block,    // blocks[0]
  if_,      // exprs[0], blocks[0], optional blocks[1] (an `else if` is a block holding one if_)
  for_,     // name in list, blocks[0]
  choose,   // cases
  spawn,    // probability (null: required), target, on_empty (`else`), on_open (`otherwise`)
  detail,   // target
  mirror,   // axis, blocks[0]
  around,   // axis, exprs[0], blocks[0]
  split,    // axis, cases
  comp,     // cases
  move, scale, size, resize,  // optional axis, exprs[0]
  turn,                       // axis and exprs[0] the angle, or exprs[0] the vector and exprs[1] the angle
  reflect,                    // axis
  aim,                        // axis, at (else toward), exprs[0], optional exprs[1] (`by`)
  forward, yaw, pitch, roll, extrude, paint, reseed,  // exprs[0]
  bone,                       // exprs[0] -> exprs[1]
  emit,                       // exprs[0], as_is, as_proxy
};

struct Stmt {
  StmtKind kind = StmtKind::block;
  SourceSpan span;        // the whole statement
  SourceSpan name_span;   // of name, where there is one
  std::string name;
  std::optional<Axis> axis;
  bool at = false;
  bool as_is = false;
  bool as_proxy = false;
  ExprPtr probability;
  std::vector<ExprPtr> exprs;
  List list;
  std::vector<Block> blocks;
  std::vector<Case> cases;
  std::optional<Ref> target;
  std::optional<Ref> on_empty;
  std::optional<Ref> on_open;
};

struct Param {
  std::string name;
  SourceSpan span;
};

enum class DeclKind : std::uint8_t { import, start, constant, function, attribute, mesh, material, rule, detail };

struct Decl {
  DeclKind kind = DeclKind::rule;
  SourceSpan span;
  SourceSpan name_span;
  std::string name;           // import: the path
  std::vector<Param> params;  // function, rule, detail
  ExprPtr value;              // constant, function, attribute (default), mesh, material
  ExprPtr low, high, step;    // attribute
  std::string label;          // attribute: "Group/Label"
  std::optional<std::uint32_t> limit;  // rule
  ExprPtr guard;                       // rule: `when`
  Block body;                          // rule, detail
};

struct Grammar {
  std::string name;
  SourceSpan name_span;
  std::uint32_t language_version = 1;
  std::vector<Decl> decls;
  /// By SourceSpan::file: paths relative to the grammar's folder; empty before imports are read.
  std::vector<std::string> files;
};

}  // namespace espalier::ast
