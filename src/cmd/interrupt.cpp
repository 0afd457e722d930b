#include "cmd/interrupt.h"

#include <csignal>

namespace espalier {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void wish_to_stop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>* stop_on_signals() {
  std::signal(SIGINT, wish_to_stop);
  std::signal(SIGTERM, wish_to_stop);
  return &stop_requested;
}

}  // namespace espalier
