#pragma once
// A piece of a grammar's text for people to read.

#include <string>
#include <string_view>

namespace espalier {

/// In one line, without comments; what stands in quotes stays as it is. Texts end with their line, also where the
/// closing quote is missing.
std::string in_one_line(std::string_view text);

}  // namespace espalier
