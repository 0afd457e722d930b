#pragma once
// The words of the language: keywords, axes, and the built-in values, distributions, functions, primitives. All are
// reserved: no declaration, draw, let or parameter may take them.

#include <cstdint>
#include <span>
#include <string_view>

namespace espalier {

enum class BuiltinSort : std::uint8_t {
  value,         // scope, depth, childless
  distribution,  // right of `~`
  function,
  primitive,     // a mesh, with or without arguments
  surface,
  texture,
};

/// What may be called, and with how many arguments. `labels`: names that arguments may carry, in their order,
/// space-separated ("top sides").
struct Builtin {
  std::string_view name;
  BuiltinSort sort;
  int fewest = 0;
  int most = 0;
  std::string_view labels = {};
};

std::span<const Builtin> builtins();
/// Null where there is none of that name.
const Builtin* find_builtin(std::string_view name);
bool is_keyword(std::string_view word);
bool is_axis(std::string_view word);
/// Keyword, axis or built-in.
bool is_reserved(std::string_view word);

/// The words that may begin a statement or a declaration (names aside).
std::span<const std::string_view> statement_words();
std::span<const std::string_view> declaration_words();

}  // namespace espalier
