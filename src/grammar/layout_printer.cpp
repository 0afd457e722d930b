#include "grammar/layout_printer.h"

#include "grammar/formatter.h"

namespace espalier {
namespace {

constexpr int kIndent = 2, kContinued = 4;

}  // namespace

void LayoutPrinter::file(const LayoutBody& body) {
  items(body, 0, true);
  comments_between(tokens_.size() - 1, 0, false);
}

void LayoutPrinter::items(const LayoutBody& body, int indent, bool one_a_line) {
  bool one_line = false;  // the item before took a single line, which can go on
  for (std::size_t i = 0; i < body.items.size(); ++i) {
    const LayoutItem& next = body.items[i];
    const bool beside = one_line && !one_a_line && stays_beside(body.items[i - 1], next, body.item_gap());
    if (!beside) {
      comments_between(next.first, indent, i == 0);
      begin_line(indent, tokens_[next.first].span.line, i == 0 && tokens_.comments_before(next.first).empty());
    }
    const std::size_t lines = page_.line_count();
    item(next, indent, body.item_gap());
    one_line = page_.line_count() == lines;
  }
}

/// Whether an item can go on the line of the one before it, where its author put it.
bool LayoutPrinter::stays_beside(const LayoutItem& before, const LayoutItem& item, int gap) const {
  if (tokens_[before.last - 1].span.line != tokens_[item.first].span.line) return false;
  if (!tokens_.comments_before(item.first).empty()) return false;
  const int room = kLongestLine - page_.column() - gap;
  if (item.flat_width) return *item.flat_width <= room;
  for (const LayoutPiece& piece : item.pieces)
    if (piece.body)
      return piece.first > item.first && !tokens_.has_comments(item.first, piece.first + 1) &&
             tokens_.width(item.first, piece.first + 1) <= room;
  return false;
}

void LayoutPrinter::item(const LayoutItem& item, int indent, int gap) {
  next_gap_ = page_.at_line_begin() ? 0 : gap;
  if (item.flat_width && page_.column() + next_gap_ + *item.flat_width <= kLongestLine) return flat(item);
  for (std::size_t i = 0; i < item.pieces.size(); ++i) piece(item, i, indent, item.flat_width.has_value());
}

/// `open_all`: the item is too long for one line, so all its bodies are opened.
void LayoutPrinter::piece(const LayoutItem& item, std::size_t i, int indent, bool open_all) {
  const LayoutPiece& p = item.pieces[i];
  const bool body_follows = i + 1 < item.pieces.size();
  if (!p.body) return run(item, p.first, p.last, indent, body_follows ? 2 : 0);
  if (p.first != item.first && comments_within(p.first, indent)) page_.begin_line(indent);
  const int gap = gap_before(p.first);
  const auto fits = [&] {
    return p.body->flat_width && page_.column() + gap + *p.body->flat_width + tail_width(item, i) <= kLongestLine;
  };
  const bool empty = p.body->flat_width && p.body->items.empty();
  if (empty || (!open_all && fits())) return flat(p);
  put(p.first);
  open_body(p, indent);
}

/// Columns that stand behind a body before the line can end: ` else {`.
int LayoutPrinter::tail_width(const LayoutItem& item, std::size_t i) const {
  if (i + 1 == item.pieces.size()) return 0;
  const LayoutPiece& next = item.pieces[i + 1];
  if (next.body) return 2;
  const int body = i + 2 < item.pieces.size() ? 2 : 0;
  return tokens_.gap(next.first) + tokens_.width(next.first, next.last) + body;
}

void LayoutPrinter::open_body(const LayoutPiece& piece, int indent) {
  items(*piece.body, indent + kIndent, piece.body->cases);
  const std::size_t close = piece.last - 1;
  comments_between(close, indent + kIndent, piece.body->items.empty());
  page_.begin_line(indent);
  put(close);
}

void LayoutPrinter::flat(const LayoutItem& item) {
  for (const LayoutPiece& piece : item.pieces) {
    if (piece.body) {
      flat(piece);
    } else {
      for (std::size_t i = piece.first; i < piece.last; ++i) put(i);
    }
  }
}

void LayoutPrinter::flat(const LayoutPiece& piece) {
  put(piece.first);
  for (std::size_t i = 0; i < piece.body->items.size(); ++i) {
    next_gap_ = i == 0 ? 1 : piece.body->item_gap();
    flat(piece.body->items[i]);
  }
  next_gap_ = 1;
  put(piece.last - 1);
}

/// Tokens of an item, with the comments between them. `reserve`: columns that stand behind them on the line.
void LayoutPrinter::run(const LayoutItem& item, std::size_t first, std::size_t last, int indent, int reserve) {
  for (std::size_t i = first; i < last;) {
    std::size_t end = i + 1;
    while (end < last && tokens_.comments_before(end).empty()) ++end;
    if (i != item.first && comments_within(i, indent + kContinued)) {
      const bool after_body = i == first && tokens_[i - 1].is("}");
      page_.begin_line(after_body ? indent : indent + kContinued);
    }
    segment(i, end, indent, end == last ? reserve : 0);
    i = end;
  }
}

void LayoutPrinter::segment(std::size_t first, std::size_t last, int indent, int reserve) {
  while (first < last) {
    const bool fits = page_.column() + gap_before(first) + tokens_.width(first, last) + reserve <= kLongestLine;
    const std::size_t end = fits ? last : break_point(first, last);
    for (std::size_t i = first; i < end; ++i) put(i);
    if (end < last) page_.begin_line(indent + kContinued);
    first = end;
  }
}

/// The token before which the line breaks: the least bad place that leaves the line short enough, the last of equals;
/// the first of all places where none does.
std::size_t LayoutPrinter::break_point(std::size_t first, std::size_t last) const {
  std::size_t best = last;
  for (std::size_t i = first + 1; i < last; ++i) {
    if (tokens_.break_rank(i) == 0) continue;
    const bool fits = page_.column() + 1 + tokens_.width(first, i) <= kLongestLine;
    if (best == last || (fits && tokens_.break_rank(i) <= tokens_.break_rank(best))) best = i;
    if (!fits) break;
  }
  return best;
}

/// Comments before an item, a closing brace or the end: at the end of the line above, or on lines of their own.
void LayoutPrinter::comments_between(std::size_t token, int indent, bool first_in_body) {
  for (const Comment& comment : tokens_.comments_before(token)) {
    if (!comment.own_line) {
      end_comment(comment);
      continue;
    }
    const bool goes_on = ending_ && ending_->span.line + 1 == comment.span.line &&
                         tokens_.source_column(*ending_) == tokens_.source_column(comment);
    if (goes_on) {
      page_.continue_comment(comment.text);
      ending_ = &comment;
    } else {
      begin_line(indent, comment.span.line, first_in_body);
      page_.put(comment.text, 0);
      ending_ = nullptr;
    }
    source_line_ = comment.span.line;
    first_in_body = false;
  }
}

/// Comments in the middle of an item. True where there were any: the line is over.
bool LayoutPrinter::comments_within(std::size_t token, int indent) {
  for (const Comment& comment : tokens_.comments_before(token)) {
    if (!comment.own_line) {
      end_comment(comment);
      continue;
    }
    page_.begin_line(indent);
    page_.put(comment.text, 0);
    source_line_ = comment.span.line;
  }
  return !tokens_.comments_before(token).empty();
}

void LayoutPrinter::end_comment(const Comment& comment) {
  page_.add_comment(comment.text, tokens_.source_column(comment));
  ending_ = &comment;
}

void LayoutPrinter::begin_line(int indent, std::uint32_t source_line, bool first_in_body) {
  page_.begin_line(indent, !first_in_body && source_line > source_line_ + 1);
}

int LayoutPrinter::gap_before(std::size_t token) const {
  if (page_.at_line_begin()) return 0;
  return next_gap_ >= 0 ? next_gap_ : tokens_.gap(token);
}

void LayoutPrinter::put(std::size_t token) {
  page_.put(tokens_.spelling(token), gap_before(token));
  source_line_ = tokens_[token].span.line;
  ending_ = nullptr;
  next_gap_ = -1;
}

}  // namespace espalier
