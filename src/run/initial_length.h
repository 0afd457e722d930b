#pragma once
// The setting `initial_length` of every engine as TOML: one number of genes, or [from, to].

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "run/toml_section.h"

namespace espalier {

inline void read_initial_length(TomlSection& s, std::uint32_t& shortest, std::uint32_t& longest) {
  const TomlValue* value = s.member("initial_length");
  if (!value) return;
  if (value->kind == TomlValue::Kind::array) {
    const auto range = *s.wholes("initial_length", 2, 1, 1'000'000);
    shortest = static_cast<std::uint32_t>(range[0]);
    longest = static_cast<std::uint32_t>(range[1]);
  } else {
    shortest = longest = static_cast<std::uint32_t>(*s.whole("initial_length", 1, 1'000'000));
  }
}

inline std::string initial_length_line(std::uint32_t shortest, std::uint32_t longest) {
  return shortest == longest ? fmt::format("initial_length = {}\n", shortest)
                             : fmt::format("initial_length = [{}, {}]\n", shortest, longest);
}

}  // namespace espalier
