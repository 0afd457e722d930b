#pragma once
// What lies in the folder that an ended process left behind: told apart by name, so that only files of ours are ever
// removed.

#include <map>
#include <string>
#include <vector>

namespace espalier {

class PartialFolder {
 public:
  /// `inputs`: names below the folder that the search reads, as keys. Throws Error where inputs/ or alternatives/ is a
  /// symbolic link, which would lead out of the folder, or where the folder cannot be read.
  PartialFolder(std::string folder, const std::map<std::string, std::string>& inputs);

  /// Names within the folder of files that no run writes, sorted.
  const std::vector<std::string>& foreign() const { return foreign_; }
  /// Removes results that may be half written: all of ours but what the search needs, and the report people watch.
  void tidy() const;
  /// Removes all of ours, and the folder if nothing else is in it.
  void remove() const;

 private:
  void remove(const std::vector<std::string>& names) const;

  std::string folder_;
  std::vector<std::string> needed_, results_, foreign_;
};

}  // namespace espalier
