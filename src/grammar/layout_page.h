#pragma once
// The page that the formatter writes on: lines of code with comments at their ends. Comments that stood in one column
// in the source, on lines that follow each other, stand in one column again.

#include <string>
#include <string_view>
#include <vector>

namespace espalier {

class LayoutPage {
 public:
  /// Begins a line, after a blank one if asked.
  void begin_line(int indent, bool blank_before = false);
  /// Appends `gap` blanks and the text.
  void put(std::string_view text, int gap);
  /// Appends a comment behind the code of the line. `source_column`: where it stood.
  void add_comment(std::string_view text, int source_column);
  /// A line that goes on with the comment on the line before it.
  void continue_comment(std::string_view text);

  int column() const { return lines_.empty() ? 0 : lines_.back().width; }
  bool at_line_begin() const { return lines_.empty() || lines_.back().code.empty(); }
  std::size_t line_count() const { return lines_.size(); }

  /// The text, comments in their columns; every line ends with "\n".
  std::string finish();

 private:
  struct Line {
    int indent = 0;
    int width = 0;  // columns of indent and code
    bool blank_before = false;
    bool continues = false;   // `comment` goes on with the one above
    int source_column = -1;   // of `comment`, -1 where there is none
    std::string code;
    std::string_view comment;
  };

  std::vector<int> comment_columns() const;

  std::vector<Line> lines_;
};

}  // namespace espalier
