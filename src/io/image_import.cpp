#include "io/image_import.h"

#include <cstring>
#include <string_view>

#include <fmt/core.h>
#include <stb_image.h>

#include "base/error.h"
#include "io/child_process.h"
#include "io/file.h"
#include "io/png.h"

namespace espalier {
namespace {

std::string ending_of(std::string_view bytes) {
  if (bytes.starts_with(kPngSignature)) return "png";
  if (bytes.starts_with("\xff\xd8\xff")) return "jpg";
  throw Error("it is neither PNG nor JPG");
}

/// Runs in the child: width and height, then the pixels. Errors do not name the file.
std::string decode(const std::string& bytes) {
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const auto damaged = [] { return Error(fmt::format("it is damaged ({})", stbi_failure_reason())); };
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) throw damaged();
  const auto w = static_cast<std::uint64_t>(width), h = static_cast<std::uint64_t>(height);
  if (w > Image::kMostSide || h > Image::kMostSide || w * h > Image::kMostPixels)
    throw Error(fmt::format("it has {} x {} pixels; at most {} a side and {} in all are read", w, h, Image::kMostSide,
                            Image::kMostPixels));
  stbi_uc* const pixels = stbi_load_from_memory(data, size, &width, &height, &channels, 4);
  if (!pixels) throw damaged();
  const std::uint32_t sides[2] = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  std::string out(reinterpret_cast<const char*>(sides), sizeof sides);
  out.append(reinterpret_cast<const char*>(pixels), 4 * w * h);
  stbi_image_free(pixels);
  return out;
}

Image unpacked(std::string_view bytes) {
  Image image;
  std::uint32_t sides[2];
  if (bytes.size() < sizeof sides) throw Error("it is damaged");
  std::memcpy(sides, bytes.data(), sizeof sides);
  bytes.remove_prefix(sizeof sides);
  image.width = sides[0], image.height = sides[1];
  if (bytes.empty() || bytes.size() != std::uint64_t{4} * sides[0] * sides[1]) throw Error("it is damaged");
  image.rgba.assign(bytes.begin(), bytes.end());
  return image;
}

}  // namespace

ImageFile FileImageSource::load(const std::string& path) {
  ImageFile file;
  file.bytes = read_file(path, kMostBytes);
  try {
    if (file.bytes.empty()) throw Error("it is empty");
    file.ending = ending_of(file.bytes);
    const ChildLimits limits{.most_memory = 3ull << 30, .most_seconds = 120};
    file.image = unpacked(run_in_child([&] { return decode(file.bytes); }, limits));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: cannot be used as a texture: {}", path, e.what()));
  }
  return file;
}

}  // namespace espalier
