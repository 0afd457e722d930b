#pragma once
// Pictures as PNG files.

#include <cstdint>
#include <span>
#include <string>

#include "io/provenance.h"

namespace espalier {

/// Writes 8-bit sRGB, rows from the top, rgb[3 * (x + width * y) + channel]. Throws Error naming the file.
void write_png(const std::string& path, std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
               const Provenance& provenance);

}  // namespace espalier
