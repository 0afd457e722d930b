#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "render/render.h"

namespace espalier {
namespace {

/// How far from 4:3 a strip of so many columns is, and how much of it stays empty.
double fault_of(std::size_t frames, std::size_t columns, std::uint32_t width, std::uint32_t height) {
  const std::size_t rows = (frames + columns - 1) / columns;
  const double ratio = 3.0 * static_cast<double>(columns * width) / (4.0 * static_cast<double>(rows * height));
  const double off = std::max(ratio, 1 / ratio);
  return off + 12 * static_cast<double>(columns * rows - frames) / static_cast<double>(columns * rows);
}

}  // namespace

std::uint32_t strip_columns(std::size_t frames, std::uint32_t width, std::uint32_t height) {
  std::size_t best = 1;
  for (std::size_t columns = 2; columns <= frames; ++columns) {
    if (fault_of(frames, columns, width, height) <= fault_of(frames, best, width, height)) best = columns;
  }
  return static_cast<std::uint32_t>(best);
}

Picture empty_strip(std::size_t frames, const Picture& frame, std::uint32_t columns) {
  CHECK(frames > 0 && columns > 0);
  const std::size_t rows = (frames + columns - 1) / columns;
  Picture strip{columns * frame.width, static_cast<std::uint32_t>(rows * frame.height), {}};
  const std::size_t pixels = std::size_t{strip.width} * strip.height;
  // What stays empty takes the colour of the first frame's upper left corner.
  strip.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < 3 * pixels; ++i) strip.rgb[i] = frame.rgb[i % 3];
  if (!frame.alpha.empty()) strip.alpha.assign(pixels, 0);
  return strip;
}

void paste_frame(Picture& strip, const Picture& frame, std::size_t number, std::uint32_t columns) {
  CHECK(frame.alpha.empty() == strip.alpha.empty());
  const std::size_t left = number % columns * frame.width, top = number / columns * frame.height;
  CHECK(left + frame.width <= strip.width && top + frame.height <= strip.height);
  for (std::size_t row = 0; row < frame.height; ++row) {
    const std::size_t from = row * frame.width, to = left + (top + row) * strip.width;
    std::copy_n(frame.rgb.data() + 3 * from, 3 * frame.width, strip.rgb.data() + 3 * to);
    if (!frame.alpha.empty()) std::copy_n(frame.alpha.data() + from, frame.width, strip.alpha.data() + to);
  }
}

}  // namespace espalier
