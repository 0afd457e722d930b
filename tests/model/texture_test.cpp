#include "model/texture.h"

#include <cstdlib>
#include <span>

#include <gtest/gtest.h>

#include "base/hash.h"
#include "grammar/surface_arguments.h"

namespace espalier {
namespace {

std::string hash_of(const Image& image) {
  return content_hash({reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size()});
}

TextureRef with(TextureKind kind, std::initializer_list<std::pair<std::string_view, float>> numbers) {
  TextureRef out = default_texture(kind);
  const auto all = texture_numbers(kind);
  for (const auto& [name, value] : numbers) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].name == name) out.numbers[i] = value;
  }
  return out;
}

/// Mean difference of the colours of two rows or columns.
double difference(const Image& image, bool rows, std::uint32_t a, std::uint32_t b) {
  double sum = 0;
  for (std::uint32_t i = 0; i < image.width; ++i) {
    const std::uint8_t* p = rows ? image.pixel(i, a) : image.pixel(a, i);
    const std::uint8_t* q = rows ? image.pixel(i, b) : image.pixel(b, i);
    for (int c = 0; c < 3; ++c) sum += std::abs(p[c] - q[c]);
  }
  return sum / (3.0 * image.width);
}

TEST(Texture, BytesAreTheSameEverywhere) {
  // Fixed hashes: whoever changes a texture changes what old models look like, and says so in the changelog.
  const TextureRef leaf = with(TextureKind::leaf, {{"lobes", 0.5f}, {"wilt", 0.5f}});
  const TextureRef noise = with(TextureKind::noise, {{"warp", 0.7f}, {"ridges", 0.5f}});
  EXPECT_EQ(hash_of(make_texture(default_texture(TextureKind::bark), 64)), "864524a353d9abf571ff3a2f7fb90e96");
  EXPECT_EQ(hash_of(make_texture(leaf, 64)), "d5f66d7f947c296979e27788afd89592");
  EXPECT_EQ(hash_of(make_texture(noise, 64)), "e5453818672f342587859f545538cbfa");
}

TEST(Texture, BarkAndNoiseContinueOverTheirEdges) {
  const TextureRef textures[] = {
      default_texture(TextureKind::bark), with(TextureKind::bark, {{"bands", 1}, {"furrows", 3}, {"cracks", 1}}),
      default_texture(TextureKind::noise), with(TextureKind::noise, {{"warp", 1}, {"stretch", 16}, {"cells", 16}})};
  for (const TextureRef& texture : textures) {
    const Image image = make_texture(texture, 256);
    for (const bool rows : {true, false}) {
      double inside = 0, most = 0;
      for (std::uint32_t i = 0; i + 1 < 256; ++i) {
        const double step = difference(image, rows, i, i + 1);
        inside += step / 255;
        most = std::max(most, step);
      }
      const double seam = difference(image, rows, 255, 0);
      EXPECT_LE(seam, 1.2 * most) << "the step over the edge is like those inside";
      EXPECT_LT(seam, 2.5 * inside);
    }
  }
}

TEST(Texture, LeafIsOpaqueInTheMiddleAndNothingAround) {
  const Image image = make_texture(default_texture(TextureKind::leaf), 128);
  EXPECT_EQ(image.pixel(64, 64)[3], 255);
  std::size_t solid = 0;
  for (std::uint32_t i = 0; i < 128; ++i) {
    EXPECT_EQ(image.pixel(0, i)[3], 0);
    EXPECT_EQ(image.pixel(127, i)[3], 0);
    EXPECT_EQ(image.pixel(i, 0)[3], 0);
  }
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) solid += image.rgba[i] >= 128;
  const double share = static_cast<double>(solid) / (128 * 128);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.5);
}

TEST(Texture, EveryArgumentChangesThePicture) {
  for (const TextureKind kind : {TextureKind::bark, TextureKind::leaf, TextureKind::noise}) {
    const auto numbers = texture_numbers(kind);
    TextureRef base = default_texture(kind);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      TextureRef low = base, high = base;
      low.numbers[i] = numbers[i].low, high.numbers[i] = numbers[i].high;
      EXPECT_NE(hash_of(make_texture(low, 48)), hash_of(make_texture(high, 48))) << name_of(kind) << numbers[i].name;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      TextureRef other = base;
      other.colors[i] = Vec3(0.2f, 0.9f, 0.4f);
      EXPECT_NE(hash_of(make_texture(base, 48)), hash_of(make_texture(other, 48))) << name_of(kind);
    }
  }
}

TEST(Texture, ExtremesAreFine) {
  for (const TextureKind kind : {TextureKind::bark, TextureKind::leaf, TextureKind::noise}) {
    const auto numbers = texture_numbers(kind);
    for (unsigned corner = 0; corner < 1u << numbers.size(); ++corner) {
      TextureRef texture = default_texture(kind);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        texture.numbers[i] = corner >> i & 1 ? numbers[i].high : numbers[i].low;
      const Image image = make_texture(texture, corner % 3 + 1);
      EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
    }
  }
}

}  // namespace
}  // namespace espalier
