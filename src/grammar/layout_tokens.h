#pragma once
// The tokens and comments of a grammar as the formatter sees them: how wide they are, what stands between two of them
// on one line, where a line may break. Private to the formatter. Columns count code points.

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "grammar/ast.h"
#include "grammar/lexer.h"

namespace espalier {

/// Code points of a text in UTF-8.
int columns(std::string_view text);

class LayoutTokens {
 public:
  /// `source` parses without errors, to `grammar`.
  LayoutTokens(std::string_view source, const ast::Grammar& grammar);

  const Token& operator[](std::size_t i) const { return tokens_[i]; }
  /// With the token at the end of the text.
  std::size_t size() const { return tokens_.size(); }
  /// The index of the token that begins at a byte offset.
  std::size_t index_at(std::uint32_t offset) const;
  /// As written, quotes included.
  std::string_view spelling(std::size_t i) const {
    return source_.substr(tokens_[i].span.offset, tokens_[i].span.length);
  }
  /// Blanks before token i where the token before it stands on the same line and belongs to the same statement.
  int gap(std::size_t i) const { return gaps_[i]; }
  /// Columns of tokens first..last-1 on one line.
  int width(std::size_t first, std::size_t last) const;
  /// How bad it is to break the line before token i; 0: it cannot be.
  int break_rank(std::size_t i) const { return ranks_[i]; }

  /// The comments between token i - 1 and token i.
  std::span<const Comment> comments_before(std::size_t i) const;
  /// Whether a comment stands between two of the tokens first..last-1.
  bool has_comments(std::size_t first, std::size_t last) const;
  /// The 0-based column of a comment in the source.
  int source_column(const Comment& comment) const;

 private:
  void mark(std::size_t i);
  int gap_before(std::size_t i) const;
  int rank_before(std::size_t i) const;
  bool is_fraction(std::size_t slash) const;
  bool is_unary(std::size_t i) const { return unary_.contains(tokens_[i].span.offset); }

  std::string_view source_;
  std::vector<Token> tokens_;
  std::vector<Comment> comments_;
  std::unordered_set<std::uint32_t> unary_;  // offsets of signs
  std::vector<char> ternary_;                // colons of `? :`
  std::vector<int> gaps_, ranks_, ends_;     // ends_[i]: columns of tokens 0..i on one line
  std::vector<std::size_t> first_comment_;   // like tokens_: comments before those of this token
  int depth_ = 0;                            // of ( and [, while marking
  std::vector<int> questions_;               // their depths, while marking
};

}  // namespace espalier
