#include "grammar/outline.h"

#include "base/diagnostic.h"
#include "grammar/checker.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

// In one line, without comments.
std::string slice(std::string_view text, const SourceSpan& span) {
  if (span.offset > text.size()) return "";
  std::string words;
  bool comment = false, gap = false, quoted = false;
  for (const char c : text.substr(span.offset, span.length)) {
    if (c == '\n') comment = false;
    if (comment) continue;
    if (c == '"') quoted = !quoted;
    if (c == '#' && !quoted) {
      comment = gap = true;
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) {
      gap = true;
    } else {
      if (gap && !words.empty()) words += ' ';
      gap = false;
      words += c;
    }
  }
  return words;
}

class Outliner {
 public:
  explicit Outliner(std::string_view text) : text_(text) {}

  GrammarOutline run(const ast::Grammar& grammar) {
    for (const ast::Decl& decl : grammar.decls) {
      if (decl.kind == ast::DeclKind::attribute) add_attribute(decl);
      if (decl.kind != ast::DeclKind::rule) continue;
      RuleOutline& rule = outline_.rules[decl.name];
      for (const ast::Param& param : decl.params) rule.parameters.push_back(param.name);
      if (decl.guard) rule.guard = slice(text_, decl.guard->span);
      walk(decl.body, rule);
    }
    return std::move(outline_);
  }

 private:
  void walk(const ast::Block& block, RuleOutline& rule) {
    for (const ast::StmtPtr& stmt : block.statements) {
      if (stmt->kind == ast::StmtKind::draw) add_draw(*stmt, rule);
      if (stmt->kind == ast::StmtKind::spawn && stmt->probability) {
        outline_.probabilities[stmt->span.offset] = slice(text_, stmt->probability->span);
      }
      for (const ast::Block& inner : stmt->blocks) walk(inner, rule);
      for (const ast::Case& one : stmt->cases) walk(one.block, rule);
    }
  }

  void add_attribute(const ast::Decl& decl) {
    AttributeOutline& attribute = outline_.attributes[decl.name];
    attribute.value = slice(text_, decl.value->span);
    if (!decl.low) return;
    attribute.range = slice(text_, decl.low->span) + ".." + slice(text_, decl.high->span);
    if (decl.step) attribute.range += " by " + slice(text_, decl.step->span);
  }

  void add_draw(const ast::Stmt& stmt, RuleOutline& rule) {
    const ast::Expr& call = *stmt.exprs[0];
    DrawOutline draw{stmt.name, slice(text_, call.span), call.name, {}, call.value_kind};
    if (call.name == "pick") {
      for (const ast::Arg& arg : call.args) draw.alternatives.push_back(slice(text_, arg.value->span));
    }
    rule.draws.push_back(std::move(draw));
  }

  std::string_view text_;
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

GrammarOutline outline_of(std::string_view text) {
  Diagnostics diagnostics;
  ast::Grammar grammar = parse(text, diagnostics);
  if (diagnostics.has_errors()) return {};
  // The checker tells what kinds the draws are of; a text that it refuses is outlined without.
  if (const auto checked = check(std::move(grammar), {}, diagnostics)) return Outliner(text).run(checked->ast);
  Diagnostics unused;
  return Outliner(text).run(parse(text, unused));
}

}  // namespace espalier
