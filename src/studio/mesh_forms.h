#pragma once
// MeshForms: mesh files of projects as a page can draw them, whatever their format: read by the importer that targets are
// read with. Safe to use from any thread.

#include <mutex>
#include <string>

#include "studio/store.h"

namespace espalier::studio {

class MeshForms {
 public:
  static constexpr std::uint64_t kMostTriangles = 300'000;  // of larger meshes the box around them is drawn

  /// ESPG (docs/studio-protocol.md) of the one mesh; its number is the count of the file's triangles, also where it is a
  /// box. `read_blob` is asked for the bytes. Throws Error.
  template <class ReadBlob>
  std::string message(const StoredFile& file, ReadBlob read_blob) {
    const std::lock_guard lock(mutex_);  // one is read at a time
    return make(file.path, read_blob(file.hash));
  }

 private:
  static std::string make(const std::string& path, const std::string& bytes);

  std::mutex mutex_;
};

}  // namespace espalier::studio
