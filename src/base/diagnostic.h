#pragma once
// Diagnostics: what is wrong in a text, where, and what would help. Passes collect them and stop at their end, so a
// person sees many errors at once.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// A place in a source text: byte offset and length, and the 1-based line and column (in bytes) of its start.
struct SourceSpan {
  std::uint32_t offset = 0;
  std::uint32_t length = 0;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

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
/// All of them in source order, and a closing count.
std::string render(const Diagnostics& diagnostics, std::string_view file_name, std::string_view source);

}  // namespace espalier
