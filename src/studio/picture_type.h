#pragma once
// Which kind of picture bytes are, by what they begin with.

#include <string_view>

namespace espalier::studio {

/// "image/png", "image/jpeg" or "image/webp"; "" for anything else.
std::string_view picture_type(std::string_view bytes);

}  // namespace espalier::studio
