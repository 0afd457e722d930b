#include "base/printable.h"

#include <cstddef>

namespace espalier {
namespace {

/// Bytes of the UTF-8 character that the text begins with; 0: it is none, or a control character.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const unsigned char second = byte(1);
  // Control characters above ASCII, forms longer than needed, surrogates, what is beyond the last character.
  if (first == 0xc2 && second < 0xa0) return 0;
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90)) return 0;
  return size;
}

}  // namespace

std::string printable(std::string_view text, bool lines) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const std::size_t size = lines && text[0] == '\n' ? 1 : printable_bytes(text);
    if (size > 0) {
      result += text.substr(0, size);
    } else {
      const auto value = static_cast<unsigned char>(text[0]);
      result += {'\\', 'x', kDigits[value >> 4], kDigits[value & 15]};
    }
    text.remove_prefix(size > 0 ? size : 1);
  }
  return result;
}

}  // namespace espalier
