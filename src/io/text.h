#pragma once
// Text with numbers in it: every float as the shortest decimal that reads back to the same bits.

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace espalier {

/// A growing text or byte string with the few things that the writers append.
class TextBuffer {
 public:
  TextBuffer& operator<<(std::string_view s) {
    text_ += s;
    return *this;
  }
  TextBuffer& operator<<(float value) { return number(value + 0.0f); }  // -0 becomes 0
  TextBuffer& operator<<(std::uint32_t value) { return number(value); }
  TextBuffer& operator<<(std::uint64_t value) { return number(value); }
  /// Components with `between` between them.
  TextBuffer& vector(const Vec3& v, std::string_view between) {
    return *this << v.x << between << v.y << between << v.z;
  }
  /// The bytes of a number, little endian as the machine is.
  template <typename Number>
  TextBuffer& raw(Number value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text_.append(bytes, sizeof value);
    return *this;
  }
  TextBuffer& raw(const Vec3& v) { return raw(v.x).raw(v.y).raw(v.z); }

  std::size_t size() const { return text_.size(); }
  std::string& text() { return text_; }
  const std::string& text() const { return text_; }

 private:
  template <typename Number>
  TextBuffer& number(Number value) {
    char digits[40];
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
    text_.append(digits, end.ptr);
    return *this;
  }

  std::string text_;
};

}  // namespace espalier
