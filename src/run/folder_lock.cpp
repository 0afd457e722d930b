#include "run/folder_lock.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"

namespace espalier {
namespace {

std::string file_in(const std::string& folder) { return (std::filesystem::path(folder) / FolderLock::kName).string(); }

/// Whether the open file is still the one of that name: its folder may have been moved away meanwhile.
bool is_still_there(int file, const std::string& path) {
  struct stat open {}, named {};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

std::optional<FolderLock> FolderLock::take(const std::string& folder) {
  const std::string path = file_in(folder);
  const auto fail = [&] { return Error(fmt::format("{}: cannot lock the folder: {}", path, std::strerror(errno))); };
  FolderLock lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (lock.file_ < 0) throw fail();
  if (::flock(lock.file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return std::nullopt;
    throw fail();
  }
  errno = ENOENT;
  if (!is_still_there(lock.file_, path)) throw fail();
  const std::string text = fmt::format("process {}\n", ::getpid());
  if (::ftruncate(lock.file_, 0) != 0 || ::pwrite(lock.file_, text.data(), text.size(), 0) < 0) throw fail();
  return lock;
}

std::string FolderLock::holder(const std::string& folder) {
  try {
    const std::string text = read_file(file_in(folder), 100);
    if (text.starts_with("process ")) return text.substr(0, text.find('\n'));
  } catch (const Error&) {  // gone meanwhile
  }
  return "another process";
}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace espalier
