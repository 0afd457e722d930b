#pragma once
// StaticChecks: the ranges that draws and statements ask for, wherever their values are known before the search.
// Private to the checker.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "grammar/check_context.h"

namespace espalier {

class StaticChecks {
 public:
  explicit StaticChecks(CheckContext& context) : context_(context) {}

  /// A statement's own expressions, blocks inside not included. Each fault is reported once however often it is met.
  void statement(const ast::Stmt& stmt, const StaticScope& scope, bool in_rule);
  /// Primitives and surfaces in an expression, and whatever of it is static.
  void expression(const ast::Expr& expr, const StaticScope& scope);

 private:
  using Value = std::optional<StaticValue>;

  // static_checks.cpp
  bool reads_loop(const ast::Stmt& stmt, const StaticScope& scope);
  Value value(const ast::Expr& expr, const StaticScope& scope);
  void error(std::string code, const ast::Expr& expr, std::string message, std::string help = {});
  void warning(std::string code, const ast::Expr& expr, std::string message, std::string help = {});
  bool fresh(const void* place, const std::string& code) { return reported_.insert({place, code}).second; }
  void primitive(const ast::Expr& expr, const StaticScope& scope);
  void lengths(const ast::Stmt& stmt, const StaticScope& scope);
  void direction(const ast::Expr& expr, const StaticScope& scope);
  void sizes(const ast::Stmt& stmt, const StaticScope& scope);
  void weights(const ast::Stmt& stmt, const StaticScope& scope);

  // surface_checks.cpp
  void surface(const ast::Expr& expr, const StaticScope& scope);

  // draw_checks.cpp
  void draw(const ast::Expr& call, const StaticScope& scope);
  void uniform(const ast::Expr& call, const StaticScope& scope);
  void normal(const ast::Expr& call, const StaticScope& scope);
  void loguniform(const ast::Expr& call, const StaticScope& scope);
  void integer(const ast::Expr& call, const StaticScope& scope);
  void chance(const ast::Expr& call, const StaticScope& scope);
  void pick(const ast::Expr& call, const StaticScope& scope);

  CheckContext& context_;
  std::set<std::pair<const void*, std::string>> reported_{};
  std::map<const ast::Stmt*, bool> reads_loop_{};
};

}  // namespace espalier
