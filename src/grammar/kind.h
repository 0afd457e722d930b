#pragma once
// Kind: what sort of value an expression has. Two scalars are kept apart (number, angle); mixing them is an error.

#include <cstdint>
#include <string_view>

namespace espalier {

enum class Kind : std::uint8_t { number, angle, vector, boolean, text, mesh, material, texture };

/// "number", "angle", ...
std::string_view name_of(Kind kind);
/// "a number", "an angle", ...
std::string_view phrase_of(Kind kind);

/// How many registers a value takes: 3 for a vector, else 1.
inline int components_of(Kind kind) { return kind == Kind::vector ? 3 : 1; }

}  // namespace espalier
