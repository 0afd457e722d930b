#pragma once
// Stopwatch: seconds of wall time, of the stretches in which it ran.

#include <chrono>

namespace espalier {

class Stopwatch {
 public:
  /// `seconds`: on it already. It stands until `go`.
  explicit Stopwatch(double seconds = 0) : before_(seconds) {}

  void go() {
    if (!running_) start_ = Clock::now(), running_ = true;
  }
  void pause() { before_ = seconds(), running_ = false; }
  double seconds() const {
    return running_ ? before_ + std::chrono::duration<double>(Clock::now() - start_).count() : before_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  double before_;
  bool running_ = false;
  Clock::time_point start_;
};

}  // namespace espalier
