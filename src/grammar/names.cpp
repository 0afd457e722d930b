// Names in bodies: scopes, references, what is never read, what is never reached.

#include "grammar/names.h"

#include <utility>

#include <fmt/core.h>

#include "grammar/spelling.h"

namespace espalier {

using ast::Decl;
using ast::DeclKind;
using ast::StmtKind;

NameChecker::Reader NameChecker::body_reader() const {
  return {kConstants | kAttributes | kGlobals | kLocals | kLoops | kScope | kDepth | kMeshes,
          in_rule() ? "this" : "a detail", "only the condition of an `if` in a rule reads `childless`"};
}

NameChecker::Reader NameChecker::condition_reader() const {
  Reader reader = body_reader();
  if (in_rule()) reader.sees |= kChildless;
  return reader;
}

void NameChecker::parameters(const Decl& decl) {
  for (const ast::Param& param : decl.params) declare(param.name, LocalSort::parameter, param.span);
}

void NameChecker::body(const Decl& decl) {
  decl_ = &decl;
  globals_defined_ = in_start() ? 0 : context_.globals.size();
  nesting_ = 0;
  parameters(decl);
  if (decl.guard)
    read(*decl.guard, {kConstants | kAttributes | kDepth, "a guard",
                       "guards read only constants, attrs and depth, so that validity never depends on a draw"});
  statements(decl.body);
  for (const ast::Param& param : decl.params) close(param.name);
}

void NameChecker::block(const ast::Block& block) {
  ++nesting_;
  statements(block);
  --nesting_;
}

void NameChecker::statements(const ast::Block& block) {
  for (const ast::StmtPtr& stmt : block.statements) statement(*stmt);
  for (const ast::StmtPtr& stmt : block.statements) {
    const bool local = !(in_start() && nesting_ == 0);
    if (local && (stmt->kind == StmtKind::draw || stmt->kind == StmtKind::let)) close(stmt->name);
  }
}

void NameChecker::statement(const ast::Stmt& stmt) {
  switch (stmt.kind) {
    case StmtKind::draw:
    case StmtKind::let: return bind(stmt);
    case StmtKind::for_: return loop(stmt);
    case StmtKind::choose:
    case StmtKind::split:
    case StmtKind::comp: return cases(stmt);
    case StmtKind::spawn:
      if (stmt.probability)
        read(*stmt.probability, {kConstants | kAttributes | kDepth, "the probability of a spawn",
                                 "it reads only constants, attrs and depth; the slots of a loop share it"});
      break;
    default: break;
  }
  const bool condition = stmt.kind == StmtKind::if_;
  for (const ast::ExprPtr& expr : stmt.exprs) read(*expr, condition ? condition_reader() : body_reader());
  if (stmt.target) reference(*stmt.target, stmt.kind == StmtKind::spawn ? DeclKind::rule : DeclKind::detail);
  if (stmt.on_empty) reference(*stmt.on_empty, DeclKind::detail);
  if (stmt.on_open) reference(*stmt.on_open, DeclKind::detail);
  for (const ast::Block& inner : stmt.blocks) block(inner);
}

void NameChecker::cases(const ast::Stmt& stmt) {
  const Reader weight{kConstants | kAttributes | kDepth | kLoops, "a weight in a rule",
                      "weights read only constants, attrs and depth, so that the prior never depends on a draw"};
  const bool fixed = in_rule() && stmt.kind == StmtKind::choose;
  for (const ast::Case& one : stmt.cases) {
    if (one.value) read(*one.value, fixed ? weight : body_reader());
    block(one.block);
  }
}

void NameChecker::bind(const ast::Stmt& stmt) {
  if (stmt.kind == StmtKind::draw) draw(*stmt.exprs[0], body_reader());
  else read(*stmt.exprs[0], body_reader());
  if (in_start() && nesting_ == 0) {
    const auto place = context_.globals.find(stmt.name);
    if (place->second.place < globals_defined_)
      context_.diagnostics.error("E0204", stmt.name_span,
                                 fmt::format("`{}` is already a name of the start rule", stmt.name));
    else ++globals_defined_;
  }
  declare(stmt.name, stmt.kind == StmtKind::draw ? LocalSort::draw : LocalSort::let, stmt.name_span);
}

void NameChecker::loop(const ast::Stmt& stmt) {
  const Reader fixed{
      kConstants | kLoops, "the list of a `for` in a rule",
      "it holds only literals, consts and outer loop variables, so that slots and draws are known before "
      "the search; details may loop over anything"};
  for (const ast::ExprPtr& value : stmt.list.values) read(*value, in_rule() ? fixed : body_reader());
  declare(stmt.name, LocalSort::loop, stmt.name_span);
  block(stmt.blocks[0]);
  close(stmt.name);
}

void NameChecker::declare(std::string_view name, LocalSort sort, const SourceSpan& span) {
  const auto refuse = [&](std::string what, std::string help) {
    context_.diagnostics.error("E0204", span, fmt::format("`{}` hides {}", name, what), std::move(help));
  };
  const bool global = in_start() && nesting_ == 0 && (sort == LocalSort::draw || sort == LocalSort::let);
  if (const Decl* decl = context_.checked.find(name))
    refuse(fmt::format("the {} of that name", word_of(decl->kind)),
           fmt::format("it stands on {}", line_of(decl->name_span, span, context_.checked.ast.files)));
  else if (!global && context_.globals.contains(name) && in_start())
    refuse("the draw or let of that name at the top of the start rule", "those are seen everywhere");
  else if (!global && context_.globals.contains(name)) context_.hidings.push_back({name, span});
  if (global) return;
  const auto [place, fresh] = locals_.try_emplace(name, Local{sort, span});
  if (fresh) return;
  ++place->second.layers;
  refuse("another of that name in sight", fmt::format("that one stands on line {}", place->second.span.line));
}

/// Leaves the scope of a name, and says so if nobody read it.
void NameChecker::close(std::string_view name) {
  const auto found = locals_.find(name);
  if (found == locals_.end()) return;
  if (--found->second.layers > 0) return;
  const Local local = found->second;
  locals_.erase(found);
  if (!local.used && local.sort != LocalSort::loop) report_unread(name, local.sort, local.span);
}

void NameChecker::report_unread(std::string_view name, LocalSort sort, const SourceSpan& span) {
  constexpr std::string_view kWords[] = {"parameter", "draw", "let", "loop variable"};
  if (sort == LocalSort::draw && in_rule())
    context_.diagnostics.error("E0207", span,
                               fmt::format("nobody reads the draw `{}`, so it would be a dead gene", name),
                               "use it or delete it");
  else
    context_.diagnostics.warning("W0221", span,
                                 fmt::format("nobody reads the {} `{}`", kWords[static_cast<int>(sort)], name));
}

void NameChecker::close_globals() {
  decl_ = context_.start();
  if (!decl_) return;
  for (const ast::StmtPtr& stmt : decl_->body.statements) {
    if (stmt->kind != StmtKind::draw && stmt->kind != StmtKind::let) continue;
    if (!std::exchange(context_.globals.find(stmt->name)->second.used, true))
      report_unread(stmt->name, stmt->kind == StmtKind::draw ? LocalSort::draw : LocalSort::let, stmt->name_span);
  }
  // Two things of one name: an error where readers of both exist outside the start rule, else only bad style.
  for (const CheckContext::Hiding& hiding : context_.hidings) {
    const std::string message =
        fmt::format("`{}` hides the draw or let of that name at the top of the start rule", hiding.name);
    constexpr const char* kHelp = "those are seen everywhere; pick another name for one of the two";
    if (context_.globals.find(hiding.name)->second.used_outside)
      context_.diagnostics.error("E0204", hiding.span, message, kHelp);
    else if (hiding.span.file == 0)  // an imported file cannot know who imports it
      context_.diagnostics.warning("W0204", hiding.span, message, kHelp);
  }
}

void NameChecker::reference(const ast::Ref& ref, DeclKind kind) {
  Diagnostics& diagnostics = context_.diagnostics;
  for (const ast::ExprPtr& arg : ref.args) read(*arg, body_reader());
  const Decl* target = context_.checked.find(ref.name);
  if (!target || target->kind != kind) {
    std::vector<std::string_view> names;
    for (const Decl& decl : context_.decls())
      if (decl.kind == kind && diagnostics.error_count() < Diagnostics::kMostErrors) names.push_back(decl.name);
    std::string help = did_you_mean(ref.name, names);
    if (target && target->kind == DeclKind::detail) help = fmt::format("details are called: `detail {}`", ref.name);
    if (target && target->kind == DeclKind::rule) help = fmt::format("rules are made with `spawn {}`", ref.name);
    if (target)
      diagnostics.error("E0206", ref.span,
                        fmt::format("`{}` is a {}, not a {}", ref.name, word_of(target->kind), word_of(kind)), help);
    else diagnostics.error("E0202", ref.span, fmt::format("there is no {} `{}`", word_of(kind), ref.name), help);
    return;
  }
  const std::size_t index = context_.index_of(*target);
  context_.targets[context_.index_of(*decl_)].push_back(index);
  if (kind == DeclKind::rule && target->name == context_.checked.start)
    diagnostics.error("E0211", ref.span, fmt::format("`{}` is the start rule, which is never spawned", ref.name),
                      fmt::format("move its body to another rule and spawn that from `{}`", ref.name));
  const int params = static_cast<int>(target->params.size());
  count(ref.span, ref.name, ref.args.size(), params, params);
}

namespace {

/// Marks what the start rule leads to, and warns of what it does not.
void check_reach(CheckContext& context) {
  const Decl* start = context.start();
  if (!start) return;
  std::vector<std::size_t> open = {context.index_of(*start)};
  std::vector<char> reached(context.decls().size(), false);
  reached[open[0]] = true;
  while (!open.empty()) {
    const std::size_t from = open.back();
    open.pop_back();
    for (const std::size_t to : context.targets[from])
      if (!std::exchange(reached[to], true)) open.push_back(to);
  }
  for (const Decl& decl : context.decls()) {
    if (decl.kind != DeclKind::rule && decl.kind != DeclKind::detail) continue;
    const bool here = reached[context.index_of(decl)];
    context.checked.reachable[decl.name] = here;
    if (!here && decl.span.file == 0)  // a file that is imported may hold more than is needed
      context.diagnostics.warning(
          "W0222", decl.name_span,
          fmt::format("the start rule never leads to the {} `{}`", word_of(decl.kind), decl.name));
  }
}

void warn_of_unused(CheckContext& context) {
  for (const Decl& decl : context.decls()) {
    const bool value = decl.kind == DeclKind::constant || decl.kind == DeclKind::function ||
                       decl.kind == DeclKind::attribute || decl.kind == DeclKind::mesh ||
                       decl.kind == DeclKind::material;
    if (value && decl.span.file == 0 && !context.used[context.index_of(decl)])
      context.diagnostics.warning("W0221", decl.name_span,
                                  fmt::format("nobody reads the {} `{}`", word_of(decl.kind), decl.name));
  }
}

}  // namespace

void check_body_names(CheckContext& context) {
  NameChecker names(context);
  for (const Decl& decl : context.decls())
    if (decl.kind == DeclKind::rule || decl.kind == DeclKind::detail) names.body(decl);
  names.close_globals();
  check_reach(context);
  warn_of_unused(context);
}

}  // namespace espalier
