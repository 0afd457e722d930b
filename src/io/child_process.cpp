#include "io/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace espalier {
namespace {

constexpr char kResult = 'r', kError = 'e';

[[noreturn]] void fail(const std::string& what, int code) {
  throw Error(fmt::format("{}: {}", what, std::generic_category().message(code)));
}

/// Bytes of address space in use.
std::uint64_t address_space() {
  unsigned long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return std::uint64_t{pages} * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit([[maybe_unused]] const ChildLimits& limits, [[maybe_unused]] std::uint64_t used) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory does not fit under a limit
  const rlimit memory{used + limits.most_memory, used + limits.most_memory};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM, SIGTERM}) std::signal(number, SIG_DFL);
  ::alarm(limits.most_seconds);
  // What a dying C library has to say is for no one.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

std::string outcome(const std::function<std::string()>& work) {
  try {
    return kResult + work();
  } catch (const std::bad_alloc&) {
    return kError + std::string("it needs too much memory");
  } catch (const std::exception& e) {
    return kError + std::string(e.what());
  } catch (...) {
    return std::string(1, kError) + "it cannot be read";
  }
}

[[noreturn]] void be_child(int out, const std::function<std::string()>& work, const ChildLimits& limits,
                           std::uint64_t used) {
  limit(limits, used);
  const std::string bytes = outcome(work);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(out, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    at += static_cast<std::size_t>(n);
  }
  ::_exit(0);
}

std::string read_all(int in) {
  std::string bytes;
  char block[1 << 14];  // whoever calls may have little stack
  for (;;) {
    const ssize_t n = ::read(in, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(block, static_cast<std::size_t>(n));
  }
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  const std::uint64_t used = address_space();
  int ends[2];
  pid_t child = -1;
  {
    // One at a time, so that no other child holds this pipe open.
    static std::mutex forking;
    const std::lock_guard lock(forking);
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot make a pipe", errno);
    child = ::fork();
    if (child == 0) {
      ::close(ends[0]);  // so that writing ends where nobody reads any more
      be_child(ends[1], work, limits, used);
    }
    const int code = errno;
    ::close(ends[1]);
    if (child < 0) {
      ::close(ends[0]);
      fail("cannot start a process", code);
    }
  }
  const std::string bytes = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    throw Error(fmt::format("it takes longer than {} s to read", limits.most_seconds));
  }
  if (WIFSIGNALED(status))
    throw Error(fmt::format("the file is damaged (reading it ended in: {})", ::strsignal(WTERMSIG(status))));
  if (bytes.empty()) throw Error("the file is damaged (nothing came of reading it)");
  if (bytes[0] == kError) throw Error(bytes.substr(1));
  return bytes.substr(1);
}

}  // namespace espalier
