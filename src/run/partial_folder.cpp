#include "run/partial_folder.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "run/checkpoint.h"
#include "run/folder_lock.h"
#include "run/results.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNeeded[] = {kCheckpointName, kRunMarker, FolderLock::kName, "report.html", "best.png"};

/// Names that ResultWriter gives, whatever the scene, and those of write_file until its bytes are whole.
bool is_result(const std::string& name) {
  static const std::regex kResults(
      R"(best\.(derivation\.json|glb|obj|mtl)|best-texture-\d+\.[a-z]+|result\.json|convergence\.csv|diagnostics\.csv)"
      R"(|(view|silhouette)(-\d+)?\.png|(volume|curves)\.png|alternatives\.png|alternatives/\d+\.(derivation\.json|glb|png))"
      R"(|(.*/)?\.espalier-\d+-\d+\.tmp)");
  return std::regex_match(name, kResults);
}

void refuse_links(const fs::path& folder) {
  for (const char* name : {"inputs", "alternatives"}) {
    std::error_code ignored;
    if (!fs::is_symlink(folder / name, ignored)) continue;
    throw Error(fmt::format("{}: is a symbolic link; a run goes on only where all its files lie in its folder",
                            (folder / name).string()));
  }
}

}  // namespace

PartialFolder::PartialFolder(std::string folder, const std::map<std::string, std::string>& inputs)
    : folder_(std::move(folder)) {
  refuse_links(folder_);
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder_, error); !error && entry != fs::end(entry);
       entry.increment(error)) {
    // Links are looked at themselves, as they would be removed themselves.
    if (fs::is_directory(entry->symlink_status())) continue;
    const std::string name = entry->path().lexically_relative(folder_).generic_string();
    const bool needed =
        inputs.contains(name) || std::find(std::begin(kNeeded), std::end(kNeeded), name) != std::end(kNeeded);
    (needed ? needed_ : is_result(name) ? results_ : foreign_).push_back(name);
  }
  if (error) throw Error(fmt::format("{}: cannot read the folder: {}", folder_, error.message()));
  std::sort(foreign_.begin(), foreign_.end());
}

void PartialFolder::tidy() const { remove(results_); }

void PartialFolder::remove() const {
  remove(results_);
  remove(needed_);
  std::error_code ignored;
  fs::remove(folder_, ignored);
}

/// With the folders that are empty then.
void PartialFolder::remove(const std::vector<std::string>& names) const {
  std::error_code ignored;
  std::set<fs::path, std::greater<>> folders;  // those within others first
  for (const std::string& name : names) {
    fs::remove(fs::path(folder_) / name, ignored);
    for (fs::path up = fs::path(name).parent_path(); !up.empty(); up = up.parent_path()) folders.insert(up);
  }
  for (const fs::path& folder : folders) fs::remove(fs::path(folder_) / folder, ignored);
}

}  // namespace espalier
