#pragma once
// CheckedGrammar: a syntax tree in which every name is known, every kind fits and every rule of the language holds,
// with what the checker found out on the way. What the compiler reads.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/ast.h"
#include "grammar/kind.h"
#include "grammar/static_value.h"

namespace espalier {

/// An `attr` as evaluated: angles in radians.
struct CheckedAttribute {
  StaticValue value;          // in effect: the override if there is one, else the default
  StaticValue default_value;  // number, angle or boolean
  bool ranged = false;        // `in low..high`
  double low = 0, high = 0;
  double step = 0;    // `by`; 0: none
  std::string label;  // "Group/Label" or empty
};

/// Every Expr of the tree has its `value_kind` set (of functions, rules and details that nobody calls: unspecified).
struct CheckedGrammar {
  ast::Grammar ast;

  /// The start rule, without parameters and never spawned.
  std::string start;
  /// Declarations by name: index into ast.decls. (`start` and `import` are not in it.)
  std::map<std::string, std::size_t, std::less<>> declarations;
  /// Consts by name.
  std::map<std::string, StaticValue, std::less<>> constants;
  std::map<std::string, CheckedAttribute, std::less<>> attributes;
  /// Rules, details and functions by name: the kind of each parameter. All call sites agree; number where nobody calls.
  std::map<std::string, std::vector<Kind>, std::less<>> parameter_kinds;
  /// Functions by name: the kind of the result.
  std::map<std::string, Kind, std::less<>> function_kinds;
  /// Draws and lets at the top level of the start rule, seen everywhere: kinds by name.
  std::map<std::string, Kind, std::less<>> global_kinds;
  /// Rules and details that the start rule leads to. Others need not be compiled.
  std::map<std::string, bool, std::less<>> reachable;

  /// The declaration of that name, or null.
  const ast::Decl* find(std::string_view name) const {
    const auto found = declarations.find(name);
    return found == declarations.end() ? nullptr : &ast.decls[found->second];
  }
  const ast::Decl* find(std::string_view name, ast::DeclKind kind) const {
    const ast::Decl* decl = find(name);
    return decl && decl->kind == kind ? decl : nullptr;
  }
};

}  // namespace espalier
