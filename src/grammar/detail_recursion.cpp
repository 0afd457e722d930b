// Details that always call themselves: nothing but the budget of parts ends them.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/check_context.h"

namespace espalier {
namespace {

using ast::StmtKind;

/// Details that a body calls whatever happens: not under a condition, loop, choice, split or comp.
void collect_calls(const CheckContext& context, const ast::Block& block, std::vector<std::size_t>& calls) {
  for (const ast::StmtPtr& stmt : block.statements) {
    if (stmt->kind == StmtKind::detail && context.checked.find(stmt->target->name, ast::DeclKind::detail))
      calls.push_back(context.checked.declarations.find(stmt->target->name)->second);
    if (stmt->kind == StmtKind::block || stmt->kind == StmtKind::mirror || stmt->kind == StmtKind::around)
      collect_calls(context, stmt->blocks[0], calls);
  }
}

}  // namespace

/// What is left when details that end are taken away one after the other, last calls first.
void check_detail_recursion(CheckContext& context) {
  const auto& decls = context.decls();
  std::vector<std::vector<std::size_t>> callers(decls.size());
  std::vector<std::size_t> open_calls(decls.size(), 0), ready;
  for (std::size_t i = 0; i < decls.size(); ++i) {
    if (decls[i].kind != ast::DeclKind::detail) continue;
    std::vector<std::size_t> calls;
    collect_calls(context, decls[i].body, calls);
    for (const std::size_t callee : calls) callers[callee].push_back(i);
    open_calls[i] = calls.size();
    if (calls.empty()) ready.push_back(i);
  }
  for (std::size_t next = 0; next < ready.size(); ++next)
    for (const std::size_t caller : callers[ready[next]])
      if (--open_calls[caller] == 0) ready.push_back(caller);
  for (std::size_t i = 0; i < decls.size(); ++i)
    if (open_calls[i] > 0)
      context.diagnostics.warning("W0804", decls[i].name_span,
                                  fmt::format("the detail `{}` calls details without end", decls[i].name),
                                  "put the call under an `if`; else only the budget of parts ends it");
}

}  // namespace espalier
