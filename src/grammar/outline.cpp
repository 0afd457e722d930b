#include "grammar/outline.h"

#include "base/check.h"
#include "grammar/one_line.h"

namespace espalier {
namespace {

class Outliner {
 public:
  explicit Outliner(std::span<const SourceText> sources) : sources_(sources) {}

  GrammarOutline run(const ast::Grammar& grammar) {
    for (const ast::Decl& decl : grammar.decls) {
      if (decl.kind == ast::DeclKind::attribute) add_attribute(decl);
      if (decl.kind != ast::DeclKind::rule) continue;
      RuleOutline& rule = outline_.rules[decl.name];
      for (const ast::Param& param : decl.params) rule.parameters.push_back(param.name);
      if (decl.guard) rule.guard = slice(decl.guard->span);
      walk(decl.body, rule);
    }
    return std::move(outline_);
  }

 private:
  void walk(const ast::Block& block, RuleOutline& rule) {
    for (const ast::StmtPtr& stmt : block.statements) {
      if (stmt->kind == ast::StmtKind::draw) add_draw(*stmt, rule);
      if (stmt->kind == ast::StmtKind::spawn && stmt->probability) {
        outline_.probabilities[{stmt->span.file, stmt->span.offset}] = slice(stmt->probability->span);
      }
      for (const ast::Block& inner : stmt->blocks) walk(inner, rule);
      for (const ast::Case& one : stmt->cases) walk(one.block, rule);
    }
  }

  void add_attribute(const ast::Decl& decl) {
    AttributeOutline& attribute = outline_.attributes[decl.name];
    attribute.value = slice(decl.value->span);
    if (!decl.low) return;
    attribute.range = slice(decl.low->span) + ".." + slice(decl.high->span);
    if (decl.step) attribute.range += " by " + slice(decl.step->span);
  }

  void add_draw(const ast::Stmt& stmt, RuleOutline& rule) {
    const ast::Expr& call = *stmt.exprs[0];
    DrawOutline draw{stmt.name, slice(call.span), call.name, {}, call.value_kind};
    if (call.name == "pick") {
      for (const ast::Arg& arg : call.args) draw.alternatives.push_back(slice(arg.value->span));
    }
    rule.draws.push_back(std::move(draw));
  }

  std::string slice(const SourceSpan& span) const {
    CHECK(span.file < sources_.size());
    const std::string_view text = sources_[span.file].text;
    CHECK(span.offset + span.length <= text.size());
    return in_one_line(text.substr(span.offset, span.length));
  }

  std::span<const SourceText> sources_;
  GrammarOutline outline_;
};

}  // namespace

const DrawOutline* GrammarOutline::find_draw(std::string_view rule, std::string_view component) const {
  const auto found = rules.find(rule);
  if (found == rules.end() || !component.starts_with(rule) || component.size() <= rule.size()) return nullptr;
  std::string_view name = component.substr(rule.size() + 1);
  name = name.substr(0, name.find_first_of(".["));
  for (const DrawOutline& draw : found->second.draws) {
    if (draw.name == name) return &draw;
  }
  return nullptr;
}

GrammarOutline outline_of(const CheckedGrammar& grammar, std::span<const SourceText> sources) {
  return Outliner(sources).run(grammar.ast);
}

}  // namespace espalier
