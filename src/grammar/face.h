#pragma once
// Faces of the scope box, in the order in which `comp` visits them (language.md, `comp`).

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace espalier {

/// front looks along +z, back -z, right +x, left -x, top +y, bottom -y.
enum class Face : std::uint8_t { front, back, right, left, top, bottom };

inline constexpr int kFaces = 6;

/// Bit f is set where the word names face f; nothing for words that name none.
constexpr std::optional<std::uint8_t> faces_named(std::string_view word) {
  constexpr std::array<std::string_view, kFaces> kNames = {"front", "back", "right", "left", "top", "bottom"};
  for (int f = 0; f < kFaces; ++f)
    if (word == kNames[f]) return static_cast<std::uint8_t>(1u << f);
  if (word == "sides") return std::uint8_t{0b001111};
  if (word == "all") return std::uint8_t{0b111111};
  return std::nullopt;
}

}  // namespace espalier
