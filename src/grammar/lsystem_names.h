#pragma once
// Names for what an importer writes: none is a word of the language, none is taken twice. Private to the importer.

#include <set>
#include <string>
#include <string_view>

#include "grammar/words.h"

namespace espalier::lsystem {

class NameTable {
 public:
  /// `wanted`, with as many `_` behind it as it takes.
  std::string claim(std::string_view wanted) {
    std::string name(wanted);
    while (is_reserved(name) || taken_.contains(name)) name += '_';
    taken_.insert(name);
    return name;
  }

 private:
  std::set<std::string, std::less<>> taken_;
};

}  // namespace espalier::lsystem
