#pragma once
// PatientExecutor: runs tasks until somebody's patience with them is at an end.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>

#include "base/executor.h"

namespace espalier::studio {

/// The step of an engine, or whatever else was made, was given up.
struct GivenUp : std::exception {
  const char* what() const noexcept override { return "it was given up: nobody waits for it any more"; }
};

/// A moment as a number, of the steady clock.
inline std::int64_t ticks(std::chrono::steady_clock::time_point time) { return time.time_since_epoch().count(); }

/// How many cores a PatientExecutor works on.
enum class Cores : std::uint8_t {
  spare_one,  // one is left to the server; one alone where there are no more than two
  all,        // somebody waits, and the server's own threads hardly ever work
};

class PatientExecutor final : public Executor {
 public:
  /// `give_up_at`: from this moment on (in ticks; 0: never) no further task begins, and for_each throws GivenUp. It must
  /// outlive the executor, and may change at any time.
  explicit PatientExecutor(const std::atomic<std::int64_t>& give_up_at, Cores cores = Cores::spare_one);
  int workers() const override { return executor_->workers(); }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override;

 private:
  std::unique_ptr<Executor> executor_;
  const std::atomic<std::int64_t>& give_up_at_;
};

}  // namespace espalier::studio
