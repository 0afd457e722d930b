#pragma once
// What the checker makes of a grammar, as the page wants it: problems, symbols and attributes, with places counted in
// UTF-16 code units.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <studio_types.h>

#include "grammar/compiler.h"

namespace espalier::studio {

/// Offsets of bytes into a text in UTF-8 as offsets in UTF-16 code units.
class Utf16Offsets {
 public:
  explicit Utf16Offsets(std::string_view text);
  /// Beyond the end: the end.
  std::int64_t at(std::size_t byte) const { return units_[byte < units_.size() ? byte : units_.size() - 1]; }
  api::Place place(const SourceSpan& span) const { return {at(span.offset), at(std::size_t{span.offset} + span.length)}; }

 private:
  std::vector<std::uint32_t> units_;  // per byte, and of the end
};

struct CheckedText {
  std::vector<api::Problem> problems;
  std::vector<api::Symbol> symbols;         // also of a text with errors, as far as it can be read
  std::vector<api::Attribute> attributes;   // of a text without errors
  std::map<std::string, Kind> kinds;        // of these
  CompileResult compiled;
};

/// `attributes`: values as the language writes them; those that the text does not have are left out.
CheckedText check_text(const std::string& grammar, const std::map<std::string, std::string>& attributes,
                       const ReadImport& read_import);

/// Attributes of a grammar with their kinds, as far as its text can be read.
std::map<std::string, Kind> attribute_kinds(const CheckedGrammar& grammar);

/// The sentence that a text's first comment begins with, in one line; "" where it has none.
std::string first_sentence(std::string_view grammar);

}  // namespace espalier::studio
