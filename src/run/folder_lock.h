#pragma once
// FolderLock: says that a process is at work in a folder, for as long as the process lives: a lock on a file in it,
// which the system lets go when the process ends in whatever way.

#include <optional>
#include <string>

namespace espalier {

class FolderLock {
 public:
  /// Nothing if another process holds it. Throws Error where the folder is not there or cannot be written.
  static std::optional<FolderLock> take(const std::string& folder);
  /// "process 1234", as far as the one that holds the folder's lock has told; for messages.
  static std::string holder(const std::string& folder);

  FolderLock(FolderLock&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

  /// The file's name in the folder.
  static constexpr const char* kName = ".lock";

 private:
  explicit FolderLock(int file) : file_(file) {}
  int file_;
};

}  // namespace espalier
