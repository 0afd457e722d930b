#include "grammar/lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/core.h>

namespace espalier {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word_char(char c) { return is_letter(c) || is_digit(c); }

/// Bytes of the UTF-8 sequence at the front of `text` (not empty); 0 where it is not well formed.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned b0 = byte(0);
  if (b0 < 0x80) return 1;
  const std::size_t length = b0 >= 0xf0 ? 4 : b0 >= 0xe0 ? 3 : 2;
  if (b0 < 0xc2 || b0 > 0xf4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const unsigned b1 = byte(1);
  const bool overlong = (b0 == 0xe0 && b1 < 0xa0) || (b0 == 0xf0 && b1 < 0x90);
  const bool out_of_range = (b0 == 0xed && b1 > 0x9f) || (b0 == 0xf4 && b1 > 0x8f);
  return overlong || out_of_range ? 0 : length;
}

class Lexer {
 public:
  Lexer(std::string_view source, Diagnostics& diagnostics, std::uint16_t file, std::vector<Comment>* comments)
      : source_(source), diagnostics_(diagnostics), file_(file), comments_(comments) {
    if (source_.starts_with("\xef\xbb\xbf")) line_start_ = at_ = 3;
  }

  std::vector<Token> run() {
    tokens_.reserve(source_.size() / 4);
    while (skip_blanks(), at_ < source_.size()) {
      if (diagnostics_.error_count() >= Diagnostics::kMostErrors) break;
      scan();
    }
    tokens_.push_back({TokenKind::end, {}, span(at_, 0)});
    return std::move(tokens_);
  }

 private:
  SourceSpan span(std::size_t begin, std::size_t length) const {
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(length), line_,
            static_cast<std::uint32_t>(begin - line_start_ + 1), file_};
  }
  char peek(std::size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }

  void skip_blanks() {
    for (; at_ < source_.size(); ++at_) {
      const char c = source_[at_];
      if (c == '#') skip_comment();
      if (at_ == source_.size()) return;
      if (source_[at_] == '\n') {
        ++line_;
        line_start_ = static_cast<std::uint32_t>(at_ + 1);
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }

  void skip_comment() {
    const std::size_t end = std::min(source_.find('\n', at_), source_.size());
    if (comments_) {
      std::string_view text = source_.substr(at_, end - at_);
      while (text.find_last_of(" \t\r") == text.size() - 1) text.remove_suffix(1);
      const bool own_line = tokens_.empty() || tokens_.back().span.line != line_;
      comments_->push_back({text, span(at_, text.size()), own_line, tokens_.size()});
    }
    at_ = end;
  }

  void scan() {
    const char c = peek();
    if (is_letter(c)) return scan_word();
    if (is_digit(c)) return scan_number();
    if (c == '"') return scan_text();
    scan_symbol();
  }

  void push(TokenKind kind, std::size_t length) {
    tokens_.push_back({kind, source_.substr(at_, length), span(at_, length)});
    at_ += length;
  }

  void scan_word() {
    std::size_t length = 1;
    while (is_word_char(peek(length))) ++length;
    push(TokenKind::word, length);
  }

  /// digits [ "." digits ] [ exponent ] [ unit ]; `0..1` is a range, so a dot needs a digit behind it.
  void scan_number() {
    std::size_t length = digits_from(0);
    if (peek(length) == '.' && is_digit(peek(length + 1))) length = digits_from(length + 1);
    if (peek(length) == 'e' || peek(length) == 'E') {
      const std::size_t sign = peek(length + 1) == '+' || peek(length + 1) == '-' ? 1 : 0;
      if (is_digit(peek(length + 1 + sign))) length = digits_from(length + 1 + sign);
    }
    const std::string_view digits = source_.substr(at_, length);
    std::size_t unit_length = 0;
    while (is_word_char(peek(length + unit_length))) ++unit_length;
    if (unit_length == 0 && peek(length) == '%') unit_length = 1;
    const std::string_view unit_text = source_.substr(at_ + length, unit_length);

    Token token{TokenKind::number, source_.substr(at_, length + unit_length), span(at_, length + unit_length)};
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), token.value);
    if (fault != std::errc() &&
        !(std::isfinite(token.value) && fault == std::errc::result_out_of_range && underflows(digits)))
      diagnostics_.error("E0103", token.span, fmt::format("the number {} is too large", shorten(digits)));
    if (!unit_from(unit_text, token.unit))
      diagnostics_.error("E0103", span(at_ + length, unit_length),
                         fmt::format("a number's unit is deg, rad, m, cm, mm or %, not `{}`", shorten(unit_text)),
                         "leave a space between a number and a name");
    at_ += length + unit_length;
    tokens_.push_back(token);
  }

  std::size_t digits_from(std::size_t length) const {
    while (is_digit(peek(length))) ++length;
    return length;
  }

  /// Numbers too small for a double read as 0, with a negative exponent as the only way to get there.
  static bool underflows(std::string_view digits) {
    return digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
  }

  static std::string shorten(std::string_view text) {
    return text.size() <= 24 ? std::string(text) : fmt::format("{}...", text.substr(0, 24));
  }

  static bool unit_from(std::string_view text, ast::Unit& unit) {
    using enum ast::Unit;
    constexpr std::array<std::pair<std::string_view, ast::Unit>, 7> kUnits = {{{"", none},
                                                                               {"deg", degrees},
                                                                               {"rad", radians},
                                                                               {"m", metres},
                                                                               {"cm", centimetres},
                                                                               {"mm", millimetres},
                                                                               {"%", percent}}};
    for (const auto& [name, value] : kUnits) {
      if (name != text) continue;
      unit = value;
      return true;
    }
    return false;
  }

  void scan_text() {
    std::size_t length = 1;
    while (at_ + length < source_.size() && peek(length) != '"' && peek(length) != '\n') {
      const std::size_t bytes = utf8_length(source_.substr(at_ + length));
      const bool control = static_cast<unsigned char>(peek(length)) < ' ' || peek(length) == '\x7f';
      if (bytes == 0 || control) {
        diagnostics_.error("E0104", span(at_ + length, 1),
                           fmt::format("a text is UTF-8 without control characters, not byte 0x{:02x}",
                                       static_cast<unsigned char>(peek(length))));
        while (at_ + length < source_.size() && peek(length) != '"' && peek(length) != '\n') ++length;
        break;
      }
      length += bytes;
    }
    const bool closed = peek(length) == '"' && at_ + length < source_.size();
    if (!closed) diagnostics_.error("E0102", span(at_, length), "a text ends with `\"` on the line where it began");
    tokens_.push_back({TokenKind::text, source_.substr(at_ + 1, length - 1), span(at_, length + (closed ? 1 : 0))});
    at_ += length + (closed ? 1 : 0);
  }

  void scan_symbol() {
    constexpr std::array<std::string_view, 6> kPairs = {"..", "<=", ">=", "==", "!=", "->"};
    constexpr std::string_view kSingles = "{}()[],:.~=?+-*/^<>";
    const std::string_view pair = source_.substr(at_, 2);
    if (std::find(kPairs.begin(), kPairs.end(), pair) != kPairs.end()) return push(TokenKind::symbol, 2);
    if (kSingles.find(peek()) != std::string_view::npos && peek() != '\0') return push(TokenKind::symbol, 1);
    report_stray();
  }

  void report_stray() {
    const char c = peek();
    const std::size_t bytes = std::max<std::size_t>(1, utf8_length(source_.substr(at_)));
    const std::string shown = static_cast<unsigned char>(c) < ' ' || c == '\x7f' || (bytes == 1 && (c & 0x80))
                                  ? fmt::format("byte 0x{:02x}", static_cast<unsigned char>(c))
                                  : fmt::format("`{}`", source_.substr(at_, bytes));
    std::string help;
    if (c == '%') help = "`%` follows a number without a space, in the sizes of split; the remainder is `mod`";
    if (c == '!') help = "write `not`, or `!=`";
    if (c == '&') help = "write `and`";
    if (c == '|') help = "write `or`";
    if (c == ';') help = "statements need no `;`";
    if (c == '\'') help = "a text stands between `\"` and `\"`";
    diagnostics_.error("E0101", span(at_, bytes), fmt::format("{} has no meaning here", shown), help);
    // A run of such characters is one fault.
    const std::size_t run = at_;
    at_ += bytes;
    while (at_ < source_.size() && (peek() & 0x80 || peek() == c) && at_ - run < source_.size()) ++at_;
  }

  std::string_view source_;
  Diagnostics& diagnostics_;
  std::uint16_t file_;
  std::vector<Comment>* comments_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  std::uint32_t line_start_ = 0;
};

}  // namespace

std::vector<Token> tokenize(std::string_view source, Diagnostics& diagnostics, std::uint16_t file,
                            std::vector<Comment>* comments) {
  return Lexer(source, diagnostics, file, comments).run();
}

std::string describe(const Token& token) {
  constexpr std::size_t kShown = 40;
  const std::string text =
      token.text.size() <= kShown ? std::string(token.text) : std::string(token.text.substr(0, kShown)) + "...";
  switch (token.kind) {
    case TokenKind::number: return fmt::format("the number `{}`", text);
    case TokenKind::text: return fmt::format("the text \"{}\"", text);
    case TokenKind::end: return "the end of the text";
    case TokenKind::word:
    case TokenKind::symbol: break;
  }
  return fmt::format("`{}`", text);
}

}  // namespace espalier
