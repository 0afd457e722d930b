#include "grammar/expr_compiler.h"

#include <cmath>

#include <fmt/core.h>

#include "grammar/surface_arguments.h"

namespace espalier {

Arithmetic arithmetic_of(ast::Operator op) {
  switch (op) {
    case ast::Operator::negate: return Arithmetic::negate;
    case ast::Operator::logical_not: return Arithmetic::logical_not;
    case ast::Operator::subtract: return Arithmetic::subtract;
    case ast::Operator::multiply: return Arithmetic::multiply;
    case ast::Operator::divide: return Arithmetic::divide;
    case ast::Operator::modulo: return Arithmetic::modulo;
    case ast::Operator::power: return Arithmetic::power;
    case ast::Operator::less: return Arithmetic::less;
    case ast::Operator::less_equal: return Arithmetic::less_equal;
    case ast::Operator::greater: return Arithmetic::greater;
    case ast::Operator::greater_equal: return Arithmetic::greater_equal;
    case ast::Operator::equal: return Arithmetic::equal;
    case ast::Operator::not_equal: return Arithmetic::not_equal;
    case ast::Operator::logical_and: return Arithmetic::logical_and;
    case ast::Operator::logical_or: return Arithmetic::logical_or;
    default: return Arithmetic::add;
  }
}

namespace {

bool compares(ast::Operator op) { return op >= ast::Operator::less; }

}  // namespace

const std::map<std::string, Arithmetic>& scalar_functions() {
  static const std::map<std::string, Arithmetic> functions = {
      {"abs", Arithmetic::absolute}, {"floor", Arithmetic::floor}, {"ceil", Arithmetic::ceil},
      {"round", Arithmetic::round},  {"sqrt", Arithmetic::sqrt},   {"exp", Arithmetic::exp},
      {"log", Arithmetic::log},      {"sin", Arithmetic::sin},     {"cos", Arithmetic::cos},
      {"tan", Arithmetic::tan},      {"asin", Arithmetic::asin},   {"acos", Arithmetic::acos},
      {"atan", Arithmetic::atan},    {"min", Arithmetic::minimum}, {"max", Arithmetic::maximum},
      {"atan2", Arithmetic::atan2},  {"clamp", Arithmetic::clamp}, {"smooth", Arithmetic::smooth}};
  return functions;
}

Value spread(const Value& value) {
  if (value.kind == Kind::vector) return value;
  return {Kind::vector, {value.parts[0], value.parts[0], value.parts[0]}, {}};
}

void ExprCompiler::problem(const ast::Expr& expr, const std::string& message) {
  tables_.diagnostics.error("E0902", expr.span, message);
}

Value ExprCompiler::compile(const ast::Expr& expr, const NameScope& scope) {
  switch (expr.kind) {
    case ast::ExprKind::number: {
      const StaticValue value = literal_value(expr);
      return number_value(static_cast<float>(value.scalar()), value.kind);
    }
    case ast::ExprKind::text: return {Kind::text, {}, expr.name};
    case ast::ExprKind::boolean: return number_value(static_cast<float>(expr.value), Kind::boolean);
    case ast::ExprKind::name: return name(expr, scope);
    case ast::ExprKind::call: return call(expr, scope);
    case ast::ExprKind::vector: {
      Value value{Kind::vector, {}, {}};
      for (int i = 0; i < 3; ++i) value.parts[i] = scalar(*expr.children[i], scope);
      return value;
    }
    case ast::ExprKind::unary: return unary(expr, scope);
    case ast::ExprKind::binary: return binary(expr, scope);
    case ast::ExprKind::ternary: {
      const Operand condition = scalar(*expr.children[0], scope);
      // Only the side that is taken is compiled where that is known: the other may not even make sense.
      if (condition.coefficient == 0) return compile(*expr.children[condition.bias != 0 ? 1 : 2], scope);
      const Value a = compile(*expr.children[1], scope);
      return select(condition, a, compile(*expr.children[2], scope));
    }
    case ast::ExprKind::member: {
      const Value vector = compile(*expr.children[0], scope);
      return {Kind::number, {vector.parts[static_cast<int>(expr.axis)]}, {}};
    }
  }
  return {};
}

Value ExprCompiler::compile_vector(const ast::Expr& expr, const NameScope& scope) {
  return spread(compile(expr, scope));
}

Value ExprCompiler::select(const Operand& condition, const Value& a_in, const Value& b_in) {
  const bool vectors = a_in.kind == Kind::vector || b_in.kind == Kind::vector;
  const Value a = vectors ? spread(a_in) : a_in, b = vectors ? spread(b_in) : b_in;
  Value value = a;
  for (int i = 0; i < a.width(); ++i)
    value.parts[i] = builder_.ternary(Arithmetic::select, condition, a.parts[i], b.parts[i]);
  return value;
}

Value ExprCompiler::name(const ast::Expr& expr, const NameScope& scope) {
  if (expr.name == "scope") {
    Value value{Kind::vector, {}, {}};
    for (int i = 0; i < 3; ++i) value.parts[i] = register_operand(static_cast<Register>(kScopeRegister + i));
    return value;
  }
  if (expr.name == "depth") return {Kind::number, {register_operand(kDepthRegister)}, {}};
  if (expr.name == "childless") {
    tables_.graph.uses_childless = true;
    return {Kind::boolean, {register_operand(kChildlessRegister)}, {}};
  }
  if (const Value* value = scope.find(expr.name)) return *value;
  if (primitive_named(expr.name)) return primitive(expr, scope);
  // Materials that read the start rule's draws are written out where they are used.
  if (const ast::Decl* material = tables_.grammar.find(expr.name, ast::DeclKind::material))
    return surface(*material->value, tables_.globals, material->name);
  problem(expr, fmt::format("'{}' is not known here", expr.name));
  return {};
}

Value ExprCompiler::unary(const ast::Expr& expr, const NameScope& scope) {
  Value value = compile(*expr.children[0], scope);
  for (int i = 0; i < value.width(); ++i) value.parts[i] = builder_.unary(arithmetic_of(expr.op), value.parts[i]);
  return value;
}

Value ExprCompiler::binary(const ast::Expr& expr, const NameScope& scope) {
  Value a = compile(*expr.children[0], scope), b = compile(*expr.children[1], scope);
  if (a.kind == Kind::vector || b.kind == Kind::vector) {
    a = spread(a);
    b = spread(b);
  }
  Value value{a.kind, {}, {}};
  for (int i = 0; i < a.width(); ++i)
    value.parts[i] = builder_.binary(arithmetic_of(expr.op), a.parts[i], b.parts[i]);
  if (compares(expr.op)) value.kind = Kind::boolean;
  else if (expr.op == ast::Operator::divide && a.kind == Kind::angle && b.kind == Kind::angle)
    value.kind = Kind::number;
  else if (expr.op == ast::Operator::multiply && b.kind == Kind::angle) value.kind = Kind::angle;
  return value;
}

Value ExprCompiler::call(const ast::Expr& expr, const NameScope& scope) {
  if (primitive_named(expr.name)) return primitive(expr, scope);
  if (expr.name == "surface") return surface(expr, scope, {});
  if (texture_named(expr.name) != TextureKind::none) return texture(expr, scope);
  if (expr.name == "depth") {
    const auto index = tables_.counted_index(expr.args[0].value->name);
    return {Kind::number, {register_operand(static_cast<Register>(kFirstDepthOfRegister + index))}, {}};
  }
  std::vector<Value> args;
  for (const ast::Arg& arg : expr.args) args.push_back(compile(*arg.value, scope));
  if (const ast::Decl* function = tables_.grammar.find(expr.name, ast::DeclKind::function)) {
    NameScope inner(&tables_.globals);
    for (std::size_t i = 0; i < args.size(); ++i) inner.bind(function->params[i].name, args[i]);
    return compile(*function->value, inner);
  }
  if (expr.name == "mix") return mix(expr, args);
  if (expr.name == "vec" || expr.name == "length" || expr.name == "normalize" || expr.name == "dot" ||
      expr.name == "cross")
    return vector_function(expr.name, args);
  return scalar_function(expr, args);
}

Operand ExprCompiler::dot(const Value& a, const Value& b) {
  Operand sum = builder_.binary(Arithmetic::multiply, a.parts[0], b.parts[0]);
  for (int i = 1; i < 3; ++i)
    sum = builder_.binary(Arithmetic::add, sum, builder_.binary(Arithmetic::multiply, a.parts[i], b.parts[i]));
  return sum;
}

Value ExprCompiler::vector_function(const std::string& name, const std::vector<Value>& args) {
  const Value a = spread(args[0]);
  if (name == "vec") return a;
  if (name == "dot") return {Kind::number, {dot(a, spread(args[1]))}, {}};
  if (name == "cross") {
    const Value b = spread(args[1]);
    Value value{Kind::vector, {}, {}};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Operand left = builder_.binary(Arithmetic::multiply, a.parts[j], b.parts[k]);
      value.parts[i] = builder_.binary(Arithmetic::subtract, left,
                                       builder_.binary(Arithmetic::multiply, a.parts[k], b.parts[j]));
    }
    return value;
  }
  const Operand size = builder_.unary(Arithmetic::sqrt, dot(a, a));
  if (name == "length") return {Kind::number, {size}, {}};
  Value value = a;  // normalize
  for (Operand& part : value.parts) part = builder_.binary(Arithmetic::divide, part, size);
  return value;
}

Value ExprCompiler::scalar_function(const ast::Expr& expr, const std::vector<Value>& args) {
  const auto found = scalar_functions().find(expr.name);
  if (found == scalar_functions().end()) {
    problem(expr, fmt::format("'{}' cannot be called here", expr.name));
    return {};
  }
  const Arithmetic code = found->second;
  Value value = args[0];
  switch (args.size()) {
    case 1: value.parts[0] = builder_.unary(code, args[0].parts[0]); break;
    case 2: value.parts[0] = builder_.binary(code, args[0].parts[0], args[1].parts[0]); break;
    default: value.parts[0] = builder_.ternary(code, args[0].parts[0], args[1].parts[0], args[2].parts[0]); break;
  }
  if (code == Arithmetic::sin || code == Arithmetic::cos || code == Arithmetic::tan || code == Arithmetic::smooth)
    value.kind = Kind::number;
  if (code == Arithmetic::asin || code == Arithmetic::acos || code == Arithmetic::atan || code == Arithmetic::atan2)
    value.kind = Kind::angle;
  return value;
}

Value ExprCompiler::mix(const ast::Expr& expr, const std::vector<Value>& args) {
  if (args[0].kind == Kind::material) {
    if (!args[0].constant() || !args[1].constant()) {
      problem(expr, "mix needs materials that are known before the search: names, or surface(...)");
      return args[0];
    }
    const auto first = tables_.blend_index(static_cast<std::uint16_t>(args[0].number()),
                                           static_cast<std::uint16_t>(args[1].number()));
    Op& op = builder_.emit(OpCode::mix_material);
    op.a = first;
    op.x = args[2].parts[0];
    const Register dst = builder_.new_local(1);
    builder_.program.ops.back().dst = dst;
    return {Kind::material, {register_operand(dst)}, {}};
  }
  const bool vectors = args[0].kind == Kind::vector || args[1].kind == Kind::vector;
  const Value a = vectors ? spread(args[0]) : args[0], b = vectors ? spread(args[1]) : args[1];
  Value value = a;
  for (int i = 0; i < a.width(); ++i)
    value.parts[i] = builder_.ternary(Arithmetic::mix, a.parts[i], b.parts[i], args[2].parts[0]);
  return value;
}

Value ExprCompiler::mesh_value(const MeshRef& mesh, const Operand& top) {
  return {Kind::mesh, {constant_operand(tables_.mesh_index(mesh)), top}, {}};
}

Value ExprCompiler::primitive(const ast::Expr& expr, const NameScope& scope) {
  MeshRef mesh;
  mesh.kind = *primitive_named(expr.name);
  mesh.span = expr.span;
  Operand top = constant_operand(mesh.kind == MeshKind::cone ? 0.0f : 1.0f);
  int position = 0;
  for (const ast::Arg& arg : expr.args) {
    const char* const unlabelled = mesh.kind == MeshKind::cone && position == 0 ? "top" : "sides";
    const std::string label = arg.label ? arg.label->name : unlabelled;
    ++position;
    const Value value = compile(*arg.value, scope);
    if (label == "top") top = value.parts[0];
    else if (label == "sides") mesh.sides = static_cast<std::uint16_t>(value.number());
  }
  return mesh_value(mesh, top);
}

}  // namespace espalier
