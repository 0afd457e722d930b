#pragma once
// Writes a layout tree on a page. What it decides depends on the tokens, on which of them shared a line, and on nothing
// that it changes itself: so a second time changes nothing. Private to the formatter.

#include "grammar/layout_page.h"
#include "grammar/layout_tokens.h"
#include "grammar/layout_tree.h"

namespace espalier {

class LayoutPrinter {
 public:
  LayoutPrinter(const LayoutTokens& tokens, LayoutPage& page) : tokens_(tokens), page_(page) {}

  void file(const LayoutBody& body);

 private:
  void items(const LayoutBody& body, int indent, bool one_a_line);
  bool stays_beside(const LayoutItem& before, const LayoutItem& item, int gap) const;
  void item(const LayoutItem& item, int indent, int gap);
  void piece(const LayoutItem& item, std::size_t i, int indent, bool open_all);
  void open_body(const LayoutPiece& piece, int indent);
  int tail_width(const LayoutItem& item, std::size_t i) const;

  void flat(const LayoutItem& item);
  void flat(const LayoutPiece& piece);
  void run(const LayoutItem& item, std::size_t first, std::size_t last, int indent, int reserve);
  void segment(std::size_t first, std::size_t last, int indent, int reserve);
  std::size_t break_point(std::size_t first, std::size_t last) const;

  void comments_between(std::size_t token, int indent, bool first_in_body);
  bool comments_within(std::size_t token, int indent);
  void end_comment(const Comment& comment);
  void begin_line(int indent, std::uint32_t source_line, bool first_in_body);
  int gap_before(std::size_t token) const;
  void put(std::size_t token);

  const LayoutTokens& tokens_;
  LayoutPage& page_;
  int next_gap_ = -1;                // blanks before the next token, where the tokens do not tell
  std::uint32_t source_line_ = 0;    // of what was written last
  const Comment* ending_ = nullptr;  // the comment at the end of the line above, while lines may go on with it
};

}  // namespace espalier
