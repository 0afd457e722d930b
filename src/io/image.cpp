#include "io/image.h"

#include "io/file.h"
#include "io/png.h"

namespace espalier {

void write_png(const std::string& path, std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
               const Provenance& provenance) {
  write_file(path, encode_png(width, height, rgb, "espalier", to_json(provenance)));
}

}  // namespace espalier
