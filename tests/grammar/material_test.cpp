#include "grammar/material.h"

#include <cmath>

#include <gtest/gtest.h>

#include "compiled.h"
#include "grammar/compiler.h"
#include "grammar/surface_arguments.h"
#include "grammar/words.h"

namespace espalier {
namespace {

using test::compiled;

TEST(SurfaceArguments, AgreeWithTheWordsOfTheLanguage) {
  int seen = 0;
  for (const Builtin& builtin : builtins()) {
    if (builtin.sort != BuiltinSort::surface && builtin.sort != BuiltinSort::texture) continue;
    std::string labels;
    for (const SurfaceArgument& one : surface_arguments(builtin.name))
      labels += (labels.empty() ? "" : " ") + std::string(one.name);
    EXPECT_EQ(labels, builtin.labels) << builtin.name;
    EXPECT_EQ(static_cast<int>(surface_arguments(builtin.name).size()), builtin.most) << builtin.name;
    ++seen;
  }
  EXPECT_EQ(seen, 5);
}

TEST(Recipe, StepsAreTheNearestValues) {
  for (const bool logarithmic : {false, true}) {
    const auto slot = make_slot(MaterialField::tiles, 0.25f, 64, logarithmic);
    EXPECT_FLOAT_EQ(slot.values.front(), 0.25f);
    EXPECT_FLOAT_EQ(slot.values.back(), 64);
    for (int i = 0; i <= MaterialRecipe::kSteps; ++i) EXPECT_EQ(slot.step_of(slot.values[i]), i);
    for (float x = 0.2f; x < 70; x *= 1.037f) {
      const int step = slot.step_of(x);
      const auto away = [&](int i) {
        return logarithmic ? std::abs(std::log(x / slot.values[i])) : std::abs(x - slot.values[i]);
      };
      for (int i = 0; i <= MaterialRecipe::kSteps; ++i) EXPECT_LE(away(step), away(i) + 1e-4f) << x;
    }
    EXPECT_EQ(slot.step_of(-5), 0);
    EXPECT_EQ(slot.step_of(NAN), 0);
    EXPECT_EQ(slot.step_of(INFINITY), MaterialRecipe::kSteps);
  }
}

TEST(Recipe, UnpacksItsSteps) {
  MaterialRecipe recipe;
  recipe.base.name = "skin";
  recipe.slots = {make_slot(MaterialField::roughness, 0, 1, false), make_slot(MaterialField::metal, 0, 1, false)};
  const Material made = recipe.material(4 * 17 + 16);
  EXPECT_FLOAT_EQ(made.roughness, 0.25f);
  EXPECT_FLOAT_EQ(made.metal, 1);
  EXPECT_EQ(made.name, "skin-4.16");
}

TEST(Surface, ConstantsAreMaterialsAndTheRestRecipes) {
  const auto graph = compiled(R"(grammar m 1
material plain = surface("#ffffff", 0.5, cutout: 0.25, two_sided: true, tiles: 2,
                         texture: leaf_texture("#ff0000", width: 0.5, veins: 3))
material varying = surface("#ffffff", roughness: wet, texture: noise_texture(cells: 1 + 8 * wet, seed: 3))
start S
rule S { wet ~ uniform(0, 1)  paint plain  emit box  paint varying  emit box  spawn T }
rule T { paint varying  emit box }
)");
  ASSERT_EQ(graph->recipes.size(), 1u) << "one declaration, used twice";
  const MaterialRecipe& recipe = graph->recipes[0];
  ASSERT_EQ(recipe.slots.size(), 2u);
  EXPECT_EQ(recipe.base.name, "varying");
  EXPECT_EQ(graph->materials[recipe.middle].roughness, 0.5f);
  EXPECT_EQ(recipe.slots[1].values[0], 1);
  EXPECT_EQ(recipe.slots[1].values[16], 64);
  const auto plain = std::find_if(graph->materials.begin(), graph->materials.end(),
                                  [](const Material& m) { return m.name == "plain"; });
  ASSERT_NE(plain, graph->materials.end());
  EXPECT_EQ(plain->texture.kind, TextureKind::leaf);
  EXPECT_EQ(plain->texture.colors[0], Vec3(1, 0, 0));
  EXPECT_EQ(plain->texture.numbers[0], 0.5f);
  EXPECT_EQ(plain->texture.numbers[4], 3);
  EXPECT_EQ(plain->cutout, 0.25f);
  EXPECT_TRUE(plain->two_sided);
  EXPECT_EQ(plain->repeats(), Vec2(2, 2));
}

TEST(Surface, MixBlendsTexturesOfOneKind) {
  Material a, b;
  a.texture = b.texture = default_texture(TextureKind::bark);
  a.texture.numbers[0] = 2, b.texture.numbers[0] = 10;
  a.texture.colors[0] = Vec3(0), b.texture.colors[0] = Vec3(1);
  const Material half = blend(a, b, 0.5f);
  EXPECT_EQ(half.texture.numbers[0], 6);
  EXPECT_EQ(half.texture.colors[0], Vec3(0.5f));
  b.texture = default_texture(TextureKind::leaf);
  EXPECT_EQ(blend(a, b, 0.25f).texture, a.texture);
  EXPECT_EQ(blend(a, b, 0.75f).texture, b.texture);
}

}  // namespace
}  // namespace espalier
