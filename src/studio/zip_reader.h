#pragma once
// The files of a zip archive, as ZipWriter writes them and as other programs do (PKWARE APPNOTE 6.3.3): stored or
// deflated, no encryption, no Zip64. Archives come from anywhere: what one says of itself is believed only as far as it
// was found to be so.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace espalier::studio {

struct ZipLimits {
  std::size_t files = 400;               // folders are not counted
  std::uint64_t bytes = 192u << 20;      // of all files together, unpacked
};

/// Files by their paths, which have / between their parts and lead nowhere else: none is absolute or goes up. Throws Error
/// for what is damaged, beyond the limits or of another kind; then little memory was taken for it.
std::map<std::string, std::string> read_zip(std::string_view archive, const ZipLimits& limits = {});

}  // namespace espalier::studio
