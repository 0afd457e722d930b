// The checker's pass over structure: what may stand in rules and what in details, under conditions and in loops.

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include <fmt/core.h>

#include "grammar/check_context.h"
#include "grammar/face.h"
#include "grammar/words.h"

namespace espalier {
namespace {

using ast::Expr;
using ast::ExprKind;
using ast::Stmt;
using ast::StmtKind;

class StructureChecker {
 public:
  explicit StructureChecker(CheckContext& context) : context_(context) {}

  void body(const ast::Decl& decl) {
    in_rule_ = decl.kind == ast::DeclKind::rule;
    block(decl.body);
  }

 private:
  /// The `if` around, where it decides by more than constants.
  enum class Condition : std::uint8_t { none, open, childless };

  void error(std::string code, const SourceSpan& span, std::string message, std::string help = {}) {
    context_.diagnostics.error(std::move(code), span, std::move(message), std::move(help));
  }

  void block(const ast::Block& block) {
    for (const ast::StmtPtr& stmt : block.statements) statement(*stmt);
  }

  void statement(const Stmt& stmt) {
    if (in_rule_) rule_statement(stmt);
    else detail_statement(stmt);
    if (stmt.kind == StmtKind::split) split(stmt);
    if (stmt.kind == StmtKind::comp) comp(stmt);
    if (stmt.kind == StmtKind::choose && stmt.cases.empty())
      error("E0408", stmt.span, "`choose` has at least one alternative, got none");
    if (stmt.kind == StmtKind::if_) return condition(stmt);
    if (stmt.kind == StmtKind::for_) return loop(stmt);
    for (const ast::Block& inner : stmt.blocks) block(inner);
    for (const ast::Case& one : stmt.cases) block(one.block);
  }

  void detail_statement(const Stmt& stmt) {
    if (stmt.kind == StmtKind::spawn)
      error("E0402", stmt.span, "a detail never spawns: genes are made by rules alone",
            "call another detail with `detail NAME`, or make this a rule");
    if (stmt.kind == StmtKind::bone) error("E0402", stmt.span, "a detail makes no bones", "bones belong to rules");
    if (stmt.kind == StmtKind::emit && stmt.as_proxy)
      error("E0402", stmt.span, "a detail has no proxies", "`as proxy` in a rule stands in for its details");
  }

  void rule_statement(const Stmt& stmt) {
    if (condition_ == Condition::none) return;
    std::string_view what;
    if (stmt.kind == StmtKind::spawn) what = "slot";
    if (stmt.kind == StmtKind::draw) what = "draw";
    if (stmt.kind == StmtKind::choose) what = "choice";
    if (stmt.kind == StmtKind::bone) what = "bone";
    if (what.empty()) return;
    if (condition_ == Condition::childless)
      error("E0406", stmt.span, fmt::format("no {} can stand under `childless`", what),
            "`childless` tells which slots are filled, so it decides only what is shown: call a detail");
    else
      error("E0403", stmt.span,
            fmt::format("an `if` on more than constants holds no {}, so that what can grow is known before the search",
                        what),
            what == "slot" ? "a guard, `rule NAME when ...`, or the probability may depend on depth"
                           : "move it out of the `if`, or into a detail");
  }

  void condition(const Stmt& stmt) {
    const Condition before = condition_;
    if (in_rule_ && condition_ != Condition::childless && !constant(*stmt.exprs[0]))
      condition_ = reads_childless(*stmt.exprs[0]) ? Condition::childless : Condition::open;
    for (const ast::Block& inner : stmt.blocks) block(inner);
    condition_ = before;
  }

  void loop(const Stmt& stmt) {
    if (in_rule_) {
      for (const ast::ExprPtr& value : stmt.list.values)
        if (const Expr* reader = reader_of_attribute(*value))
          error("E0405", reader->span,
                fmt::format("the list of a `for` in a rule holds only constants, and `{}` reads more", reader->name));
      loops_.insert(stmt.name);
    }
    block(stmt.blocks[0]);
    if (in_rule_) loops_.erase(stmt.name);
  }

  /// Reads only literals, consts and loop variables, and functions of those.
  bool constant(const Expr& expr) const {
    if (expr.kind == ExprKind::name)
      return loops_.contains(expr.name) || context_.checked.find(expr.name, ast::DeclKind::constant);
    if (expr.kind == ExprKind::call && (expr.name == "depth" || reader_of_attribute(expr) == &expr)) return false;
    return std::all_of(expr.children.begin(), expr.children.end(),
                       [&](const auto& child) { return constant(*child); }) &&
           std::all_of(expr.args.begin(), expr.args.end(), [&](const auto& arg) { return constant(*arg.value); });
  }

  /// The call of a function that reads attrs or the start rule's draws, if there is one.
  const Expr* reader_of_attribute(const Expr& expr) const {
    if (expr.kind == ExprKind::call) {
      if (const ast::Decl* function = context_.checked.find(expr.name, ast::DeclKind::function)) {
        const std::size_t index = context_.index_of(*function);
        if (context_.reads_attributes[index] || context_.globals_read[index] > 0) return &expr;
      }
    }
    for (const auto& child : expr.children)
      if (const Expr* found = reader_of_attribute(*child)) return found;
    for (const auto& arg : expr.args)
      if (const Expr* found = reader_of_attribute(*arg.value)) return found;
    return nullptr;
  }

  static bool reads_childless(const Expr& expr) {
    if (expr.kind == ExprKind::name) return expr.name == "childless";
    return std::any_of(expr.children.begin(), expr.children.end(), [](const auto& c) { return reads_childless(*c); }) ||
           std::any_of(expr.args.begin(), expr.args.end(), [](const auto& a) { return reads_childless(*a.value); });
  }

  void split(const Stmt& stmt) {
    const ast::Case* repeat = nullptr;
    for (const ast::Case& part : stmt.cases) {
      if (part.sizing != ast::Case::Sizing::repeat) continue;
      if (repeat)
        error("E0407", part.span, "a `split` has at most one `repeat`",
              fmt::format("the first stands on line {}", repeat->span.line));
      repeat = &part;
    }
    if (stmt.cases.empty()) error("E0408", stmt.span, "`split` has at least one part, got none");
  }

  void comp(const Stmt& stmt) {
    std::set<std::string_view> seen;
    std::uint8_t left = 0b111111;
    for (const ast::Case& one : stmt.cases) {
      const auto named = faces_named(one.face);
      if (!named)
        error("E0409", one.span, fmt::format("`comp` knows no face `{}`", one.face),
              "front, back, right, left, top, bottom, sides or all");
      else if (!seen.insert(one.face).second)
        error("E0409", one.span, fmt::format("the face `{}` is named twice", one.face),
              "each face goes to the first line naming it");
      else if (!(*named & left))
        context_.diagnostics.warning("W0410", one.span,
                                     fmt::format("`{}` is never reached: lines before it take all its faces", one.face),
                                     "each face goes to the first line naming it");
      if (named) left = static_cast<std::uint8_t>(left & ~*named);
    }
    if (stmt.cases.empty()) error("E0408", stmt.span, "`comp` names at least one face, got none");
  }

  CheckContext& context_;
  bool in_rule_ = true;
  Condition condition_ = Condition::none;
  std::set<std::string_view> loops_{};
};

}  // namespace

void check_structure(CheckContext& context) {
  StructureChecker checker(context);
  for (const ast::Decl& decl : context.decls())
    if (decl.kind == ast::DeclKind::rule || decl.kind == ast::DeclKind::detail) checker.body(decl);
}

}  // namespace espalier
