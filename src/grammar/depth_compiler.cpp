#include "grammar/depth_compiler.h"

#include <algorithm>

#include <fmt/core.h>

#include "grammar/expr_compiler.h"

namespace espalier {
namespace {

using Step = DepthValue::Step;
constexpr std::size_t kMostSteps = 30;  // DepthValue evaluates on a stack of 32

class DepthCompiler {
 public:
  DepthCompiler(const NameScope& scope, GraphTables& tables) : scope_(scope), tables_(tables) {}

  void push(double value) { steps.push_back({Step::Kind::constant, Arithmetic::add, 0, value}); }
  void apply(Arithmetic op) { steps.push_back({Step::Kind::apply, op, 0, 0}); }

  void compile(const ast::Expr& expr) {
    switch (expr.kind) {
      case ast::ExprKind::number: return push(literal_value(expr).scalar());
      case ast::ExprKind::boolean: return push(expr.value);
      case ast::ExprKind::name: return name(expr);
      case ast::ExprKind::unary: compile(*expr.children[0]); return apply(arithmetic_of(expr.op));
      case ast::ExprKind::binary:
        compile(*expr.children[0]);
        compile(*expr.children[1]);
        return apply(arithmetic_of(expr.op));
      case ast::ExprKind::ternary:
        for (const auto& child : expr.children) compile(*child);
        return apply(Arithmetic::select);
      case ast::ExprKind::call: return call(expr);
      default: return unknown(expr);
    }
  }

  DepthValue finish(const ast::Expr& expr) {
    if (steps.size() > kMostSteps) {
      tables_.diagnostics.error("E0904", expr.span,
                                fmt::format("a probability, weight or guard may have at most {} terms, this has {}",
                                            kMostSteps, steps.size()));
      return DepthValue(1);
    }
    return simplified(steps);
  }

  static DepthValue simplified(std::vector<Step> steps) {
    const bool fixed = std::none_of(steps.begin(), steps.end(), [](const Step& s) {
      return s.kind == Step::Kind::depth || s.kind == Step::Kind::depth_of;
    });
    DepthValue value(std::move(steps));
    return fixed ? DepthValue(value.at({})) : value;
  }

  std::vector<Step> steps;

 private:
  void unknown(const ast::Expr& expr) {
    tables_.diagnostics.error("E0905", expr.span,
                              "probabilities, weights and guards read only constants, attrs and depth");
    push(1);
  }
  void name(const ast::Expr& expr) {
    if (expr.name == "depth") {
      steps.push_back({Step::Kind::depth, Arithmetic::add, 0, 0});
      return;
    }
    const Value* value = scope_.find(expr.name);
    if (!value || !value->constant()) return unknown(expr);
    const auto exact = tables_.grammar.constants.find(expr.name);
    push(exact != tables_.grammar.constants.end() ? exact->second.scalar() : value->number());
  }
  void call(const ast::Expr& expr) {
    if (expr.name == "depth" && expr.args.size() == 1) {
      steps.push_back({Step::Kind::depth_of, Arithmetic::add, tables_.counted_index(expr.args[0].value->name), 0});
      return;
    }
    const auto found = scalar_functions().find(expr.name);
    const Arithmetic op = expr.name == "mix" ? Arithmetic::mix
                          : found == scalar_functions().end() ? Arithmetic::add : found->second;
    if (op == Arithmetic::add) return function(expr);
    for (const ast::Arg& arg : expr.args) compile(*arg.value);
    apply(op);
  }
  // Pure functions of constants fold; of depth they are refused (write the expression out).
  void function(const ast::Expr& expr) {
    const StaticScope constants{tables_.grammar};
    const auto value = evaluate_static(expr, constants);
    if (value) push(value->scalar());
    else unknown(expr);
  }

  const NameScope& scope_;
  GraphTables& tables_;
};

void append(std::vector<Step>& steps, const DepthValue& value) {
  if (value.constant()) steps.push_back({Step::Kind::constant, Arithmetic::add, 0, value.at({})});
  else steps.insert(steps.end(), value.postfix().begin(), value.postfix().end());
}

}  // namespace

DepthValue compile_depth_value(const ast::Expr& expr, const NameScope& scope, GraphTables& tables) {
  DepthCompiler compiler(scope, tables);
  compiler.compile(expr);
  return compiler.finish(expr);
}

DepthValue share_of(const std::vector<const ast::Expr*>& weights, std::size_t chosen, const NameScope& scope,
                    GraphTables& tables) {
  std::vector<Step> steps;
  append(steps, compile_depth_value(*weights[chosen], scope, tables));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    append(steps, compile_depth_value(*weights[i], scope, tables));
    if (i > 0) steps.push_back({Step::Kind::apply, Arithmetic::add, 0, 0});
  }
  steps.push_back({Step::Kind::apply, Arithmetic::divide, 0, 0});
  return DepthCompiler::simplified(std::move(steps));
}

DepthValue product(const DepthValue& a, const DepthValue& b) {
  if (a.constant() && b.constant()) return DepthValue(a.at({}) * b.at({}));
  std::vector<Step> steps;
  append(steps, a);
  append(steps, b);
  steps.push_back({Step::Kind::apply, Arithmetic::multiply, 0, 0});
  return DepthCompiler::simplified(std::move(steps));
}

}  // namespace espalier
