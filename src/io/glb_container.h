#pragma once
// The GLB container (glTF 2.0, section 4): a JSON chunk and one binary chunk, little endian, each padded to 4 bytes.

#include <optional>
#include <string>
#include <string_view>

namespace espalier {

/// The whole file; without a binary chunk when `binary` is empty.
std::string pack_glb(std::string_view json, std::string_view binary);

/// The text of the JSON chunk; none for anything that is not a GLB.
std::optional<std::string_view> find_glb_json(std::string_view glb);

}  // namespace espalier
