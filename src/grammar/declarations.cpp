// The checker's first pass: which declarations there are, and which rule is the start.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/check_context.h"
#include "grammar/spelling.h"

namespace espalier {
namespace {

using ast::Decl;
using ast::DeclKind;

constexpr std::size_t kMostRules = 65'535;  // ids of rules and details have 16 bits

void declare(CheckContext& context, const Decl& decl) {
  const auto [place, fresh] = context.checked.declarations.try_emplace(decl.name, context.index_of(decl));
  if (fresh) return;
  const Decl& earlier = context.decls()[place->second];
  context.diagnostics.error(
      "E0203", decl.name_span, fmt::format("`{}` is declared twice; all declarations share one namespace", decl.name),
      fmt::format("the {} `{}` stands on {}", word_of(earlier.kind), decl.name,
                  line_of(earlier.name_span, decl.name_span, context.checked.ast.files)));
}

void find_start(CheckContext& context, const Decl* start) {
  Diagnostics& diagnostics = context.diagnostics;
  if (!start) {
    const SourceSpan& span = context.checked.ast.name_span;
    diagnostics.error("E0208", span, "a grammar names its start rule, and this one does not", "add `start NAME`");
    return;
  }
  const Decl* rule = context.checked.find(start->name);
  if (!rule || rule->kind != DeclKind::rule) {
    std::vector<std::string_view> rules;
    for (const Decl& decl : context.decls())
      if (decl.kind == DeclKind::rule) rules.push_back(decl.name);
    diagnostics.error("E0208", start->name_span,
                      rule ? fmt::format("the start must be a rule, and `{}` is a {}", start->name, word_of(rule->kind))
                           : fmt::format("there is no rule `{}` to start from", start->name),
                      did_you_mean(start->name, rules));
    return;
  }
  context.checked.start = start->name;
  context.used[context.index_of(*rule)] = true;
  if (!rule->params.empty())
    diagnostics.error("E0210", rule->params[0].span,
                      fmt::format("the start rule has no parameters, and `{}` has {}", rule->name, rule->params.size()),
                      "nobody spawns it, so there is nobody to pass arguments");
  for (const ast::StmtPtr& stmt : rule->body.statements)
    if (stmt->kind == ast::StmtKind::draw || stmt->kind == ast::StmtKind::let)
      context.globals.try_emplace(stmt->name, CheckContext::Global{context.globals.size()});
}

}  // namespace

std::string_view word_of(DeclKind kind) {
  switch (kind) {
    case DeclKind::import: return "import";
    case DeclKind::start: return "start";
    case DeclKind::constant: return "const";
    case DeclKind::function: return "fn";
    case DeclKind::attribute: return "attr";
    case DeclKind::mesh: return "mesh";
    case DeclKind::material: return "material";
    case DeclKind::rule: return "rule";
    case DeclKind::detail: return "detail";
  }
  return "?";
}

void collect_declarations(CheckContext& context) {
  const std::size_t count = context.decls().size();
  context.reads.resize(count);
  context.targets.resize(count);
  context.used.resize(count, false);
  context.globals_read.resize(count, 0);
  context.reads_attributes.resize(count, false);
  const Decl* start = nullptr;
  std::size_t bodies = 0;
  for (const Decl& decl : context.decls()) {
    if (decl.kind == DeclKind::import) {
      context.diagnostics.error("E0121", decl.span, fmt::format("there is no folder to import \"{}\" from", decl.name));
    } else if (decl.kind != DeclKind::start) {
      declare(context, decl);
    } else if (start) {
      context.diagnostics.error("E0209", decl.span,
                                fmt::format("the start is named twice, first on line {}", start->span.line));
    } else {
      start = &decl;
    }
    if (decl.limit && *decl.limit == 0)
      context.diagnostics.error("E0601", decl.name_span,
                                fmt::format("the limit of `{}` must be at least 1, got 0", decl.name),
                                "delete the rule if no gene of it may exist");
    bodies += decl.kind == DeclKind::rule || decl.kind == DeclKind::detail;
  }
  if (bodies > kMostRules)
    context.diagnostics.error(
        "E0605", context.checked.ast.name_span,
        fmt::format("a grammar has at most {} rules and details, this one has {}", kMostRules, bodies));
  find_start(context, start);
}

}  // namespace espalier
