#include "grammar/kinds.h"

#include <fmt/core.h>

namespace espalier {

using ast::Decl;
using ast::DeclKind;

KindChecker::KindChecker(CheckContext& context)
    : context_(context), signatures_(context.decls().size()), value_kinds_(context.decls().size()) {
  for (const Decl& decl : context.decls()) {
    Signature& signature = signatures_[context.index_of(decl)];
    signature.kinds.resize(decl.params.size());
    signature.set_by.resize(decl.params.size());
  }
}

void KindChecker::run() {
  for (const std::size_t index : context_.value_order) value_declaration(index);
  for (const Decl& decl : context_.decls())
    if (decl.kind == DeclKind::mesh) resource(decl);
  if (const Decl* start = context_.start()) enqueue(context_.index_of(*start));
  // What nobody calls is looked at too, in text order, with parameters that fit everywhere.
  for (std::size_t i = 0; i <= context_.decls().size(); ++i) {
    while (!open_.empty()) {
      const std::size_t index = open_.front();
      open_.pop_front();
      body(index);
    }
    if (i < context_.decls().size()) enqueue(i);
  }
  locals_.clear();
  for (const Decl& decl : context_.decls())
    if (decl.kind == DeclKind::material) resource(decl);  // may read what the start rule draws
  for (std::size_t i = 0; i < context_.decls().size(); ++i)
    if (context_.decls()[i].kind == DeclKind::function) visit_function(i);
  publish();
}

void KindChecker::enqueue(std::size_t index) {
  const DeclKind kind = context_.decls()[index].kind;
  if ((kind != DeclKind::rule && kind != DeclKind::detail) || signatures_[index].visited) return;
  signatures_[index].visited = true;
  open_.push_back(index);
}

void KindChecker::value_declaration(std::size_t index) {
  const Decl& decl = context_.decls()[index];
  if (decl.kind == DeclKind::function || decl.kind == DeclKind::material) return;
  value_kinds_[index] = of(*decl.value);
  if (decl.kind == DeclKind::attribute) attribute(decl, value_kinds_[index]);
}

void KindChecker::attribute(const Decl& decl, MaybeKind kind) {
  if (!kind) return;
  if (*kind != Kind::number && *kind != Kind::angle && *kind != Kind::boolean)
    return mismatch(
        *decl.value,
        fmt::format("an attr is a number, an angle or a boolean, and `{}` is {}", decl.name, phrase_of(*kind)),
        std::nullopt, kind);
  if (decl.low && *kind == Kind::boolean)
    return mismatch(*decl.low, fmt::format("the attr `{}` is a boolean and has no range", decl.name), std::nullopt,
                    kind);
  for (const ast::ExprPtr* bound : {&decl.low, &decl.high, &decl.step})
    if (*bound) expect(**bound, {*kind}, "the range of this attr");
}

void KindChecker::resource(const Decl& decl) {
  if (decl.kind == DeclKind::mesh) return expect(*decl.value, {Kind::mesh, Kind::text}, "a mesh declaration");
  expect(*decl.value, {Kind::material}, "a material declaration");
  const bool surface = decl.value->kind == ast::ExprKind::call && decl.value->name == "surface";
  if (decl.value->value_kind == Kind::material && !surface)
    mismatch(*decl.value, "a material is declared as `surface(...)`", std::nullopt, std::nullopt);
}

void KindChecker::body(std::size_t index) {
  const Decl& decl = context_.decls()[index];
  locals_.clear();
  nesting_ = 0;
  in_start_ = decl.kind == DeclKind::rule && decl.name == context_.checked.start;
  for (std::size_t i = 0; i < decl.params.size(); ++i) locals_[decl.params[i].name] = signatures_[index].kinds[i];
  if (decl.guard) expect(*decl.guard, {Kind::boolean}, "a guard");
  for (const ast::StmtPtr& stmt : decl.body.statements) statement(*stmt);
}

void KindChecker::visit_function(std::size_t index) {
  Signature& signature = signatures_[index];
  if (signature.visited) return;
  signature.visited = true;
  const Decl& decl = context_.decls()[index];
  std::map<std::string_view, MaybeKind> inner;
  for (std::size_t i = 0; i < decl.params.size(); ++i) inner[decl.params[i].name] = signature.kinds[i];
  std::swap(locals_, inner);
  signature.result = of(*decl.value);
  std::swap(locals_, inner);
}

void KindChecker::publish() {
  for (const Decl& decl : context_.decls()) {
    const Signature& signature = signatures_[context_.index_of(decl)];
    const bool callable =
        decl.kind == DeclKind::function || decl.kind == DeclKind::rule || decl.kind == DeclKind::detail;
    if (!callable) continue;
    std::vector<Kind> kinds;
    for (const MaybeKind& kind : signature.kinds) kinds.push_back(kind.value_or(Kind::number));
    context_.checked.parameter_kinds[decl.name] = std::move(kinds);
    if (decl.kind == DeclKind::function)
      context_.checked.function_kinds[decl.name] = signature.result.value_or(Kind::number);
  }
  for (const auto& [name, kind] : globals_)
    context_.checked.global_kinds[std::string(name)] = kind.value_or(Kind::number);
}

void check_kinds(CheckContext& context) { KindChecker(context).run(); }

}  // namespace espalier
