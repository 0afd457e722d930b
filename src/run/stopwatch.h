#pragma once
// Stopwatch: seconds of the stretches in which it ran, of wall time or of the process's computing.

#include <cstdint>
#include <ctime>

namespace espalier {

/// `computing`: of all threads of the process together; what others do on the machine hardly touches it. With one thread
/// it is what `wall` would be on an idle machine.
enum class StopwatchClock : std::uint8_t { wall, computing };

class Stopwatch {
 public:
  /// `seconds`: on it already. It stands until `go`.
  explicit Stopwatch(StopwatchClock clock = StopwatchClock::wall, double seconds = 0) : clock_(clock), before_(seconds) {}

  void go() {
    if (!running_) start_ = now(), running_ = true;
  }
  /// It stands at so many seconds.
  void set(double seconds) { before_ = seconds, running_ = false; }
  void pause() { before_ = seconds(), running_ = false; }
  double seconds() const { return running_ ? before_ + (now() - start_) : before_; }

 private:
  double now() const {
    timespec time{};
    clock_gettime(clock_ == StopwatchClock::wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  StopwatchClock clock_;
  double before_;
  bool running_ = false;
  double start_ = 0;
};

}  // namespace espalier
