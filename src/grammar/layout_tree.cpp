#include "grammar/layout_tree.h"

#include <utility>

namespace espalier {
namespace {

using ast::StmtKind;

class TreeBuilder {
 public:
  explicit TreeBuilder(const LayoutTokens& tokens) : tokens_(tokens) {}

  LayoutBody file(const ast::Grammar& grammar) {
    constexpr std::size_t kHeader = 3;  // grammar NAME 1
    LayoutBody result;
    result.items.push_back(finish({0, kHeader, {}, {}}));
    for (const ast::Decl& decl : grammar.decls) {
      LayoutItem item = begin(decl.span);
      if (decl.kind == ast::DeclKind::rule || decl.kind == ast::DeclKind::detail) add_block(item, decl.body);
      result.items.push_back(finish(std::move(item)));
    }
    return result;
  }

 private:
  LayoutItem begin(const SourceSpan& span) const {
    return {tokens_.index_at(span.offset), tokens_.index_at(span.offset + span.length), {}, {}};
  }

  /// Appends the tokens up to the body, and the body.
  void add_body(LayoutItem& item, std::size_t first, std::size_t last, LayoutBody body) {
    measure(body, first, last);
    add_run(item, first);
    item.pieces.push_back({first, last, std::make_unique<LayoutBody>(std::move(body))});
  }
  void add_run(LayoutItem& item, std::size_t end) const {
    const std::size_t at = item.pieces.empty() ? item.first : item.pieces.back().last;
    if (at < end) item.pieces.push_back({at, end, nullptr});
  }
  void add_block(LayoutItem& item, const ast::Block& block) {
    const std::size_t first = tokens_.index_at(block.span.offset);
    if (!tokens_[first].is("{")) return add_blocks(item, *block.statements[0]);  // else if
    LayoutBody body;
    for (const ast::StmtPtr& stmt : block.statements) body.items.push_back(statement(*stmt));
    add_body(item, first, tokens_.index_at(block.span.offset + block.span.length), std::move(body));
  }
  void add_blocks(LayoutItem& item, const ast::Stmt& stmt) {
    if (stmt.kind == StmtKind::choose || stmt.kind == StmtKind::split || stmt.kind == StmtKind::comp)
      return add_cases(item, stmt);
    for (const ast::Block& block : stmt.blocks) add_block(item, block);
  }
  void add_cases(LayoutItem& item, const ast::Stmt& stmt) {
    std::size_t open = item.first;
    while (!tokens_[open].is("{")) ++open;
    LayoutBody body;
    body.cases = true;
    for (const ast::Case& one : stmt.cases) {
      LayoutItem inner = begin(one.span);
      add_block(inner, one.block);
      body.items.push_back(finish(std::move(inner)));
    }
    add_body(item, open, item.last, std::move(body));
  }
  LayoutItem statement(const ast::Stmt& stmt) {
    LayoutItem item = begin(stmt.span);
    add_blocks(item, stmt);
    return finish(std::move(item));
  }

  LayoutItem finish(LayoutItem item) const {
    add_run(item, item.last);
    if (tokens_.has_comments(item.first, item.last)) return item;
    int width = 0;
    for (const LayoutPiece& piece : item.pieces) {
      if (piece.body && !piece.body->flat_width) return item;
      width += piece.body ? *piece.body->flat_width : tokens_.width(piece.first, piece.last);
      if (piece.first != item.first) width += tokens_.gap(piece.first);
    }
    item.flat_width = width;
    return item;
  }
  void measure(LayoutBody& body, std::size_t first, std::size_t last) const {
    if (tokens_.has_comments(first, last)) return;
    if (!body.items.empty() && tokens_[first].span.line != tokens_[last - 1].span.line) return;
    int width = 3;  // "{ }", or "{ " in front and " }" behind less the gap that the first item does not need
    for (const LayoutItem& item : body.items) {
      if (!item.flat_width) return;
      width += *item.flat_width + body.item_gap();
    }
    body.flat_width = body.items.empty() ? width : width + 1 - body.item_gap();
  }

  const LayoutTokens& tokens_;
};

}  // namespace

LayoutBody layout_of(const ast::Grammar& grammar, const LayoutTokens& tokens) {
  return TreeBuilder(tokens).file(grammar);
}

}  // namespace espalier
