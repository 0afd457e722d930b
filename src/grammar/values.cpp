// The checker's evaluation of consts and attrs, with the overrides of attrs, and a look at meshes and materials.

#include <cmath>

#include <fmt/core.h>

#include "grammar/check_context.h"
#include "grammar/parser.h"
#include "grammar/spelling.h"

namespace espalier {
namespace {

using ast::Decl;
using ast::DeclKind;

/// The value of an expression of a const or attr; reports where it has none.
std::optional<StaticValue> require_static(CheckContext& context, const Decl& decl, const ast::Expr& expr) {
  const std::size_t before = context.diagnostics.error_count();
  const StaticScope scope{context.checked, false, {}};
  std::optional<StaticValue> value = evaluate_static(expr, scope, &context.diagnostics);
  if (!value && context.diagnostics.error_count() == before)
    context.diagnostics.error(
        "E0504", expr.span,
        fmt::format("the value of the {} `{}` must be known before anything else", word_of(decl.kind), decl.name),
        "it reads only literals and consts, and functions of those");
  return value;
}

void evaluate_attribute(CheckContext& context, const Decl& decl) {
  CheckedAttribute attribute;
  attribute.label = decl.label;
  const auto value = require_static(context, decl, *decl.value);
  if (!value) return;
  attribute.value = attribute.default_value = *value;
  attribute.ranged = decl.low != nullptr;
  if (decl.low) {
    const auto low = require_static(context, decl, *decl.low);
    const auto high = require_static(context, decl, *decl.high);
    if (!low || !high) return;
    attribute.low = low->scalar();
    attribute.high = high->scalar();
    if (!(attribute.low < attribute.high))
      context.diagnostics.error(
          "E0701", decl.low->span,
          fmt::format("the range of `{}` is empty: {}..{}", decl.name, describe(*low), describe(*high)));
    else if (value->scalar() < attribute.low || value->scalar() > attribute.high)
      context.diagnostics.error("E0702", decl.value->span,
                                fmt::format("the default of `{}` is {}, outside its range {}..{}", decl.name,
                                            describe(*value), describe(*low), describe(*high)));
  }
  if (decl.step) {
    const auto step = require_static(context, decl, *decl.step);
    if (!step) return;
    attribute.step = step->scalar();
    if (!(attribute.step > 0))
      context.diagnostics.error("E0701", decl.step->span,
                                fmt::format("the step of `{}` must be > 0, got {}", decl.name, describe(*step)));
  }
  context.checked.attributes[decl.name] = std::move(attribute);
}

/// The value of an override: an expression of literals.
std::optional<StaticValue> parse_override(const std::string& text, const CheckedGrammar& grammar) {
  Diagnostics quiet;
  const ast::ExprPtr expr = parse_expression(text, quiet);
  if (!expr || (expr->kind == ast::ExprKind::number && expr->unit == ast::Unit::percent)) return std::nullopt;
  return evaluate_static(*expr, StaticScope{grammar, false, {}}, &quiet);
}

void override_attribute(CheckContext& context, const std::string& name, const std::string& text) {
  constexpr SourceSpan kNowhere{};
  const auto found = context.checked.attributes.find(name);
  if (found == context.checked.attributes.end()) {
    std::vector<std::string_view> names;
    for (const auto& [known, attribute] : context.checked.attributes) names.push_back(known);
    const std::string help = did_you_mean(name, names);
    context.diagnostics.error("E0703", kNowhere,
                              fmt::format("there is no attr `{}` to set{}{}", name, help.empty() ? "" : "; ", help));
    return;
  }
  CheckedAttribute& attribute = found->second;
  const auto value = parse_override(text, context.checked);
  const Kind kind = attribute.default_value.kind;
  if (!value || value->kind != kind) {
    context.diagnostics.error("E0704", kNowhere,
                              fmt::format("the attr `{}` is {}, such as {}, and cannot be set to `{}`", name,
                                          phrase_of(kind), describe(attribute.default_value), text));
  } else if (attribute.ranged && (value->scalar() < attribute.low || value->scalar() > attribute.high)) {
    StaticValue low = attribute.default_value, high = low;
    low.numbers[0] = attribute.low;
    high.numbers[0] = attribute.high;
    context.diagnostics.error(
        "E0705", kNowhere,
        fmt::format("the attr `{}` must be in {}..{}, got {}", name, describe(low), describe(high), describe(*value)));
  } else {
    attribute.value = *value;
  }
}

}  // namespace

void evaluate_values(CheckContext& context) {
  for (const std::size_t index : context.value_order) {
    const Decl& decl = context.decls()[index];
    if (decl.kind == DeclKind::attribute) evaluate_attribute(context, decl);
    if (decl.kind != DeclKind::constant) continue;
    if (auto value = require_static(context, decl, *decl.value))
      context.checked.constants[decl.name] = std::move(*value);
  }
  for (const auto& [name, text] : context.attribute_overrides) override_attribute(context, name, text);
}

}  // namespace espalier
