#pragma once
// A TOML document as plain values that know their place, so that only one source file sees the parser. Tables keep the
// order of the text.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace espalier {

struct TomlValue {
  enum class Kind : std::uint8_t { boolean, integer, real, text, array, table, other };

  Kind kind = Kind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<TomlValue> items;                            // array
  std::vector<std::pair<std::string, TomlValue>> members;  // table
  std::uint32_t line = 0, column = 0;  // 1-based; 0 = not from the file but from the command line

  /// Null if this is no table or has no such member.
  const TomlValue* find(std::string_view key) const;
};

/// "true", "whole number", "number", "text", "list", "table" ...: for messages.
std::string_view name_of(TomlValue::Kind kind);
/// The value as one would write it, shortened: for messages.
std::string describe(const TomlValue& value);

/// Parses a whole document. Throws Error "NAME:LINE:COLUMN: ..." for anything that is not TOML in UTF-8.
TomlValue parse_toml(std::string_view text, const std::string& name);

/// Applies "dotted.key=value", as given on the command line. Array elements are named by index ("volume.mesh.0.file");
/// the index after the last one appends. The value is read as TOML and, where that fails, taken as text. Throws Error.
void apply_setting(TomlValue& root, std::string_view setting);

/// A TOML string literal, quoted and escaped.
std::string quote_toml(std::string_view text);
/// A number that reads back as the same double; always with a point or exponent.
std::string format_toml(double value);
/// "[x, y, z]", through float's own shortest form, so that 0.1f reads 0.1 and comes back as the same float.
std::string format_vector(const Vec3& v);

}  // namespace espalier
