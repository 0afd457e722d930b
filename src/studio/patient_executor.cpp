#include "studio/patient_executor.h"

#include <thread>

namespace espalier::studio {
namespace {

std::unique_ptr<Executor> make_executor(Cores wanted) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int workers = wanted == Cores::all ? cores : cores - 1;
  return workers > 1 ? make_tbb_executor(workers) : make_serial_executor();
}

}  // namespace

PatientExecutor::PatientExecutor(const std::atomic<std::int64_t>& give_up_at, Cores cores)
    : executor_(make_executor(cores)), give_up_at_(give_up_at) {}

void PatientExecutor::for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) {
  executor_->for_each(n, [&](std::size_t i, int worker) {
    const std::int64_t at = give_up_at_.load(std::memory_order_relaxed);
    if (at != 0 && ticks(std::chrono::steady_clock::now()) >= at) throw GivenUp();
    task(i, worker);
  });
}

}  // namespace espalier::studio
