#pragma once
// ZipWriter: files in one archive, as every system opens it (PKWARE APPNOTE 6.3.3: deflate, no encryption, no Zip64). Equal
// files give equal bytes.

#include <cstdint>
#include <string>
#include <string_view>

namespace espalier::studio {

class ZipWriter {
 public:
  /// `name`: a relative path with /, in ASCII. Throws Error beyond 65 000 files or 2 GiB.
  void add(const std::string& name, std::string_view bytes);
  /// The archive; the writer is empty afterwards.
  std::string finish();

 private:
  std::string out_, directory_;
  std::uint32_t files_ = 0;
};

/// All files below `folder`, in the order of their paths, as STEM/PATH. Throws Error.
std::string zip_of_folder(const std::string& folder, const std::string& stem);

}  // namespace espalier::studio
