#include "grammar/one_line.h"

namespace espalier {

std::string in_one_line(std::string_view text) {
  std::string words;
  bool comment = false, gap = false, quoted = false;
  for (const char c : text) {
    if (c == '\n') comment = quoted = false;
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

}  // namespace espalier
