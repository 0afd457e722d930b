#pragma once
// A grammar as boxes within boxes, for the formatter: items (declarations, statements, cases) are runs of tokens and
// bodies in braces; bodies hold items. Made from the syntax tree.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "grammar/ast.h"
#include "grammar/layout_tokens.h"

namespace espalier {

struct LayoutBody;

/// Tokens first..last-1, on their own or as the braces and inside of a body.
struct LayoutPiece {
  std::size_t first = 0, last = 0;
  std::unique_ptr<LayoutBody> body;
};

struct LayoutItem {
  std::size_t first = 0, last = 0;
  std::vector<LayoutPiece> pieces;
  std::optional<int> flat_width;  // columns on one line; nothing where it holds comments or open bodies
};

struct LayoutBody {
  bool cases = false;  // of choose, split, comp
  std::vector<LayoutItem> items;
  std::optional<int> flat_width;  // braces included; nothing where the author opened it, or it holds comments

  int item_gap() const { return cases ? 1 : 2; }
};

/// The whole file: the header and the declarations, in a body without braces.
LayoutBody layout_of(const ast::Grammar& grammar, const LayoutTokens& tokens);

}  // namespace espalier
