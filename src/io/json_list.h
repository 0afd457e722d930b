#pragma once
// JsonList: a list of JSON objects in the making.

#include <cstdint>
#include <string>

#include "io/text.h"

namespace espalier {

class JsonList {
 public:
  TextBuffer& next() { return text_ << (size_++ > 0 ? "," : ""); }
  std::uint32_t size() const { return size_; }
  const std::string& text() const { return text_.text(); }

 private:
  TextBuffer text_;
  std::uint32_t size_ = 0;
};

/// As a JSON string, in ASCII.
std::string quoted(const std::string& text);

}  // namespace espalier
