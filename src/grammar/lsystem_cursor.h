#pragma once
// A cursor over one statement of an L-system file, and the expressions and modules that it reads. Private to the
// parser.

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/lsystem.h"

namespace espalier::lsystem {

/// Thrown after a report; the parser goes on with the next statement.
struct SyntaxError {};

class Cursor {
 public:
  /// `place`: where `text` begins; it may span lines.
  Cursor(std::string_view text, const SourceSpan& place, Diagnostics& diagnostics)
      : text_(text), place_(place), diagnostics_(diagnostics) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') line_starts_.push_back(i + 1);
  }

  void skip_blanks();
  bool at_end() { return skip_blanks(), at_ == text_.size(); }
  char peek() { return skip_blanks(), at_ < text_.size() ? text_[at_] : '\0'; }
  bool accept(std::string_view text);
  void expect(std::string_view text, std::string_view where);
  SourceSpan span(std::size_t begin, std::size_t length) const;
  SourceSpan here(std::size_t length = 1) { return skip_blanks(), span(at_, std::min(length, text_.size() - at_)); }
  [[noreturn]] void fail(std::string code, const SourceSpan& where, std::string message, std::string help = {});

  Expr expression() { return binary(0); }
  std::string name(std::string_view what);
  /// A letter, and what `_` adds to it: `F`, `F_l`. Empty where there is none.
  std::string letter();
  /// A letter or a turtle command; reports what is neither.
  std::string symbol();
  std::vector<std::string> params();
  Module module();
  std::vector<Module> modules();

 private:
  Expr binary(int loosest);
  Expr prefix();
  Expr power();
  Expr primary();
  Op operator_at(int strength);
  Expr join(Op op, std::size_t begin, std::vector<Expr> children);
  void refuse_symbol();

  std::string_view text_;
  SourceSpan place_;
  std::vector<std::size_t> line_starts_;  // behind the line ends in the text
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  int level_ = 0;
};

/// Reports names that are neither parameters nor constants (L0107).
void check_names(const System& system, Diagnostics& diagnostics);

}  // namespace espalier::lsystem
