#include "io/file.h"

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace espalier {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  /// Network file systems report a full disk only here.
  bool close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

std::string reason(int code) { return std::generic_category().message(code); }

[[noreturn]] void fail_write(const std::string& path, int code) {
  throw Error(fmt::format("{}: cannot write: {}", path, reason(code)));
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

/// Where a symbolic link leads, so that the link stays and its target is replaced; the path itself otherwise.
std::string follow_link(const std::string& path) {
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0 || !S_ISLNK(info.st_mode)) return path;
  char resolved[PATH_MAX];
  return ::realpath(path.c_str(), resolved) ? resolved : path;
}

/// False with errno set when not everything could be written.
bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// A fresh file in `folder` that no other writer uses, here or in another process; its name goes to `name`.
int open_temporary(const std::string& folder, mode_t mode, std::string& name) {
  static std::atomic<unsigned> next{0};
  for (;;) {
    name = fmt::format("{}/.espalier-{}-{}.tmp", folder, ::getpid(), next++);
    const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd >= 0 || errno != EEXIST) return fd;
  }
}

/// Devices and pipes take the bytes as they are; renaming over them would replace them.
void write_special(const std::string& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), bytes) || !file.close()) fail_write(path, errno);
}

}  // namespace

std::string read_file(const std::string& path, std::uint64_t most_bytes) {
  const auto fail = [&](const std::string& why) -> Error {
    return Error(fmt::format("{}: cannot read: {}", path, why));
  };
  // Non-blocking, so that a pipe without a writer does not hang us before we can refuse it.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) throw fail(reason(errno));
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) throw fail(reason(errno));
  if (S_ISDIR(info.st_mode)) throw fail("it is a folder");
  if (!S_ISREG(info.st_mode)) throw fail("it is not a regular file");
  const auto too_large = [&] { return fail(fmt::format("it is larger than {} bytes", most_bytes)); };
  if (static_cast<std::uint64_t>(info.st_size) > most_bytes) throw too_large();
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(bytes.size() + 4096);  // room to notice the end, or that the file grew
    const ssize_t n = ::read(file.get(), bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw fail(reason(errno));
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used > most_bytes) throw too_large();
  }
  bytes.resize(used);
  return bytes;
}

StagedFile::StagedFile(const std::string& path, std::string_view bytes) : path_(path), target_(follow_link(path)) {
  struct stat info {};
  const bool exists = ::stat(target_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) fail_write(path, EISDIR);
  if (exists && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail_write(path, errno);
  if (exists && !S_ISREG(info.st_mode)) {
    for_device_ = bytes;
    return;
  }
  Descriptor file(open_temporary(folder_of(target_), 0666, temporary_));
  if (file.get() < 0) fail_write(path, errno);
  bool ok = write_all(file.get(), bytes);
  if (ok && exists) ok = ::fchmod(file.get(), info.st_mode & 07777) == 0;
  if (!ok || ::fsync(file.get()) != 0 || !file.close()) {
    const int code = errno;
    ::unlink(temporary_.c_str());
    fail_write(path, code);
  }
}

StagedFile::~StagedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void StagedFile::commit() {
  if (temporary_.empty()) return write_special(path_, for_device_);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_write(path_, errno);
  temporary_.clear();
  // Makes the rename last through a power cut; file systems that cannot sync a folder are no failure.
  const Descriptor directory(::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) static_cast<void>(::fsync(directory.get()));
}

void write_file(const std::string& path, std::string_view bytes) { StagedFile(path, bytes).commit(); }

}  // namespace espalier
