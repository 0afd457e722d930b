#pragma once
// What `surface(...)` and the textures take: one table for the checker, the compiler and what makes pictures of them.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "grammar/ast.h"
#include "grammar/kind.h"
#include "grammar/material.h"

namespace espalier {

struct SurfaceArgument {
  enum class Sort : std::uint8_t { color, file, boolean, texture, number };

  std::string_view name;
  Sort sort = Sort::number;
  float low = 0, high = 1;   // numbers: their range; `glow` may lie above it where it is constant
  float fallback = 0;        // where it is left out
  bool whole = false;        // numbers: rounded
  bool logarithmic = false;  // numbers that vary: steps of equal ratio instead of equal size
  bool unbounded = false;    // numbers: no upper limit where constant
};

/// The arguments of `surface`, `bark_texture`, ... in their order; empty for other names.
std::span<const SurfaceArgument> surface_arguments(std::string_view builtin);

/// The argument that number `i` of such a call is, by its label or its place; null where there is none.
const SurfaceArgument* surface_argument(const ast::Expr& call, std::size_t i);

/// The kind of value that an argument takes.
Kind kind_of(SurfaceArgument::Sort sort);

/// none for names that are no texture.
TextureKind texture_named(std::string_view builtin);
std::string_view name_of(TextureKind kind);

/// The numbers of a texture: TextureRef::numbers has one value for each, in this order.
std::span<const SurfaceArgument> texture_numbers(TextureKind kind);

/// A texture of that kind with every argument left out.
TextureRef default_texture(TextureKind kind);

/// Linear light of an sRGB byte.
float linear_light(int byte);
/// "#rrggbb" to linear light; nothing when it is not that.
std::optional<Vec3> parse_color(std::string_view text);

}  // namespace espalier
