#pragma once
// The parser at work: a cursor over the tokens with one function per production. Private to parser*.cpp.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/ast.h"
#include "grammar/lexer.h"

namespace espalier {

class Parser {
 public:
  Parser(std::vector<Token> tokens, Diagnostics& diagnostics) : tokens_(std::move(tokens)), diagnostics_(diagnostics) {}

  ast::Grammar file();
  ast::ExprPtr lone_expression();

 private:
  /// Thrown after a report, caught where parsing can go on: at a statement, a case or a declaration.
  struct SyntaxError {};

  /// Counts levels of nesting while it lives; too many end the parse.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) { parser_.enter(); }
    ~Level() { --parser_.level_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  // Cursor (parser.cpp)
  const Token& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  bool at(std::string_view word_or_symbol) const { return peek().is(word_or_symbol); }
  bool at_end() const { return peek().kind == TokenKind::end; }
  bool accept(std::string_view word_or_symbol);
  Token take();
  void expect(std::string_view word_or_symbol, std::string_view where);
  Token expect_name(std::string_view what);
  std::uint32_t expect_count(std::string_view what);
  [[noreturn]] void fail(std::string_view expected, std::string help = {});
  [[noreturn]] void fail_at(std::string code, const SourceSpan& span, std::string message, std::string help = {});
  SourceSpan since(const Token& first) const;
  void enter();
  void check_height(const ast::Expr& expr);

  // Declarations (parser.cpp)
  void header(ast::Grammar& grammar);
  ast::Decl declaration();
  void value_declaration(ast::Decl& decl, ast::DeclKind kind, std::string_view what);
  void attribute(ast::Decl& decl);
  void rule(ast::Decl& decl);
  std::vector<ast::Param> params();
  bool at_declaration() const;
  void skip_to_declaration();

  // Blocks and recovery (parser_block.cpp)
  ast::Block block(std::string_view owner);
  void statement_into(ast::Block& block);
  bool at_statement() const;
  bool at_declaration_only() const;
  bool at_new_line() const;
  void recover();
  [[noreturn]] void fail_statement();

  // Statements (parser_stmt.cpp)
  ast::StmtPtr statement();
  ast::StmtPtr draw();
  void statement_body(ast::Stmt& stmt, std::string_view word);
  bool structure_statement(ast::Stmt& stmt, std::string_view word);
  void output_statement(ast::Stmt& stmt, std::string_view word);
  void if_statement(ast::Stmt& stmt);
  void for_statement(ast::Stmt& stmt);
  void spawn(ast::Stmt& stmt, bool maybe);
  void turn(ast::Stmt& stmt);
  void aim(ast::Stmt& stmt);
  void emit(ast::Stmt& stmt);
  void cases(ast::Stmt& stmt);
  ast::Case one_case(ast::StmtKind kind);
  ast::Ref reference(std::string_view what);
  ast::Axis expect_axis();
  std::optional<ast::Axis> accept_axis();

  // Expressions (parser_expr.cpp)
  ast::ExprPtr expression();
  ast::ExprPtr binary(int loosest);
  ast::ExprPtr prefix();
  ast::ExprPtr power();
  ast::ExprPtr postfix();
  ast::ExprPtr primary();
  ast::ExprPtr parenthesized();
  ast::ExprPtr call(const Token& name);
  ast::List list();
  ast::ExprPtr make(ast::ExprKind kind, const Token& first);
  ast::ExprPtr finish(ast::ExprPtr expr, const Token& first);

  std::vector<Token> tokens_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  int level_ = 0;
  std::size_t statements_ = 0;
};

}  // namespace espalier
