// The checker's look at what can never come to pass: branches, alternatives, rules, and what empty slots would show.

#include <fmt/core.h>

#include "grammar/check_context.h"
#include "grammar/depth_samples.h"

namespace espalier {
namespace {

using ast::Decl;
using ast::Stmt;
using ast::StmtKind;

class Unreachable {
 public:
  explicit Unreachable(CheckContext& context) : context_(context), samples_(context) {}

  void run() {
    for (const auto& [condition, taken] : context_.branches) branches(*condition, taken);
    for (const Decl& decl : context_.decls()) {
      if (decl.kind != ast::DeclKind::rule || decl.span.file != 0) continue;
      if (decl.guard) guard(decl);
      block(decl, decl.body);
    }
  }

 private:
  void warn(const SourceSpan& span, std::string message, std::string help = {}) {
    if (span.file == 0) context_.diagnostics.warning("W0411", span, std::move(message), std::move(help));
  }

  void branches(const Stmt& condition, const CheckContext::Branches& taken) {
    if (taken.open) return;
    if (!taken.first)
      warn(condition.exprs[0]->span, "this condition never holds, so what it guards is never reached");
    else if (!taken.second && condition.blocks.size() > 1)
      warn(condition.exprs[0]->span, "this condition always holds, so its `else` is never reached");
  }

  /// Guards on depth alone: what depth(R) may come to beside it depends on the whole grammar.
  void guard(const Decl& decl) {
    if (decl.name == context_.checked.start) return;
    bool fixed = true, holds = false;
    const int least = samples_.least_depth(context_.index_of(decl));
    for (int depth = least; depth <= DepthSamples::kDeepest && fixed && !holds; ++depth) {
      StaticScope scope{context_.checked};
      scope.locals["depth"] = StaticValue::number(depth);
      const auto value = evaluate_static(*decl.guard, scope);
      fixed = value.has_value();
      holds = value && value->truth();
    }
    if (fixed && !holds)
      warn(decl.guard->span, fmt::format("no gene of `{}` can ever be made: its guard holds at no depth from {} on",
                                         decl.name, least));
  }

  void block(const Decl& decl, const ast::Block& body) {
    for (const ast::StmtPtr& stmt : body.statements) {
      if (stmt->kind == StmtKind::choose) alternatives(decl, *stmt);
      if (stmt->kind == StmtKind::spawn) shown_when_empty(*stmt);
      for (const ast::Block& inner : stmt->blocks) block(decl, inner);
      for (const ast::Case& one : stmt->cases) block(decl, one.block);
    }
  }

  void alternatives(const Decl& decl, const Stmt& choose) {
    for (const ast::Case& one : choose.cases) {
      if (!samples_.reads_depth(*one.value)) continue;  // constant weights are > 0
      bool known = true, chosen = false;
      samples_.each_depth(decl, [&](int, const StaticScope& scope) {
        const auto weight = evaluate_static(*one.value, scope);
        known &= weight.has_value();
        chosen |= weight && weight->scalar() > 0;
        return known && !chosen;
      });
      if (known && !chosen)
        warn(one.value->span, fmt::format("this alternative is never chosen: its weight is 0 wherever `{}` may stand",
                                          decl.name));
    }
  }

  void shown_when_empty(const Stmt& spawn) {
    const Decl* child = context_.checked.find(spawn.target->name, ast::DeclKind::rule);
    if (!child || child->guard || spawn.probability || !spawn.on_empty || !spawn.on_open) return;
    warn(spawn.on_empty->span,
         fmt::format("`else` is never shown: the child is required, and `{}` has no guard", child->name));
  }

  CheckContext& context_;
  DepthSamples samples_;
};

}  // namespace

void check_unreachable(CheckContext& context) { Unreachable(context).run(); }

}  // namespace espalier
