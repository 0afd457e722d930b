#pragma once
// Assertions about our own code, independent of NDEBUG. A failed CHECK is a bug in Espalier, never a user's mistake:
// it prints the condition, the place and the replay line of the running job (see set_replay_hint), then aborts.

namespace espalier {

/// Text printed when a CHECK fails, naming the command that brings the crash back. Kept per thread; null clears it.
void set_replay_hint(const char* hint);

namespace detail {
[[noreturn]] void check_failed(const char* condition, const char* file, int line);
}

}  // namespace espalier

#define CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::espalier::detail::check_failed(#condition, __FILE__, __LINE__))

// DCHECK guards the inner loops; it is on in the one build that tests and demo share unless ESPALIER_FAST is set.
#ifdef ESPALIER_FAST
#define DCHECK(condition) static_cast<void>(0)
#else
#define DCHECK(condition) CHECK(condition)
#endif
