#include "io/image.h"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "base/random.h"
#include "io/file.h"
#include "io/png.h"
#include "test_models.h"

namespace espalier {
namespace {

std::vector<std::uint8_t> noise(std::size_t n) {
  RandomStream random({1, Purpose::test});
  std::vector<std::uint8_t> bytes(n);
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.next_u32());
  return bytes;
}

std::vector<std::uint8_t> gradient(std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint8_t> rgb;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const std::uint32_t c : {x, y, x + y}) rgb.push_back(static_cast<std::uint8_t>(c));
    }
  }
  return rgb;
}

void expect_round_trip(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgb) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", width, height, rgb, test_provenance());
  int w = 0, h = 0, channels = 0;
  stbi_uc* pixels = stbi_load((folder / "a.png").c_str(), &w, &h, &channels, 0);
  ASSERT_NE(pixels, nullptr) << stbi_failure_reason();
  EXPECT_EQ(w, static_cast<int>(width));
  EXPECT_EQ(h, static_cast<int>(height));
  EXPECT_EQ(channels, 3);
  EXPECT_TRUE(std::equal(rgb.begin(), rgb.end(), pixels));
  stbi_image_free(pixels);
}

TEST(Png, AnotherReaderSeesTheSamePixels) {
  expect_round_trip(1, 1, {1, 2, 3});
  expect_round_trip(37, 11, noise(3 * 37 * 11));
  expect_round_trip(320, 200, gradient(320, 200));
}

TEST(Png, SmoothPicturesCompress) {
  EXPECT_LT(encode_png(320, 200, gradient(320, 200), "k", "").size(), 3u * 320 * 200 / 20);
}

TEST(Png, FindsItsText) {
  const std::string png = encode_png(1, 1, std::vector<std::uint8_t>(3), "espalier", "hello");
  EXPECT_EQ(find_png_text(png, "espalier"), "hello");
  EXPECT_EQ(find_png_text(png, "espa"), std::nullopt);
  EXPECT_EQ(find_png_text("hello", "espalier"), std::nullopt);
  std::string damaged = png;
  damaged[png.find("hello")] = 'j';
  EXPECT_EQ(find_png_text(damaged, "espalier"), std::nullopt);
}

TEST(Png, NamesTheFileThatCannotBeWritten) {
  EXPECT_EQ(error_of([] { write_png("/nowhere/a.png", 1, 1, std::vector<std::uint8_t>(3), {}); }),
            "/nowhere/a.png: cannot write: No such file or directory");
}

}  // namespace
}  // namespace espalier
