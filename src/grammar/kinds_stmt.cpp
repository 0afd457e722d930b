// Kinds that statements ask for, and those that draws, lets, loops and calls hand on.

#include <fmt/core.h>

#include "grammar/kinds.h"
#include "grammar/words.h"

namespace espalier {

using ast::StmtKind;
using enum Kind;

void KindChecker::block(const ast::Block& block) {
  ++nesting_;
  for (const ast::StmtPtr& stmt : block.statements) statement(*stmt);
  --nesting_;
}

void KindChecker::statement(const ast::Stmt& stmt) {
  switch (stmt.kind) {
    case StmtKind::draw: return bind(stmt, draw(*stmt.exprs[0]));
    case StmtKind::let: return bind(stmt, of(*stmt.exprs[0]));
    case StmtKind::if_: expect(*stmt.exprs[0], {boolean}, "the condition of `if`"); break;
    case StmtKind::for_: loop(stmt); break;
    case StmtKind::choose:
    case StmtKind::split:
    case StmtKind::comp: cases(stmt); break;
    case StmtKind::spawn:
      if (stmt.probability) expect(*stmt.probability, {number}, "`maybe`");
      break;
    case StmtKind::around: expect(*stmt.exprs[0], {number}, "the count of `around`"); break;
    default: state_statement(stmt); break;
  }
  for (const std::optional<ast::Ref>* ref : {&stmt.target, &stmt.on_empty, &stmt.on_open})
    if (*ref) reference(**ref);
  for (const ast::Block& inner : stmt.blocks) block(inner);
}

void KindChecker::state_statement(const ast::Stmt& stmt) {
  const auto first = [&](std::initializer_list<Kind> wanted, std::string_view what) {
    expect(*stmt.exprs[0], wanted, what);
  };
  const auto sized = [&](std::string_view what) {
    if (stmt.axis) first({number}, what);
    else first({vector, number}, what);
  };
  switch (stmt.kind) {
    case StmtKind::move:
      if (stmt.axis) first({number}, "`move` along an axis");
      else first({vector}, "`move`");
      break;
    case StmtKind::scale: return sized("`scale`");
    case StmtKind::size: return sized("`size`");
    case StmtKind::resize: return sized("`resize`");
    case StmtKind::turn:
      if (!stmt.axis) first({vector}, "the axis of `turn`");
      return expect(*stmt.exprs.back(), {angle}, "`turn`");
    case StmtKind::aim:
      first({vector}, "`aim`");
      if (stmt.exprs.size() > 1) expect(*stmt.exprs[1], {number}, "`by`");
      break;
    case StmtKind::forward: return first({number}, "`forward`");
    case StmtKind::yaw: return first({angle}, "`yaw`");
    case StmtKind::pitch: return first({angle}, "`pitch`");
    case StmtKind::roll: return first({angle}, "`roll`");
    case StmtKind::extrude: return first({number}, "`extrude`");
    case StmtKind::paint: return first({material}, "`paint`");
    case StmtKind::reseed: return first({number}, "`reseed`");
    case StmtKind::bone: first({vector}, "`bone`"); return expect(*stmt.exprs[1], {vector}, "`bone`");
    case StmtKind::emit: return first({mesh}, "`emit`");
    default: break;
  }
}

void KindChecker::bind(const ast::Stmt& stmt, MaybeKind kind) {
  if (kind == text) {
    mismatch(*stmt.exprs[0], fmt::format("`{}` would be a text, and only consts are texts", stmt.name), std::nullopt,
             kind);
    kind = std::nullopt;
  }
  if (kind == texture) {
    mismatch(*stmt.exprs[0], fmt::format("`{}` would be a texture, which stands only in `surface(..)`", stmt.name),
             std::nullopt, kind);
    kind = std::nullopt;
  }
  if (in_start_ && nesting_ == 0) globals_[stmt.name] = kind;
  else locals_[stmt.name] = kind;
}

void KindChecker::loop(const ast::Stmt& stmt) {
  std::vector<ast::Expr*> values;
  for (const ast::ExprPtr& value : stmt.list.values) values.push_back(value.get());
  if (stmt.list.range) locals_[stmt.name] = common_kind(values, {number}, "a range");
  else locals_[stmt.name] = common_kind(values, {number, angle, vector, boolean, mesh, material}, "a list");
}

void KindChecker::cases(const ast::Stmt& stmt) {
  for (const ast::Case& one : stmt.cases) {
    const bool percent = stmt.kind == StmtKind::split && one.sizing != ast::Case::Sizing::floating && one.value &&
                         one.value->kind == ast::ExprKind::number && one.value->unit == ast::Unit::percent;
    if (percent) one.value->value_kind = number;
    else if (one.value) expect(*one.value, {number}, stmt.kind == StmtKind::choose ? "a weight" : "a size in `split`");
    block(one.block);
  }
}

void KindChecker::reference(const ast::Ref& ref) {
  const ast::Decl* callee = context_.checked.find(ref.name);
  for (std::size_t i = 0; i < ref.args.size(); ++i) {
    const MaybeKind kind = of(*ref.args[i]);
    if (callee && i < callee->params.size()) pass_argument(*callee, i, *ref.args[i], kind);
  }
  if (callee) enqueue(context_.index_of(*callee));
}

void KindChecker::pass_argument(const ast::Decl& callee, std::size_t param, const ast::Expr& arg, MaybeKind kind) {
  if (!kind) return;
  Signature& signature = signatures_[context_.index_of(callee)];
  MaybeKind& known = signature.kinds[param];
  if (*kind == text || *kind == texture)
    return mismatch(arg, fmt::format("{} cannot be passed on", phrase_of(*kind)), std::nullopt, kind);
  if (!known) {
    known = kind;
    signature.set_by[param] = arg.span;
  } else if (*known != *kind) {
    context_.diagnostics.error("E0304", arg.span,
                               fmt::format("all calls of `{}` must agree: `{}` is {} here", callee.name,
                                           callee.params[param].name, phrase_of(*kind)),
                               fmt::format("it is {} on {}", phrase_of(*known),
                                           line_of(signature.set_by[param], arg.span, context_.checked.ast.files)));
  }
}

KindChecker::MaybeKind KindChecker::draw(ast::Expr& call) {
  std::vector<ast::Expr*> values;
  for (const ast::Arg& arg : call.args) {
    values.push_back(arg.value.get());
    if (arg.label && call.name == "pick") expect(*arg.label, {number}, "a weight");
  }
  const std::string what = fmt::format("`{}`", call.name);
  MaybeKind kind;
  if (call.name == "uniform") kind = common_kind(values, {number, angle, vector}, what);
  else if (call.name == "normal") kind = common_kind(values, {number, angle}, what);
  else if (call.name == "loguniform" || call.name == "integer")
    kind = common_kind(values, {number}, what), kind = number;
  else if (call.name == "angle") kind = angle;
  else if (call.name == "chance") common_kind(values, {number}, what), kind = boolean;
  else if (call.name == "pick") kind = common_kind(values, {number, angle, vector, boolean, mesh, material}, what);
  else common_kind(values, {}, what);
  call.value_kind = kind.value_or(number);
  return kind;
}

}  // namespace espalier
