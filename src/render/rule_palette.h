#pragma once
// Colours that people with any colour vision can tell apart (Okabe and Ito, 2008), and names of draws for pictures.

#include <array>
#include <cstddef>
#include <string_view>

namespace espalier {

inline constexpr std::array<const char*, 8> kRuleColors = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                          "#56b4e9", "#d55e00", "#7a6f00", "#555b66"};
/// Rules beyond the colours share them and differ by shape: circle, square, diamond, triangle.
inline constexpr std::size_t kRuleShapes = 4;

/// "k" of "Body.k.x" or "Body.k[0]".
inline std::string_view draw_base(std::string_view component) {
  const std::size_t dot = component.find('.');
  if (dot != std::string_view::npos) component.remove_prefix(dot + 1);
  return component.substr(0, component.find_first_of(".["));
}

}  // namespace espalier
