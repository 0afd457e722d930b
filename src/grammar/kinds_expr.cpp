// Kinds of expressions.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/kind_rules.h"
#include "grammar/kinds.h"
#include "grammar/surface_arguments.h"
#include "grammar/words.h"

namespace espalier {
namespace {

using ast::Expr;
using ast::ExprKind;

std::string help_for(const Expr& expr, std::optional<Kind> wanted, std::optional<Kind> got) {
  if (!wanted || !got) return {};
  const bool literal = expr.kind == ExprKind::number && expr.unit == ast::Unit::none;
  if (*wanted == Kind::angle && *got == Kind::number)
    return literal ? fmt::format("write `{:g}deg`", expr.value) : "an angle is a number times `1deg` or `1rad`";
  if (*wanted == Kind::number && *got == Kind::angle) return "divide it by `1deg` or `1rad` to get a number";
  if (*wanted == Kind::number && *got == Kind::vector) return "take a component, `.x .y .z`, or its `length(...)`";
  if (*wanted == Kind::vector && *got == Kind::number) return "write `(a, b, c)`, or `vec(a)` for three times the same";
  if (*wanted == Kind::boolean && *got == Kind::number) return "compare it with something, such as `> 0`";
  if (*wanted == Kind::number && *got == Kind::boolean) return "write `... ? 1 : 0`";
  if (*wanted == Kind::mesh && *got == Kind::text) return "declare it: `mesh NAME = \"file.glb\"`";
  if (*wanted == Kind::material && *got == Kind::text) return "write `surface(\"#rrggbb\")`";
  if (*wanted == Kind::material && *got == Kind::texture) return "write `surface(\"#ffffff\", texture: ...)`";
  if (*wanted == Kind::texture && *got == Kind::text) return "write `image_texture(\"file.png\")`";
  return {};
}

}  // namespace

void KindChecker::mismatch(const Expr& expr, std::string message, MaybeKind wanted, MaybeKind got) {
  context_.diagnostics.error("E0302", expr.span, std::move(message), help_for(expr, wanted, got));
}

void KindChecker::expect(Expr& expr, std::initializer_list<Kind> wanted, std::string_view what) {
  const MaybeKind kind = of(expr);
  if (!kind || std::find(wanted.begin(), wanted.end(), *kind) != wanted.end()) return;
  std::string list;
  for (const Kind k : wanted) list += fmt::format("{}{}", list.empty() ? "" : " or ", phrase_of(k));
  mismatch(expr, fmt::format("{} takes {}, not {}", what, list, phrase_of(*kind)), *wanted.begin(), kind);
}

KindChecker::MaybeKind KindChecker::common_kind(const std::vector<Expr*>& exprs, std::initializer_list<Kind> allowed,
                                                std::string_view what) {
  MaybeKind common;
  for (Expr* expr : exprs) {
    const MaybeKind kind = of(*expr);
    if (!kind) continue;
    if (allowed.size() > 0 && std::find(allowed.begin(), allowed.end(), *kind) == allowed.end()) {
      std::string list;
      for (const Kind k : allowed)
        list += fmt::format("{}{}{}", list.empty() ? "" : " or ", name_of(k), k == Kind::mesh ? "es" : "s");
      mismatch(*expr, fmt::format("{} takes {}, not {}", what, list, phrase_of(*kind)), *allowed.begin(), kind);
      return std::nullopt;
    }
    if (common && *common != *kind) {
      mismatch(*expr,
               fmt::format("{} takes values of one kind, not {} and {}", what, phrase_of(*common), phrase_of(*kind)),
               common, kind);
      return std::nullopt;
    }
    common = kind;
  }
  return common;
}

KindChecker::MaybeKind KindChecker::of(Expr& expr) {
  MaybeKind kind;
  switch (expr.kind) {
    case ExprKind::number:
      if (expr.unit == ast::Unit::percent)
        context_.diagnostics.error("E0305", expr.span, "`%` stands only as a size in `split`, alone and without `~`",
                                   fmt::format("write `{:g}`", expr.value / 100));
      kind = expr.unit == ast::Unit::degrees || expr.unit == ast::Unit::radians ? Kind::angle : Kind::number;
      break;
    case ExprKind::text: kind = Kind::text; break;
    case ExprKind::boolean: kind = Kind::boolean; break;
    case ExprKind::name: kind = of_name(expr); break;
    case ExprKind::call: kind = of_call(expr); break;
    case ExprKind::vector:
      for (const ast::ExprPtr& child : expr.children) expect(*child, {Kind::number}, "a component of a vector");
      kind = Kind::vector;
      break;
    case ExprKind::unary: kind = of_unary(expr); break;
    case ExprKind::binary: kind = of_binary(expr); break;
    case ExprKind::ternary: kind = of_ternary(expr); break;
    case ExprKind::member:
      expect(*expr.children[0], {Kind::vector}, "`.x .y .z`");
      kind = Kind::number;
      break;
  }
  expr.value_kind = kind.value_or(Kind::number);
  return kind;
}

KindChecker::MaybeKind KindChecker::of_name(const Expr& expr) {
  if (expr.name == "scope") return Kind::vector;
  if (expr.name == "depth") return Kind::number;
  if (expr.name == "childless") return Kind::boolean;
  if (const auto local = locals_.find(expr.name); local != locals_.end()) return local->second;
  if (const auto global = globals_.find(expr.name); global != globals_.end()) return global->second;
  if (const Builtin* builtin = find_builtin(expr.name))
    return builtin->sort == BuiltinSort::primitive ? MaybeKind(Kind::mesh) : std::nullopt;
  const ast::Decl* decl = context_.checked.find(expr.name);
  if (!decl) return std::nullopt;
  switch (decl->kind) {
    case ast::DeclKind::constant:
    case ast::DeclKind::attribute: return value_kinds_[context_.index_of(*decl)];
    case ast::DeclKind::mesh: return Kind::mesh;
    case ast::DeclKind::material: return Kind::material;
    default: return std::nullopt;
  }
}

KindChecker::MaybeKind KindChecker::of_unary(const Expr& expr) {
  const MaybeKind operand = of(*expr.children[0]);
  if (!operand) return expr.op == ast::Operator::logical_not ? MaybeKind(Kind::boolean) : std::nullopt;
  const MaybeKind kind = kind_of_unary(expr.op, *operand);
  if (!kind)
    mismatch(*expr.children[0], fmt::format("{}, not {}", rule_of(expr.op), phrase_of(*operand)),
             expr.op == ast::Operator::logical_not ? Kind::boolean : Kind::number, operand);
  return kind;
}

KindChecker::MaybeKind KindChecker::of_binary(const Expr& expr) {
  const MaybeKind left = of(*expr.children[0]);
  const MaybeKind right = of(*expr.children[1]);
  const bool truth = expr.op >= ast::Operator::less;
  if (!left || !right) return truth ? MaybeKind(Kind::boolean) : std::nullopt;
  const MaybeKind kind = kind_of_binary(expr.op, *left, *right);
  if (kind) return kind;
  // Help names the unit for the side that lacks one.
  const bool plain_left = *left == Kind::number && *right == Kind::angle;
  const Expr& odd = plain_left ? *expr.children[0] : *expr.children[1];
  const MaybeKind wanted = plain_left ? right : left;
  context_.diagnostics.error("E0302", expr.span,
                             fmt::format("{}, not {} and {}", rule_of(expr.op), phrase_of(*left), phrase_of(*right)),
                             help_for(odd, wanted, plain_left ? left : right));
  return truth ? MaybeKind(Kind::boolean) : std::nullopt;
}

KindChecker::MaybeKind KindChecker::of_ternary(const Expr& expr) {
  expect(*expr.children[0], {Kind::boolean}, "the condition of `? :`");
  const MaybeKind kind = common_kind({expr.children[1].get(), expr.children[2].get()}, {}, "`? :`");
  if (kind != Kind::texture) return kind;
  mismatch(expr, "`? :` chooses between surfaces, not between textures", std::nullopt, kind);
  return std::nullopt;
}

KindChecker::MaybeKind KindChecker::of_call(Expr& expr) {
  if (expr.name == "depth") return Kind::number;
  const ast::Decl* decl = context_.checked.find(expr.name);
  if (decl && decl->kind == ast::DeclKind::function) return of_function(expr, *decl);
  const Builtin* builtin = find_builtin(expr.name);
  if (!builtin) {
    for (const ast::Arg& arg : expr.args) of(*arg.value);
    return std::nullopt;
  }
  switch (builtin->sort) {
    case BuiltinSort::function: return of_builtin(expr);
    case BuiltinSort::primitive: primitive_arguments(expr); return Kind::mesh;
    case BuiltinSort::surface: surface_arguments_of(expr); return Kind::material;
    case BuiltinSort::texture: surface_arguments_of(expr); return Kind::texture;
    default: return std::nullopt;
  }
}

KindChecker::MaybeKind KindChecker::of_function(const Expr& expr, const ast::Decl& function) {
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const MaybeKind kind = of(*expr.args[i].value);
    if (i < function.params.size()) pass_argument(function, i, *expr.args[i].value, kind);
  }
  const std::size_t index = context_.index_of(function);
  visit_function(index);
  return signatures_[index].result;
}

KindChecker::MaybeKind KindChecker::of_builtin(const Expr& expr) {
  std::vector<Kind> kinds;
  std::string given;
  for (const ast::Arg& arg : expr.args) {
    const MaybeKind kind = of(*arg.value);
    if (!kind) continue;
    kinds.push_back(*kind);
    given += fmt::format("{}{}", given.empty() ? "" : ", ", phrase_of(*kind));
  }
  const Builtin* builtin = find_builtin(expr.name);
  const int count = static_cast<int>(expr.args.size());
  if (kinds.size() != expr.args.size() || count < builtin->fewest || count > builtin->most)
    return fixed_kind_of_function(expr.name);
  const MaybeKind kind = kind_of_function(expr.name, kinds);
  if (kind) return kind;
  std::string help;
  if (count == 1 && (expr.name == "sin" || expr.name == "cos" || expr.name == "tan"))
    help = help_for(*expr.args[0].value, Kind::angle, kinds[0]);
  context_.diagnostics.error("E0302", expr.span, fmt::format("{}, not {}", rule_of_function(expr.name), given), help);
  return fixed_kind_of_function(expr.name);
}

void KindChecker::primitive_arguments(const Expr& expr) {
  for (const ast::Arg& arg : expr.args)
    expect(*arg.value, {Kind::number}, fmt::format("an argument of `{}`", expr.name));
}

void KindChecker::surface_arguments_of(const Expr& expr) {
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    ast::Expr& value = *expr.args[i].value;
    if (const SurfaceArgument* argument = surface_argument(expr, i))
      expect(value, {kind_of(argument->sort)}, fmt::format("`{}` of `{}`", argument->name, expr.name));
    else of(value);
  }
}

}  // namespace espalier
