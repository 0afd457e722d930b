#pragma once
// PatientExecutor: runs the tasks of a search until somebody's patience with them is at an end.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>

#include "base/executor.h"

namespace espalier::studio {

/// The step of an engine was given up.
struct GivenUp {};

/// A moment as a number, of the steady clock.
inline std::int64_t ticks(std::chrono::steady_clock::time_point time) { return time.time_since_epoch().count(); }

/// Runs tasks on all cores but one, which is left to the server; on one where there are no more than two.
class PatientExecutor final : public Executor {
 public:
  /// `give_up_at`: from this moment on (in ticks; 0: never) no further task begins, and for_each throws GivenUp. It must
  /// outlive the executor, and may change at any time.
  explicit PatientExecutor(const std::atomic<std::int64_t>& give_up_at);
  int workers() const override { return executor_->workers(); }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override;

 private:
  std::unique_ptr<Executor> executor_;
  const std::atomic<std::int64_t>& give_up_at_;
};

}  // namespace espalier::studio
