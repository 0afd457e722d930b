#pragma once
// RunFolder: an output folder that appears whole or not at all. Everything is written into a sibling with a name of its
// own, which takes the folder's name on commit; an earlier folder of ours is replaced, nothing else ever is.

#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "run/folder_lock.h"

namespace espalier {

/// "a/b/" and "a/b/." are a/b. Throws Error, naming the option, for what names no folder of its own.
std::string folder_path(const std::string& path, std::string_view option = "--out");

class RunFolder {
 public:
  /// `marker` is the file that tells our folders ("run.toml"). Makes the staging folder, and the folders above it.
  /// Throws Error when `path` is taken by anything but an empty folder or an earlier one of ours, or cannot be written.
  RunFolder(const std::string& path, std::string_view marker);
  /// Goes on in the staging folder of an earlier process, whose lock is held. What is there stays.
  RunFolder(const std::string& path, std::string_view marker, std::string staging, FolderLock lock);
  /// Removes what was staged, unless committed or kept.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& staging() const { return staging_; }
  const std::string& path() const { return path_; }
  /// Gives the staged folder its name. Throws Error; then it is still staged.
  void commit();
  /// Tells other processes, until this one ends, that somebody is at work in the staging folder. Throws Error.
  void guard();
  /// Leaves the staging folder behind for a person to look at.
  void keep() { staging_kept_ = true; }

 private:
  void open(std::string_view marker) const;
  std::error_code replace(const std::string& old);

  std::string path_, staging_;
  std::optional<FolderLock> lock_;
  bool staging_kept_ = false;
};

}  // namespace espalier
