#include "grammar/layout_tokens.h"

#include <algorithm>
#include <array>

#include "grammar/words.h"

namespace espalier {
namespace {

/// Where the signs of a grammar stand: the one thing about spacing that tokens alone do not tell (`turn (1, 0, 1) -a`).
class SignFinder {
 public:
  explicit SignFinder(std::unordered_set<std::uint32_t>& signs) : signs_(signs) {}

  void decl(const ast::Decl& decl) {
    for (const auto* e : {&decl.value, &decl.low, &decl.high, &decl.step, &decl.guard}) expr(*e);
    block(decl.body);
  }

 private:
  void expr(const ast::ExprPtr& e) {
    if (!e) return;
    if (e->kind == ast::ExprKind::unary && e->op == ast::Operator::negate) signs_.insert(e->span.offset);
    for (const ast::ExprPtr& child : e->children) expr(child);
    for (const ast::Arg& arg : e->args) expr(arg.label), expr(arg.value);
  }
  void ref(const std::optional<ast::Ref>& r) {
    if (!r) return;
    for (const ast::ExprPtr& arg : r->args) expr(arg);
  }
  void block(const ast::Block& b) {
    for (const ast::StmtPtr& s : b.statements) stmt(*s);
  }
  void stmt(const ast::Stmt& s) {
    expr(s.probability);
    for (const ast::ExprPtr& e : s.exprs) expr(e);
    for (const ast::ExprPtr& e : s.list.values) expr(e);
    for (const ast::Block& b : s.blocks) block(b);
    for (const ast::Case& c : s.cases) expr(c.value), block(c.block);
    ref(s.target), ref(s.on_empty), ref(s.on_open);
  }

  std::unordered_set<std::uint32_t>& signs_;
};

bool is_one_of(const Token& token, std::initializer_list<std::string_view> texts) {
  return std::any_of(texts.begin(), texts.end(), [&](std::string_view text) { return token.is(text); });
}

bool is_whole(const Token& token) {
  return token.kind == TokenKind::number && token.text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// How loosely an operator binds: lines break at the loosest. 0 for what is no operator.
int looseness(const Token& token) {
  if (is_one_of(token, {",", "->"})) return 1;
  if (token.is("?")) return 3;  // the colon of `? :` has 2
  if (token.is("or")) return 4;
  if (token.is("and")) return 5;
  if (is_one_of(token, {"<", "<=", ">", ">=", "==", "!="})) return 6;
  if (is_one_of(token, {"+", "-"})) return 7;
  if (is_one_of(token, {"*", "/", "mod"})) return 8;
  return 0;
}

}  // namespace

int columns(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

LayoutTokens::LayoutTokens(std::string_view source, const ast::Grammar& grammar) : source_(source) {
  Diagnostics none;  // the text has been parsed, there is nothing left to report
  tokens_ = tokenize(source, none, 0, &comments_);
  SignFinder finder(unary_);
  for (const ast::Decl& decl : grammar.decls) finder.decl(decl);
  ternary_.resize(tokens_.size());
  gaps_.resize(tokens_.size()), ranks_.resize(tokens_.size()), ends_.resize(tokens_.size());
  std::size_t comment = 0;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    while (comment < comments_.size() && comments_[comment].next_token < i) ++comment;
    first_comment_.push_back(comment);
    mark(i);
  }
  first_comment_.push_back(comments_.size());
}

void LayoutTokens::mark(std::size_t i) {
  const Token& token = tokens_[i];
  if (is_one_of(token, {")", "]"})) --depth_;
  if (token.is("?")) questions_.push_back(depth_);
  if (token.is(":") && !questions_.empty() && questions_.back() == depth_) {
    questions_.pop_back();
    ternary_[i] = 1;
  }
  gaps_[i] = i == 0 ? 0 : gap_before(i);
  ranks_[i] = i == 0 ? 0 : rank_before(i);
  ends_[i] = (i == 0 ? 0 : ends_[i - 1]) + gaps_[i] + columns(spelling(i));
  if (is_one_of(token, {"(", "["})) ++depth_;
}

int LayoutTokens::gap_before(std::size_t i) const {
  const Token& token = tokens_[i];
  const Token& before = tokens_[i - 1];
  if (is_one_of(before, {"(", "[", ".", ".."}) || is_one_of(token, {")", "]", ",", ".", ".."})) return 0;
  if (before.is("-") && is_unary(i - 1)) return 0;
  if (before.is("~") && i >= 2 && is_one_of(tokens_[i - 2], {"{", "}"})) return 0;  // `~1:` in a split
  if (token.is(":")) return ternary_[i] ? 1 : 0;
  if (token.is("(")) return before.kind == TokenKind::word && !is_keyword(before.text) && !is_axis(before.text) ? 0 : 1;
  if (is_fraction(i) || is_fraction(i - 1)) return 0;
  return 1;
}

/// `1/3` as a number of its own, not within a longer product.
bool LayoutTokens::is_fraction(std::size_t slash) const {
  if (!tokens_[slash].is("/") || slash < 2 || slash + 2 >= tokens_.size()) return false;
  const auto binds = [](const Token& token) { return is_one_of(token, {"*", "/", "mod", "^", "."}); };
  return is_whole(tokens_[slash - 1]) && is_whole(tokens_[slash + 1]) && !binds(tokens_[slash - 2]) &&
         !binds(tokens_[slash + 2]);
}

int LayoutTokens::rank_before(std::size_t i) const {
  constexpr int kPerLevel = 16, kAfterEquals = 2 * kPerLevel + 8;
  const Token& before = tokens_[i - 1];
  if (is_one_of(tokens_[i], {"else", "otherwise", "when"})) return 1;
  if (before.is("=")) return kAfterEquals;
  if ((before.is("-") && is_unary(i - 1)) || is_fraction(i - 1)) return 0;
  const int loose = ternary_[i - 1] ? 2 : looseness(before);
  return loose == 0 ? 0 : kPerLevel * depth_ + loose;
}

std::size_t LayoutTokens::index_at(std::uint32_t offset) const {
  const auto found = std::lower_bound(tokens_.begin(), tokens_.end(), offset,
                                      [](const Token& token, std::uint32_t o) { return token.span.offset < o; });
  return static_cast<std::size_t>(found - tokens_.begin());
}

int LayoutTokens::width(std::size_t first, std::size_t last) const {
  if (first == last) return 0;
  return ends_[last - 1] - ends_[first] + columns(spelling(first));
}

std::span<const Comment> LayoutTokens::comments_before(std::size_t i) const {
  return std::span(comments_).subspan(first_comment_[i], first_comment_[i + 1] - first_comment_[i]);
}

bool LayoutTokens::has_comments(std::size_t first, std::size_t last) const {
  return first < last && first_comment_[last] != first_comment_[first + 1];
}

int LayoutTokens::source_column(const Comment& comment) const {
  return columns(source_.substr(comment.span.offset - (comment.span.column - 1), comment.span.column - 1));
}

}  // namespace espalier
