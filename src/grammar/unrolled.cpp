// The checker's walk over bodies as they will be compiled: in rules, loops are unrolled and constant conditions
// decided. It counts what a rule holds and looks at every value that is known by then.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "grammar/check_context.h"
#include "grammar/depth_samples.h"
#include "grammar/static_checks.h"

namespace espalier {
namespace {

using ast::Decl;
using ast::Stmt;
using ast::StmtKind;

constexpr std::size_t kMostStatements = 100'000;  // of one rule
constexpr std::size_t kMostStatementsOfAll = 1'000'000;
constexpr std::size_t kMostSlots = 65'535;
constexpr std::size_t kMostDraws = 65'535;
constexpr double kMostVariants = 256;

class Unroller {
 public:
  explicit Unroller(CheckContext& context)
      : context_(context), samples_(context), checks_(context), scope_{context.checked} {}

  void run() {
    context_.spawns.resize(context_.decls().size());
    for (const Decl& decl : context_.decls()) {
      if (decl.kind == ast::DeclKind::mesh || decl.kind == ast::DeclKind::material)
        checks_.expression(*decl.value, scope_);
      if (decl.kind == ast::DeclKind::function) checks_.expression(*decl.value, scope_);
      if (decl.kind == ast::DeclKind::rule) rule(decl);
      if (decl.kind == ast::DeclKind::detail) detail(decl);
      if (too_large_) return;
    }
    start_guard();
  }

 private:
  void error(std::string code, const SourceSpan& span, std::string message, std::string help = {}) {
    context_.diagnostics.error(std::move(code), span, std::move(message), std::move(help));
  }

  void rule(const Decl& decl) {
    decl_ = &decl;
    in_rule_ = true;
    statements_ = slots_ = draws_ = 0;
    terms_.clear();
    chosen_ = ChosenCase::kNone;
    scope_.locals.clear();
    const double variants = block(decl.body);
    if (too_large_) return;
    for (const auto& [key, term] : terms_) context_.spawns[context_.index_of(decl)].push_back(term);
    const auto most = [&](std::string code, double count, double limit, std::string_view what, std::string help) {
      if (count > limit)
        error(std::move(code), decl.name_span,
              fmt::format("a rule has at most {:.0f} {}, and `{}` has {:.0f}", limit, what, decl.name, count),
              std::move(help));
    };
    most("E0602", variants, kMostVariants, "variants (one per combination of its `choose` alternatives)",
         "move a `choose` to a rule of its own, or write `maybe .. else`");
    most("E0603", static_cast<double>(slots_), kMostSlots, "slots", "spawn a rule that spawns the rest");
    most("E0606", static_cast<double>(draws_), kMostDraws, "draws", "move some to a rule of their own");
  }

  void detail(const Decl& decl) {
    decl_ = &decl;
    in_rule_ = false;
    statements_ = 0;
    scope_.locals.clear();
    block(decl.body);
  }

  /// Counts one statement or turn of a loop. False once there are too many.
  bool count_statement() {
    if (too_large_) return false;
    if (++statements_ > kMostStatements || ++all_statements_ > kMostStatementsOfAll) {
      too_large_ = true;
      const bool one = statements_ > kMostStatements;
      error("E0604", decl_->name_span,
            one ? fmt::format("`{}` has more than {} statements once its loops are unrolled", decl_->name,
                              kMostStatements)
                : fmt::format("the grammar has more than {} statements once all loops are unrolled",
                              kMostStatementsOfAll),
            "what need not be searched over can loop in a detail");
    }
    return !too_large_;
  }

  /// The number of variants.
  double block(const ast::Block& block) {
    double variants = 1;
    for (const ast::StmtPtr& stmt : block.statements) {
      if (!count_statement()) return variants;
      variants = std::min(variants * statement(*stmt), 1e9);
    }
    return variants;
  }

  double statement(const Stmt& stmt) {
    checks_.statement(stmt, scope_, in_rule_);
    switch (stmt.kind) {
      case StmtKind::for_: return loop(stmt);
      case StmtKind::if_: return condition(stmt);
      case StmtKind::choose: return in_rule_ ? choose(stmt) : blocks(stmt);
      case StmtKind::spawn: spawn(stmt); return 1;
      case StmtKind::draw: draws_ += static_cast<std::size_t>(components_of(stmt.exprs[0]->value_kind)); return 1;
      default: return blocks(stmt);
    }
  }

  double blocks(const Stmt& stmt) {
    double variants = 1;
    for (const ast::Block& inner : stmt.blocks) variants *= block(inner);
    for (const ast::Case& one : stmt.cases) variants *= block(one.block);
    return variants;
  }

  double loop(const Stmt& stmt) {
    StaticScope fixed{context_.checked, false, scope_.locals};
    Diagnostics found;
    const auto values = evaluate_static_list(stmt.list, fixed, &found);
    for (const Diagnostic& d : found.items())
      if (faulty_.insert(&stmt).second) error(d.code, d.span, d.message, d.help);
    if (!in_rule_) return blocks(stmt);
    if (!values) return 1;
    double variants = 1;
    for (const StaticValue& value : *values) {
      if (!count_statement()) break;
      scope_.locals[stmt.name] = value;
      variants = std::min(variants * block(stmt.blocks[0]), 1e9);
    }
    scope_.locals.erase(stmt.name);
    return variants;
  }

  double condition(const Stmt& stmt) {
    const StaticScope fixed{context_.checked, false, scope_.locals};
    const auto holds = evaluate_static(*stmt.exprs[0], fixed);
    CheckContext::Branches& taken = context_.branches[&stmt];
    (!holds ? taken.open : holds->truth() ? taken.first : taken.second) = true;
    if (!holds || !in_rule_) return blocks(stmt);
    if (holds->truth()) return block(stmt.blocks[0]);
    return stmt.blocks.size() > 1 ? block(stmt.blocks[1]) : 1;
  }

  double choose(const Stmt& stmt) {
    check_weights(stmt);
    const std::size_t outer = chosen_;
    double variants = 0;
    for (std::size_t i = 0; i < stmt.cases.size(); ++i) {
      context_.chosen.push_back({outer, &stmt, i, scope_.locals});
      chosen_ = context_.chosen.size() - 1;
      variants += block(stmt.cases[i].block);
    }
    chosen_ = outer;
    return variants;
  }

  void spawn(const Stmt& stmt) {
    ++slots_;
    SpawnTerm& term = terms_[{&stmt, chosen_}];
    term.spawn = &stmt;
    term.child = context_.checked.declarations.find(stmt.target->name)->second;
    term.chosen = chosen_;
    ++term.copies;
    if (stmt.probability && seen_.insert(&stmt).second) check_probability(stmt);
  }

  void check_probability(const Stmt& stmt) {
    const ast::Expr& expr = *stmt.probability;
    const bool varies = samples_.reads_depth(expr);
    samples_.each_depth(*decl_, [&](int depth, const StaticScope& scope) {
      const auto p = evaluate_static(expr, scope, &context_.diagnostics);
      if (!p) return false;
      if (p->scalar() > 0 && p->scalar() < 1) return varies;
      const std::string help = p->scalar() >= 1 && !varies ? "a child that always comes is `spawn` without `maybe`"
                               : varies ? "bound it with `clamp`, or the depth with a guard: `rule NAME when depth < N`"
                                        : "delete a spawn that never happens";
      error("E0511", expr.span,
            fmt::format("a probability must be > 0 and < 1, got {}{}", describe(*p),
                        varies ? fmt::format(" at depth {}", depth) : ""),
            help);
      return false;
    });
  }

  void check_weights(const Stmt& stmt) {
    for (const ast::Case& one : stmt.cases) checks_.expression(*one.value, scope_);
    if (!faulty_.empty() && faulty_.contains(&stmt)) return;
    const bool varies = std::any_of(stmt.cases.begin(), stmt.cases.end(),
                                    [&](const ast::Case& one) { return samples_.reads_depth(*one.value); });
    samples_.each_depth(*decl_, [&](int depth, StaticScope scope) {
      for (const auto& [name, value] : scope_.locals) scope.locals[name] = value;
      double total = 0;
      for (const ast::Case& one : stmt.cases) {
        const auto weight = evaluate_static(*one.value, scope);
        if (!weight) return false;
        const bool may_be_zero = samples_.reads_depth(*one.value);
        if (weight->scalar() < 0 || (weight->scalar() == 0 && !may_be_zero))
          return refuse_weight(stmt, *one.value, *weight, depth);
        total += weight->scalar();
      }
      if (total == 0) return refuse_weight(stmt, *stmt.cases[0].value, StaticValue::number(0), depth);
      return varies;
    });
  }

  bool refuse_weight(const Stmt& stmt, const ast::Expr& expr, const StaticValue& weight, int depth) {
    faulty_.insert(&stmt);
    const std::string where = samples_.reads_depth(expr) ? fmt::format(" at depth {}", depth) : "";
    error("E0510", expr.span, fmt::format("a weight must be > 0, got {}{}", describe(weight), where),
          where.empty() ? "delete an alternative that is never chosen"
                        : "weights on depth may be 0, but not all at once");
    return false;
  }

  void start_guard() {
    const Decl& start = *context_.start();
    if (!start.guard) return;
    const auto holds = evaluate_static(*start.guard, samples_.at(0, [](const std::string&) { return 0.0; }));
    if (holds && !holds->truth())
      error("E0518", start.guard->span,
            fmt::format("the guard of the start rule `{}` must hold at depth 0", start.name));
  }

  CheckContext& context_;
  DepthSamples samples_;
  StaticChecks checks_;
  StaticScope scope_;
  const Decl* decl_ = nullptr;
  bool in_rule_ = true;
  bool too_large_ = false;
  std::size_t statements_ = 0, all_statements_ = 0, slots_ = 0, draws_ = 0;
  std::size_t chosen_ = ChosenCase::kNone;
  // By place in the text, so that results do not depend on where the tree lies in memory.
  struct TermOrder {
    bool operator()(const std::pair<const Stmt*, std::size_t>& a, const std::pair<const Stmt*, std::size_t>& b) const {
      return std::pair(a.first->span.offset, a.second) < std::pair(b.first->span.offset, b.second);
    }
  };
  std::map<std::pair<const Stmt*, std::size_t>, SpawnTerm, TermOrder> terms_{};
  std::set<const Stmt*> seen_{}, faulty_{};
};

}  // namespace

void check_unrolled(CheckContext& context) { Unroller(context).run(); }

}  // namespace espalier
