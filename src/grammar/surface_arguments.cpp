#include "grammar/surface_arguments.h"

#include <array>
#include <optional>

#include "base/check.h"
#include "base/math.h"

namespace espalier {
namespace {

using enum SurfaceArgument::Sort;

constexpr SurfaceArgument kSurface[] = {
    {.name = "color", .sort = color},
    {.name = "roughness", .fallback = 0.7f},
    {.name = "metal"},
    {.name = "opacity", .fallback = 1},
    {.name = "glow", .high = 4, .unbounded = true},
    {.name = "cutout"},
    {.name = "two_sided", .sort = boolean},
    {.name = "texture", .sort = texture},
    {.name = "tiles", .low = 0.25f, .high = 64, .fallback = 1, .logarithmic = true},
    {.name = "tiles_up", .low = 0.25f, .high = 64, .logarithmic = true},
    {.name = "metres", .low = 0.01f, .high = 100, .logarithmic = true},
};

constexpr SurfaceArgument kImage[] = {{.name = "file", .sort = file}};

constexpr SurfaceArgument kSeed{.name = "seed", .high = 1023, .whole = true};

constexpr SurfaceArgument kBark[] = {
    {.name = "dark", .sort = color},
    {.name = "light", .sort = color},
    {.name = "furrows", .low = 2, .high = 24, .fallback = 6, .whole = true, .logarithmic = true},
    {.name = "contrast", .fallback = 0.7f},
    {.name = "waves", .fallback = 0.4f},
    {.name = "cracks", .fallback = 0.5f},
    {.name = "bands"},
    kSeed,
};

constexpr SurfaceArgument kLeaf[] = {
    {.name = "color", .sort = color},
    {.name = "vein", .sort = color},
    {.name = "width", .low = 0.1f, .high = 1, .fallback = 0.55f},
    {.name = "tip", .fallback = 0.5f},
    {.name = "teeth", .fallback = 0.25f},
    {.name = "lobes"},
    {.name = "veins", .low = 2, .high = 16, .fallback = 7, .whole = true},
    {.name = "wilt"},
    kSeed,
};

constexpr SurfaceArgument kNoise[] = {
    {.name = "a", .sort = color},
    {.name = "b", .sort = color},
    {.name = "cells", .low = 1, .high = 64, .fallback = 4, .whole = true, .logarithmic = true},
    {.name = "octaves", .low = 1, .high = 8, .fallback = 5, .whole = true},
    {.name = "contrast", .fallback = 0.5f},
    {.name = "warp"},
    {.name = "ridges"},
    {.name = "stretch", .low = 1, .high = 16, .fallback = 1, .logarithmic = true},
    kSeed,
};

struct TextureFacts {
  std::string_view name;
  std::span<const SurfaceArgument> arguments;
  std::string_view colors[2];
};

/// Indexed by TextureKind.
constexpr TextureFacts kTextures[] = {
    {"", {}, {}},
    {"image_texture", kImage, {}},
    {"bark_texture", kBark, {"#44342a", "#9c8770"}},
    {"leaf_texture", kLeaf, {"#4c7a2e", "#9db566"}},
    {"noise_texture", kNoise, {"#ffffff", "#808080"}},
};

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

float linear_light(int byte) {
  const float s = static_cast<float>(byte) / 255;
  return s <= 0.04045f ? s / 12.92f : power((s + 0.055f) / 1.055f, 2.4f);
}

TextureKind texture_named(std::string_view builtin) {
  for (std::size_t i = 1; i < std::size(kTextures); ++i)
    if (kTextures[i].name == builtin) return static_cast<TextureKind>(i);
  return TextureKind::none;
}

std::string_view name_of(TextureKind kind) { return kTextures[static_cast<std::size_t>(kind)].name; }

std::span<const SurfaceArgument> surface_arguments(std::string_view builtin) {
  if (builtin == "surface") return kSurface;
  return kTextures[static_cast<std::size_t>(texture_named(builtin))].arguments;
}

std::span<const SurfaceArgument> texture_numbers(TextureKind kind) {
  const std::span<const SurfaceArgument> all = kTextures[static_cast<std::size_t>(kind)].arguments;
  std::size_t first = 0;
  while (first < all.size() && all[first].sort != number) ++first;
  return all.subspan(first);
}

const SurfaceArgument* surface_argument(const ast::Expr& call, std::size_t i) {
  const std::span<const SurfaceArgument> all = surface_arguments(call.name);
  const ast::Arg& arg = call.args[i];
  if (!arg.label) return i < all.size() ? &all[i] : nullptr;
  for (const SurfaceArgument& one : all)
    if (one.name == arg.label->name) return &one;
  return nullptr;
}

Kind kind_of(SurfaceArgument::Sort sort) {
  switch (sort) {
    case color:
    case file: return Kind::text;
    case boolean: return Kind::boolean;
    case texture: return Kind::texture;
    case number: break;
  }
  return Kind::number;
}

TextureRef default_texture(TextureKind kind) {
  TextureRef out;
  out.kind = kind;
  const TextureFacts& facts = kTextures[static_cast<std::size_t>(kind)];
  for (std::size_t i = 0; i < 2; ++i) out.colors[i] = parse_color(facts.colors[i]).value_or(Vec3(0));
  const auto numbers = texture_numbers(kind);
  CHECK(numbers.size() <= TextureRef::kMostNumbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) out.numbers[i] = numbers[i].fallback;
  return out;
}

std::optional<Vec3> parse_color(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const int high = hex_digit(text[static_cast<std::size_t>(1 + 2 * i)]);
    const int low = hex_digit(text[static_cast<std::size_t>(2 + 2 * i)]);
    if (high < 0 || low < 0) return std::nullopt;
    out[i] = linear_light(16 * high + low);
  }
  return out;
}

}  // namespace espalier
