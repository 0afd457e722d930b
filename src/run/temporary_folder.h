#pragma once
// TemporaryFolder: a folder that is gone at the end of the scope.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/core.h>

#include "base/error.h"

namespace espalier {

class TemporaryFolder {
 public:
  /// Throws Error.
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "espalier-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) throw Error(fmt::format("{}: cannot make a temporary folder", path_));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const std::string& name) const { return (std::filesystem::path(path_) / name).string(); }

 private:
  std::string path_;
};

}  // namespace espalier
