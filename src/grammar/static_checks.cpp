#include "grammar/static_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/core.h>

#include "grammar/words.h"

namespace espalier {

using ast::Expr;
using ast::ExprKind;
using ast::Stmt;
using ast::StmtKind;

void StaticChecks::error(std::string code, const Expr& expr, std::string message, std::string help) {
  if (fresh(&expr, code)) context_.diagnostics.error(std::move(code), expr.span, std::move(message), std::move(help));
}

void StaticChecks::warning(std::string code, const Expr& expr, std::string message, std::string help) {
  if (fresh(&expr, code)) context_.diagnostics.warning(std::move(code), expr.span, std::move(message), std::move(help));
}

StaticChecks::Value StaticChecks::value(const Expr& expr, const StaticScope& scope) {
  return evaluate_static(expr, scope);
}

void StaticChecks::expression(const Expr& expr, const StaticScope& scope) {
  Diagnostics found;
  if (evaluate_static(expr, scope, &found)) return;  // whatever is in it has a value too
  for (const Diagnostic& d : found.items()) error(d.code, expr, d.message, d.help);
  if (const Builtin* builtin = expr.kind == ExprKind::call ? find_builtin(expr.name) : nullptr) {
    if (builtin->sort == BuiltinSort::surface || builtin->sort == BuiltinSort::texture) surface(expr, scope);
    if (builtin->sort == BuiltinSort::primitive) primitive(expr, scope);
  }
  if (!found.items().empty()) return;  // its parts would repeat the fault
  for (const ast::ExprPtr& child : expr.children) expression(*child, scope);
  for (const ast::Arg& arg : expr.args) expression(*arg.value, scope);
}

void StaticChecks::primitive(const Expr& expr, const StaticScope& scope) {
  constexpr double kFewest = 3, kMost = 1024;
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const ast::Arg& arg = expr.args[i];
    const bool sides = arg.label ? arg.label->name == "sides" : expr.name == "cylinder" || i == 1;
    if (!sides) continue;
    const Value count = value(*arg.value, scope);
    if (!count)
      error("E0514", *arg.value, "the sides of a primitive must be constant", "only `top` may vary from part to part");
    else if (count->scalar() < kFewest || count->scalar() > kMost || count->scalar() != std::floor(count->scalar()))
      error("E0514", *arg.value,
            fmt::format("the sides of a primitive must be a whole number in 3..1024, got {}", describe(*count)));
  }
}

/// Whether an expression of the statement, as far as this looks at them, reads a loop variable.
bool StaticChecks::reads_loop(const Stmt& stmt, const StaticScope& scope) {
  const auto [place, fresh_statement] = reads_loop_.try_emplace(&stmt, false);
  if (!fresh_statement) return place->second;
  const std::function<bool(const Expr&)> reads = [&](const Expr& expr) {
    return (expr.kind == ExprKind::name && scope.locals.contains(expr.name)) ||
           std::any_of(expr.children.begin(), expr.children.end(), [&](const auto& child) { return reads(*child); }) ||
           std::any_of(expr.args.begin(), expr.args.end(),
                       [&](const ast::Arg& arg) { return reads(*arg.value) || (arg.label && reads(*arg.label)); });
  };
  bool found = false;
  for (const ast::ExprPtr& expr : stmt.exprs) found = found || reads(*expr);
  for (const ast::Case& one : stmt.cases) found = found || (one.value && reads(*one.value));
  for (const std::optional<ast::Ref>* ref : {&stmt.target, &stmt.on_empty, &stmt.on_open})
    if (*ref)
      for (const ast::ExprPtr& arg : (*ref)->args) found = found || reads(*arg);
  return place->second = found;
}

void StaticChecks::statement(const Stmt& stmt, const StaticScope& scope, bool in_rule) {
  const bool seen = reads_loop_.contains(&stmt);
  if (!reads_loop(stmt, scope) && seen) return;  // as it was in the turn before
  for (const ast::ExprPtr& expr : stmt.exprs) expression(*expr, scope);
  for (const std::optional<ast::Ref>* ref : {&stmt.target, &stmt.on_empty, &stmt.on_open})
    if (*ref)
      for (const ast::ExprPtr& arg : (*ref)->args) expression(*arg, scope);
  switch (stmt.kind) {
    case StmtKind::draw: return draw(*stmt.exprs[0], scope);
    case StmtKind::scale:
    case StmtKind::size:
    case StmtKind::resize: return lengths(stmt, scope);
    case StmtKind::turn:
      if (!stmt.axis) direction(*stmt.exprs[0], scope);
      return;
    case StmtKind::aim:
      if (!stmt.at) direction(*stmt.exprs[0], scope);
      return;
    case StmtKind::around:
      if (const Value count = value(*stmt.exprs[0], scope)) {
        const double rounded = std::floor(count->scalar() + 0.5);
        if (rounded < 1 || rounded > 1024)
          error("E0512", *stmt.exprs[0],
                fmt::format("the count of `around` must be in 1..1024, got {}", describe(*count)));
      }
      return;
    case StmtKind::split: return sizes(stmt, scope);
    case StmtKind::choose:
      if (!in_rule) weights(stmt, scope);
      return;
    default: return;
  }
}

void StaticChecks::lengths(const Stmt& stmt, const StaticScope& scope) {
  const Value given = value(*stmt.exprs[0], scope);
  if (!given) return;
  const bool scale = stmt.kind == StmtKind::scale;
  for (int i = 0; i < components_of(given->kind); ++i) {
    const double number = given->numbers[static_cast<std::size_t>(i)];
    if (number > 0 || (number == 0 && !scale)) continue;
    const std::string_view name = scale ? "scale" : stmt.kind == StmtKind::size ? "size" : "resize";
    return error("E0513", *stmt.exprs[0],
                 fmt::format("`{}` must be {} 0, got {}", name, scale ? ">" : ">=", describe(*given)),
                 scale && number < 0 ? "`reflect` turns an axis around" : "");
  }
}

void StaticChecks::direction(const Expr& expr, const StaticScope& scope) {
  const Value given = value(expr, scope);
  if (given && given->kind == Kind::vector && given->numbers == std::array<double, 3>{})
    error("E0516", expr, "a direction must not be (0, 0, 0)");
}

void StaticChecks::sizes(const Stmt& stmt, const StaticScope& scope) {
  for (const ast::Case& part : stmt.cases) {
    expression(*part.value, scope);
    const Value size = value(*part.value, scope);
    const bool repeat = part.sizing == ast::Case::Sizing::repeat;
    if (size && (size->scalar() < 0 || (repeat && size->scalar() == 0)))
      error("E0517", *part.value,
            fmt::format("a size in `split` must be {} 0, got {}", repeat ? ">" : ">=", describe(*size)));
  }
}

/// Of `choose` in details; those in rules depend on depth and are looked at elsewhere.
void StaticChecks::weights(const Stmt& stmt, const StaticScope& scope) {
  for (const ast::Case& one : stmt.cases) {
    expression(*one.value, scope);
    if (const Value weight = value(*one.value, scope); weight && !(weight->scalar() > 0))
      error("E0510", *one.value, fmt::format("a weight must be > 0, got {}", describe(*weight)));
  }
}

}  // namespace espalier
