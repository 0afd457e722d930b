#pragma once
// Numbers of things in messages: "1 rule", "3 rules".

#include <cstddef>
#include <string>

namespace espalier {

/// `noun`: in the singular, of those that take an s.
inline std::string counted(std::size_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace espalier
