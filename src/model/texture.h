#pragma once
// Textures: a grammar's description of bark, a leaf or noise to its picture. Pure functions of integer noise: the same
// bytes on every CPU. Bark and noise continue across opposite edges; a leaf stands alone, transparent around it.

#include "grammar/material.h"
#include "model/image.h"

namespace espalier {

inline constexpr std::uint32_t kTextureSize = 512;

/// A square picture of a procedural texture (not of `image`), `size` pixels a side, 1..4096.
Image make_texture(const TextureRef& texture, std::uint32_t size = kTextureSize);

// The kinds, one file each.
Image make_bark(const TextureRef& texture, std::uint32_t size);
Image make_leaf_picture(const TextureRef& texture, std::uint32_t size);
Image make_noise(const TextureRef& texture, std::uint32_t size);

/// The number called `name` of the texture; it must have one.
float texture_number(const TextureRef& texture, std::string_view name);

}  // namespace espalier
