#include "grammar/lsystem_statements.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Where a comment begins in a line, or its length: `#` and `//` with a blank or nothing before them, and for `//` also
/// behind, because `//` is two rolls. `#define` is none.
std::size_t comment_begin(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && !is_blank(line[i - 1])) continue;
    if (line[i] == '#' && line.substr(i, 8) != "#define ") return i;
    if (line.substr(i, 2) == "//" && (i + 2 == line.size() || is_blank(line[i + 2]) || i == 0)) return i;
  }
  return line.size();
}

bool begins_statement(std::string_view line) {
  return !is_blank(line[0]) || line.find("->") != std::string_view::npos || line.find('=') != std::string_view::npos;
}

}  // namespace

std::vector<Statement> statements(std::string_view source) {
  std::vector<Statement> result;
  std::uint32_t number = 0;
  for (std::size_t begin = 0; begin < source.size();) {
    const std::size_t end = std::min(source.find('\n', begin), source.size());
    std::string line(source.substr(begin, end - begin));
    ++number;
    const std::size_t comment = comment_begin(line);
    std::fill(line.begin() + static_cast<long>(comment), line.end(), ' ');
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos) {
      if (!result.empty() && !begins_statement(line)) {
        Statement& last = result.back();  // the blanked lines between keep places right
        last.text.resize(begin - last.span.offset - 1, '\n');
        last.text += "\n" + line;
      } else {
        result.push_back(
            {line.substr(first),
             {static_cast<std::uint32_t>(begin + first), 1, number, static_cast<std::uint32_t>(first + 1)}});
      }
    }
    begin = end + 1;
  }
  return result;
}

}  // namespace espalier::lsystem
