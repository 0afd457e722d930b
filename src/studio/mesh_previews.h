#pragma once
// MeshPreviews: small pictures of mesh files. Safe to use from any thread.

#include <map>
#include <mutex>
#include <string>

#include "studio/store.h"

namespace espalier::studio {

class MeshPreviews {
 public:
  static constexpr std::uint32_t kWidth = 128, kHeight = 96;
  static constexpr std::uint64_t kMostTriangles = 500'000;  // of larger meshes there is none
  static constexpr std::size_t kMostKept = 300;

  /// A PNG of the mesh before nothing; "" where it is too large. `read_blob` is asked for its bytes where it was not
  /// drawn lately. Throws Error.
  template <class ReadBlob>
  std::string png(const StoredFile& file, ReadBlob read_blob) {
    if (file.triangles == 0 || file.triangles > kMostTriangles) return "";
    const std::lock_guard lock(mutex_);  // one is drawn at a time
    if (const auto known = kept_.find(file.hash); known != kept_.end()) return known->second;
    if (kept_.size() >= kMostKept) kept_.clear();
    return kept_[file.hash] = draw(file.path, read_blob(file.hash));
  }

 private:
  static std::string draw(const std::string& path, const std::string& bytes);

  std::mutex mutex_;
  std::map<std::string, std::string> kept_;  // by content
};

}  // namespace espalier::studio
