// ExprCompiler: surfaces and textures. What is constant becomes a material of the graph; where a number varies, a
// recipe and an operation that makes the material with the model.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "grammar/expr_compiler.h"
#include "grammar/surface_arguments.h"

namespace espalier {
namespace {

constexpr MaterialField kNumberFields[] = {MaterialField::roughness, MaterialField::metal, MaterialField::opacity,
                                           MaterialField::glow,      MaterialField::cutout};

MaterialField field_of(const SurfaceArgument& argument) {
  if (argument.name == "tiles") return MaterialField::tiles;
  if (argument.name == "tiles_up") return MaterialField::tiles_up;
  if (argument.name == "metres") return MaterialField::metres;
  const auto place = static_cast<std::size_t>(&argument - surface_arguments("surface").data());
  return kNumberFields[place - 1];  // the colour comes first
}

/// Number `i` of a texture.
MaterialField field_of_texture(std::size_t i) {
  return static_cast<MaterialField>(static_cast<std::size_t>(MaterialField::texture) + i);
}

float in_range(const SurfaceArgument& argument, float value) {
  const float clamped = argument.unbounded ? std::max(value, argument.low)
                                           : std::min(std::max(value, argument.low), argument.high);
  return argument.whole ? std::floor(clamped + 0.5f) : clamped;
}

OpenNumber open_number(MaterialField field, const SurfaceArgument& argument, const Operand& operand) {
  OpenNumber out{make_slot(field, argument.low, argument.high, argument.logarithmic), operand};
  for (float& value : out.slot.values) value = in_range(argument, value);
  return out;
}

}  // namespace

Value ExprCompiler::texture(const ast::Expr& expr, const NameScope& scope) {
  TextureValue value{default_texture(texture_named(expr.name)), {}};
  value.texture.span = expr.span;
  for (std::size_t i = 0; i < expr.args.size(); ++i) texture_argument(expr, i, scope, value);
  tables_.textures.push_back(std::move(value));
  return number_value(static_cast<float>(tables_.textures.size() - 1), Kind::texture);
}

void ExprCompiler::texture_argument(const ast::Expr& call, std::size_t i, const NameScope& scope, TextureValue& out) {
  const SurfaceArgument& argument = *surface_argument(call, i);
  const std::span<const SurfaceArgument> all = surface_arguments(call.name);
  const Value value = compile(*call.args[i].value, scope);
  if (argument.sort == SurfaceArgument::Sort::file) {
    out.texture.path = tables_.path_from_grammar(value.text, call.span);
  } else if (argument.sort == SurfaceArgument::Sort::color) {
    Vec3& color = out.texture.colors[static_cast<std::size_t>(&argument - all.data())];
    if (const auto parsed = parse_color(value.text)) color = *parsed;
    else problem(*call.args[i].value, fmt::format("a colour is written \"#rrggbb\", got \"{}\"", value.text));
  } else {
    const auto number = static_cast<std::size_t>(&argument - texture_numbers(out.texture.kind).data());
    if (value.constant()) out.texture.numbers[number] = in_range(argument, value.number());
    else out.open.push_back(open_number(field_of_texture(number), argument, value.parts[0]));
  }
}

Value ExprCompiler::surface(const ast::Expr& expr, const NameScope& scope, const std::string& name) {
  Material material;
  std::vector<OpenNumber> open;
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const SurfaceArgument& argument = *surface_argument(expr, i);
    const ast::Expr& place = *expr.args[i].value;
    const Value value = compile(place, scope);
    switch (argument.sort) {
      case SurfaceArgument::Sort::color:
        material.name = value.text;
        if (const auto color = parse_color(value.text)) material.color = *color;
        else problem(place, fmt::format("a colour is written \"#rrggbb\", got \"{}\"", value.text));
        break;
      case SurfaceArgument::Sort::boolean:
        if (value.constant()) material.two_sided = value.number() != 0;
        else problem(place, fmt::format("the {} of a surface must be constant", argument.name));
        break;
      case SurfaceArgument::Sort::texture: {
        const TextureValue& texture = tables_.textures[static_cast<std::size_t>(value.number())];
        material.texture = texture.texture;
        open.insert(open.end(), texture.open.begin(), texture.open.end());
        break;
      }
      default:
        if (value.constant()) set_field(material, field_of(argument), in_range(argument, value.number()));
        else open.push_back(open_number(field_of(argument), argument, value.parts[0]));
    }
  }
  if (!name.empty()) material.name = name;
  if (open.empty()) return number_value(tables_.material_index(material), Kind::material);
  return made_material(expr, material, open);
}

Value ExprCompiler::made_material(const ast::Expr& expr, const Material& base, const std::vector<OpenNumber>& open) {
  if (open.size() > MaterialRecipe::kMostSlots) {
    problem(expr, fmt::format("at most {} numbers of a surface may vary, here {}", MaterialRecipe::kMostSlots,
                              open.size()));
    return number_value(0, Kind::material);
  }
  MaterialRecipe recipe{base, {}, 0};
  PaintSite site;
  for (const OpenNumber& number : open) {
    set_field(recipe.base, number.slot.field, number.slot.values[MaterialRecipe::kSteps / 2]);
    recipe.slots.push_back(number.slot);
    site.args.push_back(number.operand);
  }
  site.recipe = tables_.recipe_index(std::move(recipe));
  builder_.program.paints.push_back(std::move(site));
  const Register dst = builder_.new_local(1);
  Op& op = builder_.emit(OpCode::make_material);
  op.a = static_cast<std::uint16_t>(builder_.program.paints.size() - 1);
  op.dst = dst;
  return {Kind::material, {register_operand(dst)}, {}};
}

}  // namespace espalier
