#include "run/toml_section.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row.back();
}

std::string list_of(std::span<const std::string_view> names) {
  std::string result;
  for (const std::string_view name : names) result += fmt::format("{}\"{}\"", result.empty() ? "" : ", ", name);
  return result;
}

}  // namespace

std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  std::string best;
  std::size_t distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t d = edit_distance(word, candidate);
    if (d < distance) distance = d, best = candidate;
  }
  return best;
}

TomlSection::TomlSection(const TomlValue& table, std::string file, std::string path)
    : table_(table), file_(std::move(file)), path_(std::move(path)) {}

std::string TomlSection::path_of(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TomlSection::fail_at(const TomlValue& place, std::string_view key, const std::string& rule) const {
  if (place.line == 0) throw Error(fmt::format("{} (set on the command line): {} {}", file_, path_of(key), rule));
  throw Error(fmt::format("{}:{}:{}: {} {}", file_, place.line, place.column, path_of(key), rule));
}

void TomlSection::fail(std::string_view key, const std::string& rule) const {
  const TomlValue* value = table_.find(key);
  fail_at(value ? *value : table_, key, rule);
}

const TomlValue* TomlSection::member(std::string_view key) {
  known_.emplace_back(key);
  return table_.find(key);
}

double TomlSection::number_in(const TomlValue& value, std::string_view key, double low, double high) const {
  if (value.kind != TomlValue::Kind::real && value.kind != TomlValue::Kind::integer) {
    fail_at(value, key, fmt::format("must be a number, got {}", describe(value)));
  }
  const double number = value.kind == TomlValue::Kind::real ? value.real : static_cast<double>(value.integer);
  if (!std::isfinite(number) || number < low || number > high) {
    fail_at(value, key, fmt::format("must be a number from {} to {}, got {}", low, high, describe(value)));
  }
  return number;
}

std::uint64_t TomlSection::whole_in(const TomlValue& value, std::string_view key, std::uint64_t low,
                                    std::uint64_t high) const {
  const bool fits = value.kind == TomlValue::Kind::integer && value.integer >= 0 &&
                    static_cast<std::uint64_t>(value.integer) >= low &&
                    static_cast<std::uint64_t>(value.integer) <= high;
  if (!fits) {
    fail_at(value, key, fmt::format("must be a whole number from {} to {}, got {}", low, high, describe(value)));
  }
  return static_cast<std::uint64_t>(value.integer);
}

std::optional<double> TomlSection::number(std::string_view key, double low, double high) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  return number_in(*value, key, low, high);
}

std::optional<std::uint64_t> TomlSection::whole(std::string_view key, std::uint64_t low, std::uint64_t high) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  return whole_in(*value, key, low, high);
}

std::optional<bool> TomlSection::boolean(std::string_view key) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (value->kind != TomlValue::Kind::boolean) fail(key, "must be true or false, got " + describe(*value));
  return value->boolean;
}

std::optional<std::string> TomlSection::text(std::string_view key) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (value->kind != TomlValue::Kind::text) fail(key, "must be a text, got " + describe(*value));
  return value->text;
}

Vec3 TomlSection::vector_in(const TomlValue& value, std::string_view key, float low, float high,
                            std::string_view rule) const {
  if (value.kind != TomlValue::Kind::array || value.items.size() != 3) {
    fail_at(value, key, fmt::format("must be {}, got {}", rule, describe(value)));
  }
  Vec3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = static_cast<float>(number_in(value.items[static_cast<std::size_t>(i)], key, low, high));
  }
  return result;
}

std::optional<std::vector<Vec3>> TomlSection::vectors(std::string_view key, std::size_t count, float low, float high) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (value->kind != TomlValue::Kind::array || value->items.size() != count) {
    fail(key, fmt::format("must be a list of {} points [x, y, z], got {}", count, describe(*value)));
  }
  std::vector<Vec3> result;
  for (const TomlValue& item : value->items) result.push_back(vector_in(item, key, low, high, "points [x, y, z]"));
  return result;
}

std::optional<std::vector<double>> TomlSection::numbers(std::string_view key, std::size_t count, double low,
                                                        double high, bool spread) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (spread && (value->kind == TomlValue::Kind::integer || value->kind == TomlValue::Kind::real)) {
    return std::vector<double>(count, number_in(*value, key, low, high));
  }
  if (value->kind != TomlValue::Kind::array || value->items.size() != count) {
    fail(key, fmt::format("must be {}a list of {} numbers, got {}", spread ? "a number or " : "", count,
                          describe(*value)));
  }
  std::vector<double> result;
  for (const TomlValue& item : value->items) result.push_back(number_in(item, key, low, high));
  return result;
}

std::optional<Vec3> TomlSection::vector(std::string_view key, float low, float high, bool spread) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (spread && (value->kind == TomlValue::Kind::integer || value->kind == TomlValue::Kind::real)) {
    return Vec3(static_cast<float>(number_in(*value, key, low, high)));
  }
  return vector_in(*value, key, low, high, spread ? "a number or [x, y, z]" : "[x, y, z]");
}

std::optional<std::vector<std::uint64_t>> TomlSection::wholes(std::string_view key, std::size_t count,
                                                              std::uint64_t low, std::uint64_t high) {
  const TomlValue* value = member(key);
  if (!value) return std::nullopt;
  if (value->kind != TomlValue::Kind::array || value->items.size() != count) {
    fail(key, fmt::format("must be a list of {} whole numbers, got {}", count, describe(*value)));
  }
  std::vector<std::uint64_t> result;
  for (const TomlValue& item : value->items) result.push_back(whole_in(item, key, low, high));
  return result;
}

std::optional<std::size_t> TomlSection::choice_index(std::string_view key, std::span<const std::string_view> names) {
  const auto word = text(key);
  if (!word) return std::nullopt;
  const auto at = std::find(names.begin(), names.end(), *word);
  if (at == names.end()) fail(key, fmt::format("must be one of {}, got {}", list_of(names), quote_toml(*word)));
  return static_cast<std::size_t>(at - names.begin());
}

const TomlValue* TomlSection::table(std::string_view key) {
  const TomlValue* value = member(key);
  if (value && value->kind != TomlValue::Kind::table) fail(key, "must be a table, got " + describe(*value));
  return value;
}

const std::vector<TomlValue>* TomlSection::tables(std::string_view key) {
  const TomlValue* value = member(key);
  if (!value) return nullptr;
  const bool fits = value->kind == TomlValue::Kind::array &&
                    std::all_of(value->items.begin(), value->items.end(),
                                [](const TomlValue& item) { return item.kind == TomlValue::Kind::table; });
  if (!fits) {
    fail(key, fmt::format("must be a list of tables, written [[{}]], got {}", path_of(key), describe(*value)));
  }
  return &value->items;
}

void TomlSection::finish() const {
  for (const auto& [key, value] : table_.members) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string nearest = nearest_word(key, known_);
    fail_at(value, key, nearest.empty() ? "is no setting of a scene"
                                        : fmt::format("is no setting of a scene; did you mean {}?", path_of(nearest)));
  }
}

}  // namespace espalier
