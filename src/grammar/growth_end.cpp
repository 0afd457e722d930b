// Rules whose genes can never be complete: every way through them requires another gene without end, and no guard ever
// stops it. A limit does not help there, it only leaves nothing to derive.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/growth.h"

namespace espalier {

using ast::Stmt;
using ast::StmtKind;

bool GrowthCheck::ends(const ast::Block& block) const {
  return std::all_of(block.statements.begin(), block.statements.end(), [&](const ast::StmtPtr& s) { return ends(*s); });
}

bool GrowthCheck::ends(const Stmt& stmt) const {
  const StaticScope scope{context_.checked, false, {}};
  switch (stmt.kind) {
    case StmtKind::spawn:
      return stmt.probability || ends_[context_.checked.declarations.find(stmt.target->name)->second];
    case StmtKind::choose:
      return std::any_of(stmt.cases.begin(), stmt.cases.end(), [&](const ast::Case& c) { return ends(c.block); });
    case StmtKind::for_: {
      const auto values = evaluate_static_list(stmt.list, scope);
      return (values && values->empty()) || ends(stmt.blocks[0]);
    }
    case StmtKind::if_: {
      // Conditions on loop variables: what may not be required is taken not to be.
      const auto holds = evaluate_static(*stmt.exprs[0], scope);
      const bool then = ends(stmt.blocks[0]);
      const bool otherwise = stmt.blocks.size() < 2 || ends(stmt.blocks[1]);
      return holds ? (holds->truth() ? then : otherwise) : then || otherwise;
    }
    default: break;
  }
  return std::all_of(stmt.blocks.begin(), stmt.blocks.end(), [&](const ast::Block& b) { return ends(b); }) &&
         std::all_of(stmt.cases.begin(), stmt.cases.end(), [&](const ast::Case& c) { return ends(c.block); });
}

void GrowthCheck::check_end() {
  const auto& decls = context_.decls();
  std::vector<Rules> parents(decls.size());
  std::vector<std::size_t> open;
  ends_.assign(decls.size(), false);
  for (std::size_t i = decls.size(); i-- > 0;) {
    if (decls[i].kind != ast::DeclKind::rule) continue;
    for (const SpawnTerm& term : context_.spawns[i]) parents[term.child].push_back(i);
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t rule = open.back();
    open.pop_back();
    if (ends_[rule] || !(can_be_absent_[rule] || ends(decls[rule].body))) continue;
    ends_[rule] = true;
    for (const std::size_t parent : parents[rule])
      if (!ends_[parent]) open.push_back(parent);
  }
  std::vector<char> reported(decls.size(), false);
  for (std::size_t i = 0; i < decls.size(); ++i) {
    if (decls[i].kind != ast::DeclKind::rule || ends_[i] || !context_.checked.reachable[decls[i].name]) continue;
    report_endless(i, reported);
  }
}

/// Follows required children without end from a rule until one comes up again.
void GrowthCheck::report_endless(std::size_t rule, std::vector<char>& reported) {
  Rules way;
  std::size_t at = rule;
  while (!reported[at]) {
    reported[at] = true;
    way.push_back(at);
    const auto& terms = context_.spawns[at];
    const auto next = std::find_if(terms.begin(), terms.end(),
                                   [&](const SpawnTerm& t) { return !t.spawn->probability && !ends_[t.child]; });
    if (next == terms.end()) return;
    at = next->child;
  }
  const auto begin = std::find(way.begin(), way.end(), at);
  if (begin == way.end()) return;  // leads to a cycle that has been reported
  std::string names;
  constexpr std::ptrdiff_t kShown = 8;
  for (auto step = begin; step != way.end(); ++step) {
    if (step - begin == kShown) names += "... -> ";
    if (step - begin < kShown) names += fmt::format("`{}` -> ", context_.decls()[*step].name);
  }
  const ast::Decl& decl = context_.decls()[at];
  context_.diagnostics.error("E0801", decl.name_span,
                             fmt::format("a gene of `{}` can never be complete: {}`{}` is required at every turn",
                                         decl.name, names, decl.name),
                             "write `maybe`, or add a guard that fails some day: `rule NAME when depth < N`");
}

}  // namespace espalier
