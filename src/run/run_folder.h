#pragma once
// RunFolder: an output folder that appears whole or not at all. Everything is written into a sibling with a name of its
// own, which takes the folder's name on commit; an earlier folder of ours is replaced, nothing else ever is.

#include <string>
#include <string_view>

namespace espalier {

class RunFolder {
 public:
  /// `marker` is the file that tells our folders ("run.toml"). Makes the staging folder, and the folders above it.
  /// Throws Error when `path` is taken by anything but an empty folder or an earlier one of ours, or cannot be written.
  RunFolder(const std::string& path, std::string_view marker);
  /// Removes what was staged, unless committed or kept.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& staging() const { return staging_; }
  const std::string& path() const { return path_; }
  /// Gives the staged folder its name. Throws Error; then it is still staged.
  void commit();
  /// Leaves the staging folder behind for a person to look at.
  void keep() { staging_kept_ = true; }

 private:
  std::string path_, staging_;
  bool staging_kept_ = false;
};

}  // namespace espalier
