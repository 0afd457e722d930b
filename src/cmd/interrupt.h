#pragma once
// Ctrl-C as a wish: the first ends what runs with what is there, a second one has its usual effect.

#include <atomic>

namespace espalier {

/// Is set by SIGINT and SIGTERM from now on.
const std::atomic<bool>* stop_on_signals();

}  // namespace espalier
