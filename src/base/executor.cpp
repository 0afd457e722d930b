#include "base/executor.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace espalier {
namespace {

int resolve(int threads) {
  if (threads > 0) return threads;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return cores > 0 ? cores : 1;
}

// Pulls indices from a shared counter, so a slow task does not hold up the others.
class TaskQueue {
 public:
  TaskQueue(std::size_t n, const std::function<void(std::size_t, int)>& task) : n_(n), task_(task) {}

  void drain(int worker) {
    try {
      for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < n_;) task_(i, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }
  void rethrow() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::size_t n_;
  const std::function<void(std::size_t, int)>& task_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr error_;
};

class SerialExecutor final : public Executor {
 public:
  int workers() const override { return 1; }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override {
    for (std::size_t i = 0; i < n; ++i) task(i, 0);
  }
};

class [[maybe_unused]] TbbExecutor final : public Executor {
 public:
  explicit TbbExecutor(int threads) : threads_(threads), arena_(threads) {}
  int workers() const override { return threads_; }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override {
    TaskQueue queue(n, task);
    arena_.execute([&] {
      tbb::parallel_for(0, threads_, [&](int worker) { queue.drain(worker); }, tbb::simple_partitioner());
    });
    queue.rethrow();
  }

 private:
  int threads_;
  tbb::task_arena arena_;
};

class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(int threads) : threads_(threads) {}
  int workers() const override { return threads_; }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override {
    TaskQueue queue(n, task);
    {
      std::vector<std::jthread> pool;
      for (int worker = 1; worker < threads_; ++worker) pool.emplace_back([&, worker] { queue.drain(worker); });
      queue.drain(0);
    }
    queue.rethrow();
  }

 private:
  int threads_;
};

}  // namespace

std::unique_ptr<Executor> make_tbb_executor(int threads) {
#ifdef __SANITIZE_THREAD__  // oneTBB's library is not built for it: each of its hand-overs would look like a race
  return make_thread_executor(threads);
#else
  return std::make_unique<TbbExecutor>(resolve(threads));
#endif
}
std::unique_ptr<Executor> make_thread_executor(int threads) {
  return std::make_unique<ThreadExecutor>(resolve(threads));
}
std::unique_ptr<Executor> make_serial_executor() { return std::make_unique<SerialExecutor>(); }

}  // namespace espalier
