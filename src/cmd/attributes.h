#pragma once
// "-D name=value" as a map, and what setting attributes did to a derivation.

#include <map>
#include <string>
#include <vector>

#include "run/derivation_file.h"

namespace espalier {

/// Later ones win. Throws Error for a text without "=".
std::map<std::string, std::string> parse_attributes(const std::vector<std::string>& texts);

/// Says on the terminal what was cut and grown, if anything was.
void print_adapted(const AdaptedGenes& adapted);

}  // namespace espalier
