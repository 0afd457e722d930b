#include <cmath>

#include <gtest/gtest.h>

#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"
#include "render/texture_sampler.h"
#include "test_scenes.h"

namespace espalier {
namespace {

Image checks(std::uint32_t size) {
  Image image{size, size, {}};
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const std::uint8_t c = (x + y) % 2 ? 255 : 0;
      image.rgba.insert(image.rgba.end(), {c, c, c, static_cast<std::uint8_t>(x < size / 2 ? 255 : 0)});
    }
  }
  return image;
}

TEST(TextureSampler, IsExactAtTexelCentresAndRepeats) {
  const TextureSampler sampler(checks(8));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5f) / 8, 1 - (static_cast<float>(y) + 0.5f) / 8);
      EXPECT_NEAR(sampler.at(uv).color.x, (x + y) % 2 ? 1 : 0, 1e-4f);
      EXPECT_NEAR(sampler.at(uv).alpha, x < 4 ? 1 : 0, 1e-4f);
      EXPECT_NEAR(sampler.at(uv + Vec2(3, -5)).color.x, sampler.at(uv).color.x, 1e-4f);
    }
  }
  EXPECT_NEAR(sampler.at({0, 0.5f / 8}).alpha, 0.5f, 1e-4f) << "half of each edge";
}

TEST(TextureSampler, FarAwayIsTheMeanLight) {
  const TextureSampler sampler(checks(64));
  EXPECT_NEAR(sampler.at({0.3f, 0.7f}, 0.2f).color.x, 0.5f, 0.01f) << "half of the light, not of the byte";
  const auto all = sampler.at({0.3f, 0.7f}, 10);
  EXPECT_NEAR(all.alpha, 0.5f, 0.01f);
}

TEST(TextureSampler, OddAndThinPicturesAreFine) {
  for (const auto& [w, h] : {std::pair(1u, 1u), std::pair(1u, 7u), std::pair(5u, 3u), std::pair(5000u, 1u)}) {
    Image image{w, h, std::vector<std::uint8_t>(std::size_t{4} * w * h, 255)};
    const TextureSampler sampler(image);
    for (const float f : {0.0f, 0.1f, 1.0f, 100.0f}) EXPECT_NEAR(sampler.at({-3.7f, 12.2f}, f).color.y, 1, 1e-4f);
  }
}

struct Drawn {
  Picture picture;
  std::size_t changed = 0;  // pixels that differ from the empty stage
};

/// A quad of that material, seen from ahead.
Drawn draw(const std::string& material, const std::string& mesh = "quad",
           std::unique_ptr<Executor> executor = make_serial_executor()) {
  const std::string text = "grammar q 1\nmaterial m = " + material + "\nstart S\nrule S { paint m  emit " + mesh +
                           "  move (1.2, 0, 0)  paint surface(\"#808080\")  emit box }\n";
  const auto graph = compile_grammar({"q.esp", text, {}}).graph;
  EXPECT_TRUE(graph) << text;
  RandomStream random({1, Purpose::test, 0, 0});
  Model model;
  Expander(*graph).expand(sample(*graph, random, 100).derivation, ExpandTo::full, model);
  const MeshTable meshes = test::meshes_of(*graph);
  TextureTable textures;
  RenderSettings settings = small_settings();
  settings.azimuth_deg = 0, settings.elevation_deg = 5;
  Drawn out;
  const Surfaces surfaces(*graph, model, textures);
  out.picture = render(model, meshes, surfaces, {}, settings, *executor);
  Model without = model;
  without.instances.erase(without.instances.begin());
  without.instances.push_back(model.instances[0]);
  without.instances.back().model_from_mesh.basis = Mat3(0.0f);  // keeps the frame of the picture, shows nothing
  for (const float side : {-0.5f, 0.5f}) {
    without.instances.push_back(without.instances.back());
    without.instances.back().model_from_mesh.origin = {side, side, 0};
  }
  const Picture empty = render(without, meshes, surfaces, {}, settings, *executor);
  for (std::uint32_t y = 0; y < settings.height; ++y) {
    for (std::uint32_t x = 0; x < settings.width; ++x) out.changed += difference(out.picture, empty, x, y) > 24;
  }
  return out;
}

TEST(TextureRender, ACutOutLeafHidesLessThanItsQuad) {
  const std::size_t full = draw("surface(\"#305020\")").changed;
  const std::size_t leaf =
      draw("surface(\"#ffffff\", cutout: 0.5, texture: leaf_texture(\"#305020\", \"#305020\"))").changed;
  const std::size_t narrow =
      draw("surface(\"#ffffff\", cutout: 0.5, texture: leaf_texture(\"#305020\", \"#305020\", width: 0.2))").changed;
  EXPECT_GT(full, 1500u);
  EXPECT_LT(leaf, 0.75 * static_cast<double>(full));
  EXPECT_GT(leaf, 0.1 * static_cast<double>(full));
  EXPECT_LT(narrow, leaf);
}

TEST(TextureRender, BlendingHidesAsMuchAsCuttingOut) {
  const auto cut = draw("surface(\"#ffffff\", cutout: 0.5, texture: leaf_texture(\"#305020\", \"#305020\"))").changed;
  const auto blended = draw("surface(\"#ffffff\", texture: leaf_texture(\"#305020\", \"#305020\"))").changed;
  EXPECT_NEAR(static_cast<double>(blended), static_cast<double>(cut), 0.35 * static_cast<double>(cut));
}

TEST(TextureRender, OpacityBelowTheCutoutIsNothing) {
  const Drawn gone = draw("surface(\"#305020\", opacity: 0.3, cutout: 0.5)");
  EXPECT_LT(gone.changed, 60u);
  EXPECT_GT(draw("surface(\"#305020\", opacity: 0.6, cutout: 0.5)").changed, 1500u);
}

TEST(TextureRender, TexturesShowTheirColours) {
  const Picture plain = draw("surface(\"#ffffff\")", "box").picture;
  const Picture red =
      draw("surface(\"#ffffff\", texture: noise_texture(\"#ff0000\", \"#ff0000\"))", "box").picture;
  std::size_t reddish = 0;
  for (std::size_t i = 0; i < red.rgb.size(); i += 3)
    reddish += red.rgb[i] > 90 && red.rgb[i + 1] < red.rgb[i] / 2 && plain.rgb[i + 1] > 90;
  EXPECT_GT(reddish, 1000u);
}

TEST(TextureRender, SameBytesForAnyNumberOfThreads) {
  const std::string material = "surface(\"#ffffff\", cutout: 0.4, texture: leaf_texture(), tiles: 3)";
  EXPECT_EQ(draw(material).picture.rgb, draw(material, "quad", make_thread_executor(3)).picture.rgb);
}

}  // namespace
}  // namespace espalier
