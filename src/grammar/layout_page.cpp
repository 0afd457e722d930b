#include "grammar/layout_page.h"

#include <algorithm>

#include "grammar/layout_tokens.h"

namespace espalier {

void LayoutPage::begin_line(int indent, bool blank_before) {
  Line line;
  line.indent = line.width = indent;
  line.blank_before = blank_before && !lines_.empty();
  lines_.push_back(std::move(line));
}

void LayoutPage::put(std::string_view text, int gap) {
  Line& line = lines_.back();
  line.code.append(static_cast<std::size_t>(gap), ' ').append(text);
  line.width += gap + columns(text);
}

void LayoutPage::add_comment(std::string_view text, int source_column) {
  lines_.back().comment = text;
  lines_.back().source_column = source_column;
}

void LayoutPage::continue_comment(std::string_view text) {
  const int column = lines_.back().source_column;
  begin_line(0);
  lines_.back().continues = true;
  add_comment(text, column);
}

/// Two blanks behind the longest line of those whose comments stood in one column, without a blank line, a comment on
/// its own or another column between them.
std::vector<int> LayoutPage::comment_columns() const {
  std::vector<int> result(lines_.size(), 0);
  std::size_t first = 0;  // of the group
  int wanted = 0;
  const auto close = [&](std::size_t last) {
    std::fill(result.begin() + static_cast<long>(first), result.begin() + static_cast<long>(last), wanted);
    first = last;
    wanted = 0;
  };
  int column = -1;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    const bool own_comment = line.source_column < 0 && line.code.starts_with('#');
    const bool other_column = line.source_column >= 0 && column >= 0 && line.source_column != column;
    if (line.blank_before || own_comment || other_column) close(i), column = -1;
    if (line.source_column < 0) continue;
    column = line.source_column;
    if (!line.continues) wanted = std::max(wanted, line.width + 2);
  }
  close(lines_.size());
  return result;
}

std::string LayoutPage::finish() {
  const std::vector<int> wanted = comment_columns();
  std::string text;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    if (line.blank_before) text += '\n';
    if (!line.code.empty()) text.append(static_cast<std::size_t>(line.indent), ' ').append(line.code);
    if (line.source_column >= 0) {
      const int from = line.code.empty() ? 0 : line.width;
      text.append(static_cast<std::size_t>(wanted[i] - from), ' ').append(line.comment);
    }
    text += '\n';
  }
  return text;
}

}  // namespace espalier
