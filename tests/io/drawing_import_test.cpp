#include "io/drawing_import.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/file.h"
#include "io/png.h"
#include "test_models.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void put_u32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
}

/// PNG chunks by the letter of the standard, with a checksum worked out bit by bit.
std::string chunk(const std::string& type, const std::string& data) {
  std::string out;
  put_u32(out, static_cast<std::uint32_t>(data.size()));
  std::uint32_t crc = 0xffffffff;
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  out += type + data;
  put_u32(out, ~crc);
  return out;
}

/// One row of 16-bit samples; colour type 0 grey, 2 colour, 4 grey with alpha.
std::string png16(std::uint32_t width, char colour_type, const std::vector<std::uint16_t>& samples) {
  std::string row(1, '\0');  // no filter
  for (const std::uint16_t s : samples) row += static_cast<char>(s >> 8), row += static_cast<char>(s & 0xff);
  std::uint32_t a = 1, b = 0;
  for (const char c : row) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  const auto size = static_cast<std::uint16_t>(row.size());
  std::string stored("\x78\x01\x01", 3);
  for (const std::uint16_t n : {size, static_cast<std::uint16_t>(~size)})
    stored += static_cast<char>(n & 0xff), stored += static_cast<char>(n >> 8);
  stored += row;
  put_u32(stored, b << 16 | a);
  std::string header;
  put_u32(header, width), put_u32(header, 1);
  header += '\x10', header += colour_type, header += std::string(3, '\0');
  return std::string(kPngSignature) + chunk("IHDR", header) + chunk("IDAT", stored) + chunk("IEND", "");
}

Drawing load(const std::string& bytes) {
  const TemporaryFolder folder;
  write_file(folder / "d.img", bytes);
  return load_drawing(folder / "d.img");
}

std::string message(const std::string& bytes) {
  try {
    load(bytes);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::string pfm(const std::string& header, const std::vector<float>& values, bool little_endian = true) {
  std::string out = header;
  for (const float v : values) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    for (int i = 0; i < 4; ++i) out += static_cast<char>(bits >> 8 * (little_endian ? i : 3 - i) & 0xff);
  }
  return out;
}

TEST(Drawing, SixteenBitGreysLoseNothing) {
  std::vector<std::uint16_t> samples;
  for (std::uint32_t i = 0; i < 4096; ++i) samples.push_back(static_cast<std::uint16_t>(i * 16 + i % 16));
  const Drawing drawing = load(png16(4096, 0, samples));
  EXPECT_EQ(drawing.width, 4096u);
  EXPECT_EQ(drawing.height, 1u);
  EXPECT_FALSE(drawing.signed_weights);
  EXPECT_TRUE(drawing.alpha.empty());
  for (std::size_t i = 0; i < samples.size(); ++i)
    ASSERT_EQ(std::lround(drawing.values[i] * 65535.0), samples[i]) << "two values became one";
}

TEST(Drawing, SixteenBitColourAndAlpha) {
  const Drawing colour = load(png16(2, 2, {65535, 0, 0, 0, 65535, 65535}));
  EXPECT_NEAR(colour.values[0], 0.2126, 1e-6);
  EXPECT_NEAR(colour.values[1], 0.7874, 1e-6);
  const Drawing seen_through = load(png16(2, 4, {1000, 65535, 2000, 13107}));
  ASSERT_EQ(seen_through.alpha.size(), 2u);
  EXPECT_EQ(seen_through.alpha[0], 1);
  EXPECT_NEAR(seen_through.alpha[1], 0.2, 1e-7);
}

TEST(Drawing, EightBitGreysHaveAMiddle) {
  const std::vector<std::uint8_t> rgb = {0, 0, 0, 127, 127, 127, 128, 128, 128, 255, 255, 255, 128, 127, 128};
  const Drawing drawing = load(encode_png(5, 1, rgb, "t", ""));
  EXPECT_EQ(drawing.values[0], 0);
  EXPECT_EQ(drawing.values[1], 0.5f);
  EXPECT_EQ(drawing.values[2], 0.5f);
  EXPECT_EQ(drawing.values[3], 1);
  EXPECT_NE(drawing.values[4], 0.5f) << "no grey";
}

TEST(Drawing, PfmInEitherByteOrderBottomRowFirst) {
  const std::vector<float> values = {-3, 0.25f, 1e6f, 4, -0.0f, 6};
  for (const bool little : {true, false}) {
    const Drawing drawing = load(pfm(little ? "Pf\n3 2\n-1.0\n" : "Pf 3 2 2.5\n", values, little));
    EXPECT_TRUE(drawing.signed_weights);
    EXPECT_EQ(drawing.width, 3u);
    EXPECT_EQ(drawing.height, 2u);
    EXPECT_THAT(drawing.values, ElementsAre(4, 0, 6, -3, 0.25f, 1e6f));
  }
}

TEST(Drawing, ColourPfmCountsByLuma) {
  const Drawing drawing = load(pfm("PF\n2 1\n-1\n", {-2, -2, -2, 1, 0, -1}));
  EXPECT_EQ(drawing.values[0], -2) << "exact where all three are equal";
  EXPECT_NEAR(drawing.values[1], 0.2126 - 0.0722, 1e-6);
}

TEST(Drawing, ValuesThatAreNoWeightsAreNamed) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const auto with = [](float bad) { return message(pfm("Pf\n2 2\n-1\n", {0, bad, 1, 2})); };
  EXPECT_THAT(with(nan), HasSubstr("d.img: cannot be used as an image: column 1 of row 1 (from the top) must be"));
  EXPECT_THAT(with(inf), HasSubstr("got inf"));
  EXPECT_THAT(with(-2e6f), HasSubstr("at most 1000000, got -2000000"));
  EXPECT_EQ(with(-1e6f), "");
}

TEST(Drawing, DamagedFilesAreNamed) {
  const std::string good = pfm("Pf\n2 2\n-1\n", {0, 1, 2, 3});
  EXPECT_EQ(message(good), "");
  EXPECT_THAT(message(good.substr(0, good.size() - 1)), HasSubstr("15 bytes of pixels instead of 16"));
  EXPECT_THAT(message(good + "x"), HasSubstr("17 bytes of pixels instead of 16"));
  EXPECT_THAT(message("Pf\n2 2"), HasSubstr("header is cut short"));
  EXPECT_THAT(message("Pf\n"), HasSubstr("header is cut short"));
  EXPECT_THAT(message("Pf\n2 x\n-1\n0000"), HasSubstr("its height must be a whole number, got \"x\""));
  EXPECT_THAT(message("Pf\n-2 2\n-1\n0000"), HasSubstr("its width must be a whole number, got \"-2\""));
  EXPECT_THAT(message("Pf\n0 2\n-1\n"), HasSubstr("it has no pixels"));
  EXPECT_THAT(message("Pf\n1 1\n0\n0000"), HasSubstr("its scale must be"));
  EXPECT_THAT(message("Pf\n1 1\nnan\n0000"), HasSubstr("its scale must be"));
  EXPECT_THAT(message("Pf\n99999 1\n-1\n"), HasSubstr("at most 16384 a side"));
  EXPECT_THAT(message("Pf\n16000 16000\n-1\n"), HasSubstr("in all are read"));
  EXPECT_THAT(message("Pf\n" + std::string(500, '1') + " 1\n"), HasSubstr("damaged"));
  EXPECT_THAT(message(""), HasSubstr("it is empty"));
  EXPECT_THAT(message("GIF89a"), HasSubstr("neither PNG nor JPG nor PFM"));
}

TEST(Drawing, AnyByteOfAPngMayBeWrong) {
  const std::string good = png16(8, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(message(good), "");
  for (std::size_t at = 0; at < good.size(); at += 3) {
    std::string bad = good;
    bad[at] = static_cast<char>(~bad[at]);
    message(bad);  // an error or a drawing, never a crash
  }
  EXPECT_THAT(message(good.substr(0, good.size() / 2)), HasSubstr("d.img: cannot be used as an image"));
}

}  // namespace
}  // namespace espalier
