#include "io/glb_container.h"

#include <cstdint>

#include <fmt/core.h>

#include "base/error.h"

namespace espalier {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942, kVersion2 = 2;

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xff);
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

void append_chunk(std::string& out, std::uint32_t type, std::string_view data, char padding) {
  append_u32(out, static_cast<std::uint32_t>(padded(data.size())));
  append_u32(out, type);
  out += data;
  out.append(padded(data.size()) - data.size(), padding);
}

}  // namespace

std::string pack_glb(std::string_view json, std::string_view binary) {
  const std::size_t total = 12 + 8 + padded(json.size()) + (binary.empty() ? 0 : 8 + padded(binary.size()));
  if (total > 0xffffffffu) throw Error(fmt::format("GLB holds at most 4 GiB, this model needs {} bytes", total));
  std::string out = "glTF";
  out.reserve(total);
  append_u32(out, kVersion2);
  append_u32(out, static_cast<std::uint32_t>(total));
  append_chunk(out, kJsonChunk, json, ' ');
  if (!binary.empty()) append_chunk(out, kBinaryChunk, binary, '\0');
  return out;
}

std::optional<std::string_view> find_glb_json(std::string_view glb) {
  if (glb.size() < 20 || !glb.starts_with("glTF") || read_u32(glb, 16) != kJsonChunk) return std::nullopt;
  const std::size_t length = read_u32(glb, 12);
  if (length > glb.size() - 20) return std::nullopt;
  return glb.substr(20, length);
}

}  // namespace espalier
