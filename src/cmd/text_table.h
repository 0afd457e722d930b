#pragma once
// TextTable: rows of words in columns, for terminals.

#include <string>
#include <vector>

namespace espalier {

struct TextColumn {
  std::string head;
  bool right = false;  // numbers stand at the right
};

class TextTable {
 public:
  explicit TextTable(std::vector<TextColumn> columns) : columns_(std::move(columns)) {}

  /// As many cells as columns.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Lines of at most `width` characters, two spaces between columns; cells that do not fit in the last column, and
  /// names longer than a third of the width in the first, end in "...".
  std::string text(std::size_t width = 100) const;

 private:
  std::vector<TextColumn> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// At most `width` characters of a text, the last three of them "..." where something is cut.
std::string cut_to(const std::string& utf8, std::size_t width);

/// `first`, then the items with commas between, on as many lines as it takes; later lines are indented.
std::string listed(const std::string& first, const std::vector<std::string>& items, std::size_t width = 100);

}  // namespace espalier
