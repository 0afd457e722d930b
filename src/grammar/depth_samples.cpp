#include "grammar/depth_samples.h"

#include <algorithm>

#include <fmt/core.h>

namespace espalier {

using ast::Decl;
using ast::DeclKind;
using ast::Expr;
using ast::ExprKind;

DepthSamples::DepthSamples(const CheckContext& context) : context_(context) {
  for (const Decl& decl : context.decls()) {
    if (decl.kind != DeclKind::rule) continue;
    if (decl.guard) find_counted(*decl.guard);
    find_counted(decl.body);
  }
  std::sort(counted_.begin(), counted_.end());
  counted_.erase(std::unique(counted_.begin(), counted_.end()), counted_.end());
  find_least_depths();
}

/// Only in probabilities and weights: nothing else here depends on it.
void DepthSamples::find_counted(const ast::Block& block) {
  for (const ast::StmtPtr& stmt : block.statements) {
    if (stmt->probability) find_counted(*stmt->probability);
    for (const ast::Block& inner : stmt->blocks) find_counted(inner);
    for (const ast::Case& one : stmt->cases) {
      if (stmt->kind == ast::StmtKind::choose) find_counted(*one.value);
      find_counted(one.block);
    }
  }
}

void DepthSamples::find_counted(const Expr& expr) {
  if (expr.kind == ExprKind::call && expr.name == "depth") {
    counted_.push_back(expr.args[0].value->name);
    return;
  }
  for (const ast::ExprPtr& child : expr.children) find_counted(*child);
  for (const ast::Arg& arg : expr.args) find_counted(*arg.value);
}

void DepthSamples::find_least_depths() {
  least_depth_.assign(context_.decls().size(), 0);
  const Decl* start = context_.start();
  if (!start) return;
  std::vector<char> seen(context_.decls().size(), false);
  std::vector<std::size_t> row = {context_.index_of(*start)};
  seen[row[0]] = true;
  for (int depth = 0; !row.empty(); ++depth) {
    std::vector<std::size_t> next;
    for (const std::size_t rule : row) {
      least_depth_[rule] = depth;
      for (const std::size_t child : context_.targets[rule]) {
        if (context_.decls()[child].kind != DeclKind::rule || seen[child]) continue;
        seen[child] = true;
        next.push_back(child);
      }
    }
    row = std::move(next);
  }
}

bool DepthSamples::reads_depth(const Expr& expr) const {
  if ((expr.kind == ExprKind::call || expr.kind == ExprKind::name) && expr.name == "depth") return true;
  return std::any_of(expr.children.begin(), expr.children.end(),
                     [&](const auto& child) { return reads_depth(*child); }) ||
         std::any_of(expr.args.begin(), expr.args.end(), [&](const auto& arg) { return reads_depth(*arg.value); });
}

StaticScope DepthSamples::at(double depth, const std::function<double(const std::string&)>& of) const {
  StaticScope scope{context_.checked, true, {}};
  scope.locals["depth"] = StaticValue::number(depth);
  for (const std::string& rule : counted_) scope.locals[fmt::format("depth({})", rule)] = StaticValue::number(of(rule));
  return scope;
}

void DepthSamples::each_depth(const Decl& rule, const std::function<bool(int, const StaticScope&)>& visit) const {
  const int least = least_depth_[context_.index_of(rule)];
  for (int depth = least; depth <= std::max(least, kDeepest); ++depth) {
    const StaticScope scope = at(depth, [depth](const std::string&) { return depth; });
    if (rule.guard) {
      const auto holds = evaluate_static(*rule.guard, scope);
      if (!holds || !holds->truth()) continue;
    }
    if (!visit(depth, scope)) return;
  }
}

}  // namespace espalier
