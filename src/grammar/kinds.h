#pragma once
// KindChecker: gives every expression its kind, and parameters theirs from the first call; later calls must agree. One
// walk from the start rule outwards is enough: a body is seen after its first call. Private to the checker.

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/check_context.h"

namespace espalier {

class KindChecker {
 public:
  explicit KindChecker(CheckContext& context);

  void run();

 private:
  /// Nothing where an error elsewhere, or nobody's call, leaves the kind open: then it fits everywhere.
  using MaybeKind = std::optional<Kind>;

  struct Signature {
    std::vector<MaybeKind> kinds;
    std::vector<SourceSpan> set_by;  // the calls that gave the kinds
    bool visited = false;
    MaybeKind result;  // functions
  };

  // Declarations (kinds.cpp)
  void value_declaration(std::size_t index);
  void attribute(const ast::Decl& decl, MaybeKind kind);
  void resource(const ast::Decl& decl);
  void body(std::size_t index);
  void visit_function(std::size_t index);
  void enqueue(std::size_t index);
  void publish();

  // Statements (kinds_stmt.cpp)
  void block(const ast::Block& block);
  void statement(const ast::Stmt& stmt);
  void state_statement(const ast::Stmt& stmt);
  void bind(const ast::Stmt& stmt, MaybeKind kind);
  void loop(const ast::Stmt& stmt);
  void cases(const ast::Stmt& stmt);
  void reference(const ast::Ref& ref);
  void pass_argument(const ast::Decl& callee, std::size_t param, const ast::Expr& arg, MaybeKind kind);
  MaybeKind draw(ast::Expr& call);

  // Expressions (kinds_expr.cpp)
  MaybeKind of(ast::Expr& expr);
  MaybeKind of_name(const ast::Expr& expr);
  MaybeKind of_call(ast::Expr& expr);
  MaybeKind of_unary(const ast::Expr& expr);
  MaybeKind of_binary(const ast::Expr& expr);
  MaybeKind of_ternary(const ast::Expr& expr);
  MaybeKind of_function(const ast::Expr& expr, const ast::Decl& function);
  MaybeKind of_builtin(const ast::Expr& expr);
  void primitive_arguments(const ast::Expr& expr);
  void surface_arguments_of(const ast::Expr& expr);
  /// Same kind for all, one of `allowed` (empty: any).
  MaybeKind common_kind(const std::vector<ast::Expr*>& exprs, std::initializer_list<Kind> allowed,
                        std::string_view what);
  void expect(ast::Expr& expr, std::initializer_list<Kind> wanted, std::string_view what);
  void mismatch(const ast::Expr& expr, std::string message, MaybeKind wanted, MaybeKind got);

  CheckContext& context_;
  std::vector<Signature> signatures_;   // like ast.decls
  std::vector<MaybeKind> value_kinds_;  // like ast.decls: consts, attrs
  std::map<std::string_view, MaybeKind> locals_{};
  std::map<std::string_view, MaybeKind> globals_{};
  std::deque<std::size_t> open_{};
  bool in_start_ = false;
  int nesting_ = 0;
};

}  // namespace espalier
