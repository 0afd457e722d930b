#pragma once
// "-D name=value" as a map.

#include <map>
#include <string>
#include <vector>

namespace espalier {

/// Later ones win. Throws Error for a text without "=".
std::map<std::string, std::string> parse_attributes(const std::vector<std::string>& texts);

}  // namespace espalier
