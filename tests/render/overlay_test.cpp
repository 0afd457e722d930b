#include "render/overlay.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace espalier {
namespace {

Colour at(const Picture& picture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = picture.rgb.data() + 3 * (x + picture.width * y);
  return {{p[0], p[1], p[2]}};
}

MarkedPixels row_of(std::vector<Mark> marks) {
  MarkedPixels pixels{static_cast<std::uint32_t>(marks.size()), 1, std::move(marks), {}};
  pixels.degrees.assign(pixels.marks.size(), 255);
  return pixels;
}

TEST(Overlay, EnlargesByTheLargestWholeFactor) {
  MarkedPixels pixels{30, 20, {}, {}};
  pixels.marks.assign(600, Mark::free), pixels.degrees.assign(600, 255);
  EXPECT_EQ(draw_marks(pixels, 100).width, 90u);
  EXPECT_EQ(draw_marks(pixels, 100).height, 60u);
  EXPECT_EQ(draw_marks(pixels, 30).width, 30u);
  EXPECT_EQ(fit_marks(pixels, 100).width, 100u);
  EXPECT_EQ(fit_marks(pixels, 100).height, 66u);
  EXPECT_EQ(draw_marks(pixels, 15).width, 15u) << "made smaller";
  EXPECT_EQ(draw_marks(pixels, 1).height, 1u);
}

TEST(Overlay, EveryPixelHasTheColourOfItsMark) {
  const std::vector<Mark> marks = {Mark::hit, Mark::missed, Mark::spilled, Mark::covered, Mark::free};
  const Picture picture = draw_marks(row_of(marks), 50);
  ASSERT_EQ(picture.width, 50u);
  for (std::uint32_t i = 0; i < marks.size(); ++i) EXPECT_EQ(at(picture, 10 * i + 5, 5), colour_of(marks[i])) << i;
}

TEST(Overlay, WhatIsWantedLessIsPaler) {
  MarkedPixels pixels = row_of({Mark::hit, Mark::hit, Mark::hit});
  pixels.degrees = {255, 100, 1};
  const Picture picture = draw_marks(pixels, 3);
  EXPECT_LT(at(picture, 0, 0).rgb[0], at(picture, 1, 0).rgb[0]);
  EXPECT_LT(at(picture, 1, 0).rgb[0], at(picture, 2, 0).rgb[0]);
}

TEST(Overlay, ALineShowsTheBorderOfWhatIsWantedOnceThereIsRoom) {
  const MarkedPixels pixels = row_of({Mark::free, Mark::missed, Mark::hit, Mark::spilled});
  const Picture large = draw_marks(pixels, 40);
  EXPECT_NE(at(large, 10, 5), colour_of(Mark::missed)) << "left edge";
  EXPECT_EQ(at(large, 19, 5), colour_of(Mark::missed)) << "none between missed and hit";
  EXPECT_NE(at(large, 29, 5), colour_of(Mark::hit)) << "right edge";
  EXPECT_EQ(at(large, 30, 5), colour_of(Mark::spilled)) << "outside there is none";
  EXPECT_EQ(at(draw_marks(pixels, 4), 1, 0), colour_of(Mark::missed));
}

TEST(Overlay, SmallerOnesAreMeans) {
  MarkedPixels pixels{64, 64, {}, {}};
  for (int i = 0; i < 64 * 64; ++i) pixels.marks.push_back(i % 2 ? Mark::hit : Mark::free);
  pixels.degrees.assign(pixels.marks.size(), 255);
  const Colour grey = at(fit_marks(pixels, 8), 3, 3), hit = colour_of(Mark::hit);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey.rgb[c], (255 + hit.rgb[c]) / 2, 3);
}

// What people see who lack one kind of cones: Vienot, Brettel and Mollon (1999), on linear light, for red and green;
// for blue the matrix that goes with Brettel's planes for it.
using Matrix = double[3][3];
constexpr Matrix kNoRed = {{0.11238, 0.88762, 0}, {0.11238, 0.88762, 0}, {0.00401, -0.00401, 1}};
constexpr Matrix kNoGreen = {{0.29275, 0.70725, 0}, {0.29275, 0.70725, 0}, {-0.02234, 0.02234, 1}};
constexpr Matrix kNoBlue = {{1.01277, 0.13548, -0.14826}, {-0.01243, 0.86812, 0.14431}, {0.07589, 0.80500, 0.11911}};
constexpr Matrix kAll = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::array<double, 3> lab(const Colour& colour, const Matrix& eyes) {
  double light[3], seen[3];
  for (int c = 0; c < 3; ++c) {
    const double s = colour.rgb[c] / 255.0;
    light[c] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  for (int c = 0; c < 3; ++c)
    seen[c] = std::max(0.0, eyes[c][0] * light[0] + eyes[c][1] * light[1] + eyes[c][2] * light[2]);
  const double x = (0.4124 * seen[0] + 0.3576 * seen[1] + 0.1805 * seen[2]) / 0.9505;
  const double y = 0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2];
  const double z = (0.0193 * seen[0] + 0.1192 * seen[1] + 0.9505 * seen[2]) / 1.089;
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

TEST(Overlay, AllEyesTellItsColoursApart) {
  const Mark marks[] = {Mark::free, Mark::missed, Mark::hit, Mark::spilled, Mark::covered};
  for (const Matrix* eyes : {&kAll, &kNoRed, &kNoGreen, &kNoBlue}) {
    for (const Mark a : marks) {
      for (const Mark b : marks) {
        if (a >= b) continue;
        const auto p = lab(colour_of(a), *eyes), q = lab(colour_of(b), *eyes);
        const double difference = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        EXPECT_GT(difference, 20) << static_cast<int>(a) << " and " << static_cast<int>(b);  // 2 can just be seen
      }
    }
  }
}

TEST(Overlay, LegendsHaveRoomForTheirWords) {
  const Picture small = draw_marks(row_of({Mark::hit, Mark::missed}), 2);
  const Picture sheet = with_legend(small, "title", {{{colour_of(Mark::spilled)}, "spilled: 12 pixels"}, {{}, "more"}});
  EXPECT_GE(sheet.width, 480u);
  const auto has = [&](const Colour& colour) {
    for (std::uint32_t y = 0; y < sheet.height; ++y)
      for (std::uint32_t x = 0; x < sheet.width; ++x)
        if (at(sheet, x, y) == colour) return true;
    return false;
  };
  EXPECT_TRUE(has(colour_of(Mark::spilled)));
  EXPECT_TRUE(has(colour_of(Mark::hit)));
  EXPECT_TRUE(has(kInk));
}

TEST(Paint, StaysWithinThePicture) {
  Picture picture = blank(4, 3, kPaper);
  fill_box(picture, -5, -5, 100, 6, kInk);
  EXPECT_EQ(at(picture, 3, 0), kInk);
  EXPECT_EQ(at(picture, 3, 1), kPaper);
  draw_line(picture, -3, 2, 10, 2, kFaintInk);
  EXPECT_EQ(at(picture, 0, 2), kFaintInk);
  EXPECT_EQ(at(picture, 3, 2), kFaintInk);
  paste(picture, blank(2, 2, kFrame), 3, -1);
  EXPECT_EQ(at(picture, 3, 0), kFrame);
  paste(picture, blank(2, 2, kInk), 4, 0);
  paste(picture, blank(2, 2, kInk), -2, 0);
  EXPECT_EQ(at(picture, 3, 0), kFrame);
  EXPECT_EQ(hex_of({{31, 95, 208}}), "#1f5fd0");
}

}  // namespace
}  // namespace espalier
