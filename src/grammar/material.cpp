#include "grammar/material.h"

#include <cmath>

#include "base/check.h"

namespace espalier {

bool Material::looks_like(const Material& o) const {
  return color == o.color && roughness == o.roughness && metal == o.metal && opacity == o.opacity && glow == o.glow &&
         cutout == o.cutout && two_sided == o.two_sided && tiles == o.tiles && tiles_up == o.tiles_up &&
         metres == o.metres && texture == o.texture;
}

Material blend(const Material& a, const Material& b, float t) {
  const auto between = [t](float x, float y) { return x + (y - x) * t; };
  const Material& nearer = t < 0.5f ? a : b;
  Material out = nearer;
  out.color = a.color + (b.color - a.color) * t;
  out.roughness = between(a.roughness, b.roughness);
  out.metal = between(a.metal, b.metal);
  out.opacity = between(a.opacity, b.opacity);
  out.glow = between(a.glow, b.glow);
  if (!a.textured() || !b.textured()) return out;
  out.cutout = between(a.cutout, b.cutout);
  out.tiles = between(a.tiles, b.tiles);
  out.tiles_up = between(a.repeats().y, b.repeats().y);
  if (a.metres > 0 && b.metres > 0) out.metres = between(a.metres, b.metres);
  if (a.texture.kind != b.texture.kind || a.texture.kind == TextureKind::image) return out;
  for (std::size_t i = 0; i < out.texture.colors.size(); ++i)
    out.texture.colors[i] = a.texture.colors[i] + (b.texture.colors[i] - a.texture.colors[i]) * t;
  for (std::size_t i = 0; i < out.texture.numbers.size(); ++i)
    out.texture.numbers[i] = between(a.texture.numbers[i], b.texture.numbers[i]);
  return out;
}

void set_field(Material& material, MaterialField field, float value) {
  switch (field) {
    case MaterialField::roughness: material.roughness = value; return;
    case MaterialField::metal: material.metal = value; return;
    case MaterialField::opacity: material.opacity = value; return;
    case MaterialField::glow: material.glow = value; return;
    case MaterialField::cutout: material.cutout = value; return;
    case MaterialField::tiles: material.tiles = value; return;
    case MaterialField::tiles_up: material.tiles_up = value; return;
    case MaterialField::metres: material.metres = value; return;
    case MaterialField::texture: break;
  }
  const std::size_t number = static_cast<std::size_t>(field) - static_cast<std::size_t>(MaterialField::texture);
  CHECK(number < material.texture.numbers.size());
  material.texture.numbers[number] = value;
}

int MaterialRecipe::Slot::step_of(float value) const {
  if (!logarithmic) {
    const float step = (value - low) / per_step;
    return step > 0 ? step < kSteps ? static_cast<int>(step + 0.5f) : kSteps : 0;
  }
  int step = 0;
  // The border between two steps is their geometric mean.
  for (std::size_t i = 1; i < values.size(); ++i)
    step += value > 0 && value * value > values[i - 1] * values[i] ? 1 : 0;
  return step;
}

MaterialRecipe::Slot make_slot(MaterialField field, float low, float high, bool logarithmic) {
  constexpr int kSteps = MaterialRecipe::kSteps;
  MaterialRecipe::Slot slot;
  slot.field = field;
  slot.low = low;
  slot.per_step = (high - low) / kSteps;
  slot.logarithmic = logarithmic;
  // The 16th root of the ratio; square roots have the same bits everywhere.
  const double ratio = std::sqrt(std::sqrt(std::sqrt(std::sqrt(static_cast<double>(high) / low))));
  double power = low;
  for (int i = 0; i <= kSteps; ++i, power *= ratio)
    slot.values[static_cast<std::size_t>(i)] =
        logarithmic ? static_cast<float>(power) : low + (high - low) * (static_cast<float>(i) / kSteps);
  return slot;
}

Material MaterialRecipe::material(std::uint64_t steps) const {
  Material out = base;
  std::string name;
  for (std::size_t i = slots.size(); i-- > 0; steps /= kSteps + 1) {
    const std::uint64_t step = steps % (kSteps + 1);
    set_field(out, slots[i].field, slots[i].values[step]);
    name = "." + std::to_string(step) + name;
  }
  name[0] = '-';
  out.name += name;
  return out;
}

}  // namespace espalier
