#include "io/drawing_import.h"

#include <cstring>
#include <memory>

#include <fmt/core.h>
#include <stb_image.h>

#include "base/error.h"
#include "io/child_process.h"
#include "io/file.h"
#include "io/image_format.h"
#include "io/png.h"
#include "model/image.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMostBytes = 512ull << 20;

template <class T>
struct Free {
  void operator()(T* pixels) const { stbi_image_free(pixels); }
};

struct RasterHeader {
  std::uint32_t width, height, bytes;  // per sample: 1 or 2
};

template <class T>
std::string packed(const T* pixels, int width, int height) {
  const RasterHeader header{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), sizeof(T)};
  std::string out(reinterpret_cast<const char*>(&header), sizeof header);
  out.append(reinterpret_cast<const char*>(pixels), 4 * sizeof(T) * header.width * header.height);
  return out;
}

/// Runs in the child: a header, then red, green, blue and alpha of every pixel.
std::string decode(const std::string& file) {
  const auto* const data = reinterpret_cast<const stbi_uc*>(file.data());
  const int size = static_cast<int>(file.size());
  int width = 0, height = 0, channels = 0;
  const auto damaged = [] { return Error(fmt::format("it is damaged ({})", stbi_failure_reason())); };
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) throw damaged();
  check_image_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
  if (stbi_is_16_bit_from_memory(data, size)) {
    const std::unique_ptr<stbi_us, Free<stbi_us>> pixels(
        stbi_load_16_from_memory(data, size, &width, &height, &channels, 4));
    if (!pixels) throw damaged();
    return packed(pixels.get(), width, height);
  }
  const std::unique_ptr<stbi_uc, Free<stbi_uc>> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4));
  if (!pixels) throw damaged();
  return packed(pixels.get(), width, height);
}

template <class T>
void fill(Drawing& drawing, std::string_view pixels) {
  const std::size_t count = std::size_t{drawing.width} * drawing.height;
  constexpr float kWhite = sizeof(T) == 1 ? 255 : 65535;
  drawing.values.resize(count), drawing.alpha.resize(count);
  bool opaque = true;
  for (std::size_t i = 0; i < count; ++i) {
    T rgba[4];
    std::memcpy(rgba, pixels.data() + i * sizeof rgba, sizeof rgba);
    const bool middle =
        sizeof(T) == 1 && rgba[0] == rgba[1] && rgba[1] == rgba[2] && (rgba[0] == 127 || rgba[0] == 128);
    drawing.values[i] = middle ? 0.5f : luma(rgba[0], rgba[1], rgba[2]) / kWhite;
    drawing.alpha[i] = rgba[3] / kWhite;
    opaque = opaque && drawing.alpha[i] == 1;
  }
  if (opaque) drawing.alpha.clear();
}

Drawing parse_raster(const std::string& file) {
  const ChildLimits limits{.most_memory = 3ull << 30, .most_seconds = 120};
  const std::string raster = run_in_child([&] { return decode(file); }, limits);
  RasterHeader header;
  if (raster.size() < sizeof header) throw Error("it is damaged");
  std::memcpy(&header, raster.data(), sizeof header);
  const std::string_view pixels = std::string_view(raster).substr(sizeof header);
  if (pixels.empty() || pixels.size() != std::uint64_t{4} * header.bytes * header.width * header.height)
    throw Error("it is damaged");
  Drawing drawing{header.width, header.height, false, {}, {}};
  header.bytes == 1 ? fill<std::uint8_t>(drawing, pixels) : fill<std::uint16_t>(drawing, pixels);
  return drawing;
}

Drawing parse_drawing(const std::string& file) {
  const auto begins = [&](std::string_view with) { return file.starts_with(with); };
  if (file.empty()) throw Error("it is empty");
  if (begins("PF\n") || begins("Pf\n") || begins("PF ") || begins("Pf ") || begins("PF\r") || begins("Pf\r"))
    return parse_pfm(file);
  if (begins(kPngSignature) || begins("\xff\xd8\xff")) return parse_raster(file);
  throw Error("it is neither PNG nor JPG nor PFM");
}

}  // namespace

void check_image_size(std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0) throw Error("it has no pixels");
  if (width > Image::kMostSide || height > Image::kMostSide || width * height > Image::kMostPixels)
    throw Error(fmt::format("it has {} x {} pixels; at most {} a side and {} in all are read", width, height,
                            Image::kMostSide, Image::kMostPixels));
}

Drawing load_drawing(const std::string& path) {
  const std::string file = read_file(path, kMostBytes);
  try {
    return parse_drawing(file);
  } catch (const Error& e) {
    throw Error(fmt::format("{}: cannot be used as an image: {}", path, e.what()));
  }
}

}  // namespace espalier
