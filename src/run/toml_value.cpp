#include "run/toml_value.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/error.h"

namespace espalier {
namespace {

constexpr int kMostDepth = 32;

TomlValue convert(const toml::node& node, int depth) {
  if (depth > kMostDepth) throw Error(fmt::format("tables must not be nested deeper than {}", kMostDepth));
  TomlValue value;
  value.kind = TomlValue::Kind::other;
  value.line = node.source().begin.line;
  value.column = node.source().begin.column;
  if (const auto* b = node.as_boolean()) {
    value.kind = TomlValue::Kind::boolean;
    value.boolean = b->get();
  } else if (const auto* i = node.as_integer()) {
    value.kind = TomlValue::Kind::integer;
    value.integer = i->get();
  } else if (const auto* f = node.as_floating_point()) {
    value.kind = TomlValue::Kind::real;
    value.real = f->get();
  } else if (const auto* s = node.as_string()) {
    value.kind = TomlValue::Kind::text;
    value.text = s->get();
  } else if (const auto* array = node.as_array()) {
    value.kind = TomlValue::Kind::array;
    for (const toml::node& item : *array) value.items.push_back(convert(item, depth + 1));
  } else if (const auto* table = node.as_table()) {
    value.kind = TomlValue::Kind::table;
    for (const auto& [key, item] : *table) value.members.emplace_back(std::string(key), convert(item, depth + 1));
    // toml++ sorts by key; the order of the text is what a person sees.
    std::stable_sort(value.members.begin(), value.members.end(), [](const auto& one, const auto& two) {
      return std::pair(one.second.line, one.second.column) < std::pair(two.second.line, two.second.column);
    });
  }
  return value;
}

void forget_places(TomlValue& value) {
  value.line = value.column = 0;
  for (TomlValue& item : value.items) forget_places(item);
  for (auto& [key, member] : value.members) forget_places(member);
}

// The value of a setting: TOML if it is, else the text itself, so that paths and names need no quotes.
TomlValue parse_setting_value(std::string_view text) {
  TomlValue value;
  try {
    const toml::table document = toml::parse("v = " + std::string(text) + "\n");
    if (document.size() == 1) {
      value = convert(*document.get("v"), 0);
      forget_places(value);
      return value;
    }
  } catch (const toml::parse_error&) {
  }
  value.kind = TomlValue::Kind::text;
  value.text = text;
  return value;
}

TomlValue& member_of(TomlValue& table, const std::string& key) {
  for (auto& [name, value] : table.members) {
    if (name == key) return value;
  }
  TomlValue fresh;
  table.members.emplace_back(key, fresh);
  return table.members.back().second;
}

TomlValue& item_of(TomlValue& array, const std::string& key, std::string_view setting) {
  const bool digits = !key.empty() && key.size() < 10 && key.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t index = digits ? std::stoul(key) : array.items.size() + 1;
  if (index > array.items.size()) {
    throw Error(fmt::format("--set {}: \"{}\" must be an index from 0 to {} here", setting, key, array.items.size()));
  }
  if (index == array.items.size()) array.items.emplace_back();
  return array.items[index];
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  for (const auto& [name, value] : members) {
    if (name == key) return &value;
  }
  return nullptr;
}

std::string_view name_of(TomlValue::Kind kind) {
  switch (kind) {
    case TomlValue::Kind::boolean: return "true or false";
    case TomlValue::Kind::integer: return "a whole number";
    case TomlValue::Kind::real: return "a number";
    case TomlValue::Kind::text: return "a text";
    case TomlValue::Kind::array: return "a list";
    case TomlValue::Kind::table: return "a table";
    case TomlValue::Kind::other: break;
  }
  return "a date or time";
}

std::string describe(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean: return value.boolean ? "true" : "false";
    case TomlValue::Kind::integer: return fmt::format("{}", value.integer);
    case TomlValue::Kind::real: return fmt::format("{}", value.real);
    case TomlValue::Kind::text:
      return quote_toml(value.text.size() > 60 ? value.text.substr(0, 60) + "..." : value.text);
    case TomlValue::Kind::array: return fmt::format("a list of {}", value.items.size());
    default: return std::string(name_of(value.kind));
  }
}

TomlValue parse_toml(std::string_view text, const std::string& name) {
  try {
    TomlValue root = convert(toml::parse(text, name), 0);
    root.line = root.column = 1;
    return root;
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw Error(fmt::format("{}:{}:{}: {}", name, at.line, at.column, error.description()));
  }
}

void apply_setting(TomlValue& root, std::string_view setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw Error(fmt::format("--set must be KEY=VALUE, got \"{}\"", setting));
  }
  TomlValue* place = &root;
  std::string_view rest = setting.substr(0, equals);
  while (true) {
    const std::size_t dot = rest.find('.');
    const std::string key(rest.substr(0, dot));
    if (key.empty()) throw Error(fmt::format("--set {}: a key between dots is empty", setting));
    if (place->kind == TomlValue::Kind::array) {
      place = &item_of(*place, key, setting);
    } else if (place->kind == TomlValue::Kind::table) {
      // A first element may be set where there is no list yet.
      if (key == "0" && place->members.empty() && place != &root) {
        place->kind = TomlValue::Kind::array;
        place = &item_of(*place, key, setting);
      } else {
        place = &member_of(*place, key);
      }
    } else {
      throw Error(fmt::format("--set {}: there is nothing below {}, which is {}", setting, describe(*place),
                              name_of(place->kind)));
    }
    if (dot == std::string_view::npos) break;
    rest.remove_prefix(dot + 1);
  }
  *place = parse_setting_value(setting.substr(equals + 1));
}

std::string quote_toml(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string format_toml(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string format_vector(const Vec3& v) {
  const auto number = [](float x) {
    const std::string text = fmt::format("{}", x);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  };
  return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
}

}  // namespace espalier
