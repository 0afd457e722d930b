#include "run/run_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::string make_unique_sibling(const std::string& path, const char* what) {
  std::string name = fmt::format("{}.{}-XXXXXX", path, what);
  if (!mkdtemp(name.data())) {
    throw Error(fmt::format("{}: cannot make an output folder here: {}", path, std::strerror(errno)));
  }
  chmod(name.c_str(), 0755);  // mkdtemp's are for their owner alone
  return name;
}

/// Lets the two change names in one step. False where the file system cannot, or there is no `b`; then nothing is done.
bool swap_names(const std::string& a, const std::string& b) {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

/// Makes renames in the folder last through a power cut; file systems that cannot sync a folder are no failure.
void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(::fsync(file));
  ::close(file);
}

}  // namespace

std::string folder_path(const std::string& path, std::string_view option) {
  if (path.empty()) throw Error(fmt::format("{} must name a folder, got \"\"", option));
  fs::path p = fs::path(path).lexically_normal();
  if (!p.has_filename()) p = p.parent_path();
  if (p.empty() || p == p.root_path() || p.filename() == "." || p.filename() == "..") {
    throw Error(fmt::format("{} must name a folder of its own, got \"{}\"", option, path));
  }
  return p.string();
}

RunFolder::RunFolder(const std::string& path, std::string_view marker) : path_(folder_path(path)) {
  open(marker);
  staging_ = make_unique_sibling(path_, "partial");
}

RunFolder::RunFolder(const std::string& path, std::string_view marker, std::string staging, FolderLock lock)
    : path_(folder_path(path)), staging_(std::move(staging)), lock_(std::move(lock)), staging_kept_(true) {
  open(marker);
}

/// Throws where the path is not ours to take; makes the folders above it.
void RunFolder::open(std::string_view marker) const {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) throw Error(fmt::format("{}: is no folder; --out must name one", path_));
    const bool empty = fs::is_empty(path_, error) && !error;
    if (!empty && !fs::exists(fs::path(path_) / marker, error)) {
      throw Error(fmt::format("{}: holds other files; --out must name a new or empty folder, or one that Espalier "
                              "wrote (with {})", path_, marker));
    }
  }
  error.clear();  // that there is nothing there yet was none
  const fs::path parent = fs::path(path_).parent_path();
  if (!parent.empty()) fs::create_directories(parent, error);
  if (error) throw Error(fmt::format("{}: cannot make the folder: {}", parent.string(), error.message()));
}

RunFolder::~RunFolder() {
  if (staging_kept_) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void RunFolder::commit() {
  std::error_code error;
  std::string old;
  if (fs::exists(path_)) {
    old = make_unique_sibling(path_, "replaced");
    error = replace(old);
  } else {
    fs::rename(staging_, path_, error);
  }
  if (error) throw Error(fmt::format("{}: cannot give the finished folder its name: {}", path_, error.message()));
  staging_kept_ = true;
  sync_folder(fs::path(path_).parent_path());  // before the earlier run goes
  fs::remove(fs::path(path_) / FolderLock::kName, error);
  if (!old.empty()) fs::remove_all(old, error);
}

/// The earlier folder moves to `old`, which is empty. Where names can be exchanged there is a whole folder of the name
/// at any moment.
std::error_code RunFolder::replace(const std::string& old) {
  std::error_code error, ignored;
  if (swap_names(staging_, path_)) {
    fs::rename(staging_, old, ignored);
    if (ignored) fs::remove_all(staging_, ignored);
    return error;
  }
  fs::rename(path_, old, error);
  if (error) {
    fs::remove(old, ignored);
    return error;
  }
  fs::rename(staging_, path_, error);
  if (error) fs::rename(old, path_, ignored);
  return error;
}

void RunFolder::guard() {
  if (lock_) return;
  lock_ = FolderLock::take(staging_);
  if (!lock_) throw Error(fmt::format("{}: {} is at work in it", staging_, FolderLock::holder(staging_)));
}

}  // namespace espalier
