#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace espalier {
namespace {
thread_local const char* replay_hint = nullptr;
}

void set_replay_hint(const char* hint) { replay_hint = hint; }

namespace detail {
void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "espalier: internal error: %s (%s:%d)\n", condition, file, line);
  if (replay_hint) std::fprintf(stderr, "espalier: to bring it back: %s\n", replay_hint);
  std::abort();
}
}  // namespace detail

}  // namespace espalier
