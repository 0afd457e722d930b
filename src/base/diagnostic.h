#pragma once
// Diagnostics: what is wrong in a text, where, and what would help. Passes collect them and stop at their end, so a
// person sees many errors at once.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// A text and the name by which messages call it.
struct SourceText {
  std::string name, text;
};

/// A place in a source text: byte offset and length, and the 1-based line and column (in bytes) of its start. Line 0:
/// no place. `file` tells the texts of one grammar apart: 0 is the grammar itself, others are imported.
struct SourceSpan {
  std::uint32_t offset = 0;
  std::uint32_t length = 0;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint16_t file = 0;
};

/// "line 3", or "line 3 of parts.esp" for a place in another file than `from`. `files`: names by SourceSpan::file.
std::string line_of(const SourceSpan& place, const SourceSpan& from, std::span<const std::string> files);

enum class Severity : std::uint8_t { error, warning };

/// One finding. `code` is stable ("E0203"); `message` states the rule broken and the value; `help` may be empty.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;
  std::string message;
  SourceSpan span;
  std::string help;
};

class Diagnostics {
 public:
  /// At most this many errors are kept; later ones are only counted.
  static constexpr std::size_t kMostErrors = 50;

  void error(std::string code, const SourceSpan& span, std::string message, std::string help = {});
  void warning(std::string code, const SourceSpan& span, std::string message, std::string help = {});

  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  const std::vector<Diagnostic>& items() const { return items_; }

 private:
  std::vector<Diagnostic> items_;
  std::size_t errors_ = 0;
};

/// "file:line:column: error[E0203]: message", the source line, a caret under the span, the help. Ends with a newline.
std::string render(const Diagnostic& diagnostic, std::string_view file_name, std::string_view source);
/// All of them in source order, and a closing count. `sources`: by SourceSpan::file.
std::string render(const Diagnostics& diagnostics, std::span<const SourceText> sources);
/// Of a single text.
std::string render(const Diagnostics& diagnostics, std::string_view file_name, std::string_view source);

}  // namespace espalier
