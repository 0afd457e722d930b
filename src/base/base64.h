#pragma once
// Bytes as text: base64 with its padding (RFC 4648, section 4).

#include <string>
#include <string_view>

namespace espalier {

std::string encode_base64(std::string_view bytes);
/// Throws Error for anything but whole base64 with its padding.
std::string decode_base64(std::string_view text);

}  // namespace espalier
