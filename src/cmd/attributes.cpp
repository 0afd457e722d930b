#include "cmd/attributes.h"

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {

std::map<std::string, std::string> parse_attributes(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> result;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw Error(fmt::format("-D must be NAME=VALUE, got \"{}\"", text));
    result[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return result;
}

void print_adapted(const AdaptedGenes& adapted) {
  if (adapted.cut + adapted.grown == 0) return;
  fmt::print(stderr, "note: with these attributes {} genes cannot stand and are left out, {} new ones are required\n",
             adapted.cut, adapted.grown);
}

}  // namespace espalier
