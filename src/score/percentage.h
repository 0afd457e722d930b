#pragma once
// Shares in words.

#include <string>

namespace espalier {

/// "81 %"; "<1 %" for less than half a percent of something, "0 %" for nothing or of nothing.
std::string percentage(double part, double of);

}  // namespace espalier
