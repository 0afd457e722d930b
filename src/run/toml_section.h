#pragma once
// TomlSection: reads the members of one table with their rules. A member of the wrong kind or range, and at the end any
// member that nobody asked for, is an Error that names file, place, key, rule and value.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "run/toml_value.h"

namespace espalier {

/// A name that a person may write for a value of an enum.
template <typename T>
struct Choice {
  std::string_view name;
  T value;
};

class TomlSection {
 public:
  /// `table` must outlive it. `path` is the dotted key of the table, empty for the document.
  TomlSection(const TomlValue& table, std::string file, std::string path);

  /// Each returns nothing when the key is absent; numbers must be finite and lie in [low, high].
  std::optional<double> number(std::string_view key, double low, double high);
  std::optional<std::uint64_t> whole(std::string_view key, std::uint64_t low, std::uint64_t high);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  /// One number spreads where `spread`.
  std::optional<Vec3> vector(std::string_view key, float low, float high, bool spread = false);
  /// Exactly `count` whole numbers.
  std::optional<std::vector<std::uint64_t>> wholes(std::string_view key, std::size_t count, std::uint64_t low,
                                                   std::uint64_t high);
  /// Exactly `count` numbers. One spreads where `spread`.
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count, double low, double high,
                                             bool spread = false);
  /// Exactly `count` points.
  std::optional<std::vector<Vec3>> vectors(std::string_view key, std::size_t count, float low, float high);
  template <typename T, std::size_t N>
  std::optional<T> choice(std::string_view key, const Choice<T> (&choices)[N]) {
    std::vector<std::string_view> names;
    for (const Choice<T>& c : choices) names.push_back(c.name);
    const auto index = choice_index(key, names);
    return index ? std::optional<T>(choices[*index].value) : std::nullopt;
  }
  /// Null when absent; Error when no table, or no list of tables.
  const TomlValue* table(std::string_view key);
  const std::vector<TomlValue>* tables(std::string_view key);
  /// The raw member, marked as known.
  const TomlValue* member(std::string_view key);

  /// Throws Error for the first member that nobody asked for, with the nearest known key.
  void finish() const;
  /// Throws Error at the place of `key` (or of the table): "FILE:LINE:COLUMN: KEY RULE".
  [[noreturn]] void fail(std::string_view key, const std::string& rule) const;

  std::string path_of(std::string_view key) const;
  const std::string& file() const { return file_; }

 private:
  std::optional<std::size_t> choice_index(std::string_view key, std::span<const std::string_view> names);
  Vec3 vector_in(const TomlValue& value, std::string_view key, float low, float high, std::string_view rule) const;
  double number_in(const TomlValue& value, std::string_view key, double low, double high) const;
  std::uint64_t whole_in(const TomlValue& value, std::string_view key, std::uint64_t low, std::uint64_t high) const;
  [[noreturn]] void fail_at(const TomlValue& place, std::string_view key, const std::string& rule) const;

  const TomlValue& table_;
  std::string file_, path_;
  std::vector<std::string> known_;
};

/// What was given replaces what is there.
template <typename T, typename U>
void take(T& place, const std::optional<U>& value) {
  if (value) place = static_cast<T>(*value);
}

/// The nearest of `known` to `word` by edit distance, if it is near enough to be meant; else empty.
std::string nearest_word(std::string_view word, std::span<const std::string> known);

}  // namespace espalier
