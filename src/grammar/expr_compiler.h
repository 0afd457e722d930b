#pragma once
// ExprCompiler: expressions of checked programs -> values. Pure functions are inlined; what is constant folds.

#include "grammar/graph_tables.h"
#include "grammar/program_builder.h"

namespace espalier {

class ExprCompiler {
 public:
  ExprCompiler(GraphTables& tables, ProgramBuilder& builder) : tables_(tables), builder_(builder) {}

  Value compile(const ast::Expr& expr, const NameScope& scope);
  /// As a vector: a number spreads over three components.
  Value compile_vector(const ast::Expr& expr, const NameScope& scope);
  /// The operand of a scalar expression.
  Operand scalar(const ast::Expr& expr, const NameScope& scope) { return compile(expr, scope).parts[0]; }

  /// The values chosen between by nested conditions: condition ? a : b, per component.
  Value select(const Operand& condition, const Value& a, const Value& b);

 private:
  Value name(const ast::Expr& expr, const NameScope& scope);
  Value call(const ast::Expr& expr, const NameScope& scope);
  Value unary(const ast::Expr& expr, const NameScope& scope);
  Value binary(const ast::Expr& expr, const NameScope& scope);
  Value vector_function(const std::string& name, const std::vector<Value>& args);
  Value scalar_function(const ast::Expr& expr, const std::vector<Value>& args);
  Value mix(const ast::Expr& expr, const std::vector<Value>& args);
  Value primitive(const ast::Expr& expr, const NameScope& scope);
  // surface_compiler.cpp
  Value surface(const ast::Expr& expr, const NameScope& scope, const std::string& name);
  Value texture(const ast::Expr& expr, const NameScope& scope);
  void texture_argument(const ast::Expr& call, std::size_t i, const NameScope& scope, TextureValue& out);
  Value made_material(const ast::Expr& expr, const Material& base, const std::vector<OpenNumber>& open);
  Value mesh_value(const MeshRef& mesh, const Operand& top);
  Operand dot(const Value& a, const Value& b);
  void problem(const ast::Expr& expr, const std::string& message);

  GraphTables& tables_;
  ProgramBuilder& builder_;
};

Arithmetic arithmetic_of(ast::Operator op);
/// "sin", "clamp", ...: the functions that take and give one float each.
const std::map<std::string, Arithmetic>& scalar_functions();

/// A number spread over three components; vectors as they are.
Value spread(const Value& value);

}  // namespace espalier
