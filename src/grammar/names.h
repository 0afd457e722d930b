#pragma once
// NameChecker: resolves names in expressions and bodies, and holds against the rules what each place may read. Private
// to the checker.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/check_context.h"
#include "grammar/words.h"

namespace espalier {

class NameChecker {
 public:
  explicit NameChecker(CheckContext& context) : context_(context) {}

  void value_declaration(const ast::Decl& decl);
  void body(const ast::Decl& decl);
  /// After all bodies: draws and lets of the start rule that nobody read, or that others hide.
  void close_globals();

 private:
  /// What an expression may read, by where it stands.
  enum Sight : unsigned {
    kConstants = 1,
    kAttributes = 2,
    kGlobals = 4,
    kLocals = 8,
    kLoops = 16,
    kScope = 32,
    kDepth = 64,
    kChildless = 128,
    kMeshes = 256,
  };
  struct Reader {
    unsigned sees;
    std::string_view who;   // "a guard"
    std::string_view help;  // what it may read
  };
  enum class LocalSort : std::uint8_t { parameter, draw, let, loop };
  struct Local {
    LocalSort sort;
    SourceSpan span;
    bool used = false;
    int layers = 1;  // more where one hides another, which is an error
  };

  // Bodies (names.cpp)
  void block(const ast::Block& block);
  void statements(const ast::Block& block);
  void statement(const ast::Stmt& stmt);
  void cases(const ast::Stmt& stmt);
  void bind(const ast::Stmt& stmt);
  void loop(const ast::Stmt& stmt);
  void declare(std::string_view name, LocalSort sort, const SourceSpan& span);
  void close(std::string_view name);
  void report_unread(std::string_view name, LocalSort sort, const SourceSpan& span);
  void reference(const ast::Ref& ref, ast::DeclKind kind);
  void parameters(const ast::Decl& decl);

  // Expressions (names_expr.cpp)
  void read(const ast::Expr& expr, const Reader& reader);
  void read_name(const ast::Expr& expr, const Reader& reader);
  void read_declared(const ast::Expr& expr, const ast::Decl& decl, const Reader& reader);
  void read_builtin(const ast::Expr& expr, const Builtin& builtin, const Reader& reader);
  void read_global(const ast::Expr& expr, CheckContext::Global& global, const Reader& reader);
  void call(const ast::Expr& expr, const Reader& reader);
  void call_builtin(const ast::Expr& expr, const Builtin& builtin, const Reader& reader);
  void call_depth(const ast::Expr& expr, const Reader& reader);
  void call_function(const ast::Expr& expr, const ast::Decl& function, const Reader& reader);
  void labels(const ast::Expr& expr, const Builtin& builtin);
  void draw(const ast::Expr& call, const Reader& reader);
  void require(const ast::Expr& expr, unsigned sight, const Reader& reader, std::string_view what);
  /// That the start rule's draws are made which the function or material at `index` reads.
  void require_made(const ast::Expr& expr, std::size_t index);
  void unknown(const ast::Expr& expr, bool called);
  bool count(const SourceSpan& span, std::string_view name, std::size_t given, int fewest, int most);
  std::vector<std::string_view> words_in_sight(bool called) const;

  bool in_rule() const { return decl_->kind == ast::DeclKind::rule; }
  bool in_start() const { return in_rule() && decl_->name == context_.checked.start; }

  Reader body_reader() const;
  Reader condition_reader() const;

  CheckContext& context_;
  const ast::Decl* decl_ = nullptr;
  std::map<std::string_view, Local> locals_{};
  std::size_t globals_defined_ = 0;  // in the start rule: how many of its draws and lets are behind us
  int nesting_ = 0;
};

}  // namespace espalier
