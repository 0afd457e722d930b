#pragma once
// What a file of a project is, as its name says.

#include <cstdint>
#include <string_view>

namespace espalier::studio {

enum class FileKind : std::uint8_t { mesh, image, grammar, other };

FileKind file_kind(std::string_view path);

}  // namespace espalier::studio
