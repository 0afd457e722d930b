#pragma once
// A syntax tree written out in full, without spans: two grammars mean the same where these texts are equal.

#include <string>

#include <fmt/core.h>

#include "grammar/ast.h"

namespace espalier::testing {

class TreeText {
 public:
  static std::string of(const ast::Grammar& grammar) {
    TreeText writer;
    writer.text_ = fmt::format("{} {}", grammar.name, grammar.language_version);
    for (const ast::Decl& d : grammar.decls) writer.decl(d);
    return writer.text_;
  }

 private:
  void add(const std::string& piece) { text_ += "\n" + piece; }

  void decl(const ast::Decl& d) {
    add(fmt::format("decl {} {} [{}]", static_cast<int>(d.kind), d.name, d.label));
    for (const ast::Param& p : d.params) add("param " + p.name);
    for (const auto* e : {&d.value, &d.low, &d.high, &d.step, &d.guard}) expr(e->get());
    add(d.limit ? fmt::format("limit {}", *d.limit) : "no limit");
    block(d.body);
  }
  void expr(const ast::Expr* e) {
    if (!e) return add("null");
    add(fmt::format("expr {} {} {} {} {} [{}] {} {}", static_cast<int>(e->kind), e->value, static_cast<int>(e->unit),
                    static_cast<int>(e->op), static_cast<int>(e->axis), e->name, e->children.size(), e->args.size()));
    for (const ast::ExprPtr& child : e->children) expr(child.get());
    for (const ast::Arg& arg : e->args) expr(arg.label.get()), expr(arg.value.get());
  }
  void block(const ast::Block& b) {
    add(fmt::format("block {}", b.statements.size()));
    for (const ast::StmtPtr& s : b.statements) stmt(*s);
  }
  void ref(const std::optional<ast::Ref>& r) {
    if (!r) return add("no ref");
    add(fmt::format("ref {} {}", r->name, r->args.size()));
    for (const ast::ExprPtr& arg : r->args) expr(arg.get());
  }
  void stmt(const ast::Stmt& s) {
    add(fmt::format("stmt {} [{}] {} {} {} {} {} {} {}", static_cast<int>(s.kind), s.name,
                    s.axis ? static_cast<int>(*s.axis) : -1, s.at, s.as_is, s.as_proxy, s.exprs.size(), s.blocks.size(),
                    s.cases.size()));
    expr(s.probability.get());
    for (const ast::ExprPtr& e : s.exprs) expr(e.get());
    add(fmt::format("list {} {}", s.list.range, s.list.values.size()));
    for (const ast::ExprPtr& e : s.list.values) expr(e.get());
    for (const ast::Block& b : s.blocks) block(b);
    for (const ast::Case& c : s.cases) {
      add(fmt::format("case {} [{}]", static_cast<int>(c.sizing), c.face));
      expr(c.value.get());
      block(c.block);
    }
    ref(s.target), ref(s.on_empty), ref(s.on_open);
  }

  std::string text_;
};

}  // namespace espalier::testing
