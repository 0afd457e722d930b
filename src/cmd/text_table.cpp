#include "cmd/text_table.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {
namespace {

std::size_t characters(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

std::string cut_to(const std::string& utf8, std::size_t width) {
  if (characters(utf8) <= width) return utf8;
  std::string kept;
  std::size_t count = 0;
  for (const char c : utf8) {
    if ((c & 0xc0) != 0x80 && ++count + 3 > width) break;
    kept += c;
  }
  return kept + "...";
}

std::string listed(const std::string& first, const std::vector<std::string>& items, std::size_t width) {
  std::string text = first;
  std::size_t used = characters(first);
  for (const std::string& item : items) {
    const std::string word = cut_to(item, width - 4) + (&item == &items.back() ? "" : ",");
    const bool over = used + 1 + characters(word) > width;
    text += (over ? "\n  " : " ") + word;
    used = (over ? 2 : used + 1) + characters(word);
  }
  return text + "\n";
}

std::string TextTable::text(std::size_t width) const {
  std::vector<std::vector<std::string>> lines;
  lines.emplace_back();
  for (const TextColumn& column : columns_) lines.back().push_back(column.head);
  lines.insert(lines.end(), rows_.begin(), rows_.end());
  std::vector<std::size_t> widths(columns_.size(), 0);
  std::size_t used = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const bool last = c + 1 == columns_.size();
    const std::size_t room = last ? std::max<std::size_t>(width - std::min(used, width), 8) : width;
    for (std::vector<std::string>& line : lines) {
      CHECK(line.size() == columns_.size());
      line[c] = cut_to(line[c], c == 0 ? width / 3 : room);
      widths[c] = std::max(widths[c], characters(line[c]));
    }
    used += widths[c] + 2;
  }
  std::string out;
  for (const std::vector<std::string>& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string pad(widths[c] - characters(line[c]), ' ');
      row += (c > 0 ? "  " : "") + (columns_[c].right ? pad + line[c] : line[c] + pad);
    }
    row.resize(row.find_last_not_of(' ') + 1);
    out += row + "\n";
  }
  return out;
}

}  // namespace espalier
