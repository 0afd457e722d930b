#pragma once
// Executor: runs independent tasks on threads. Results must not depend on which worker runs what; whoever uses an
// executor keeps one scratch per worker and reduces serially afterwards.

#include <cstddef>
#include <functional>
#include <memory>

namespace espalier {

class Executor {
 public:
  virtual ~Executor() = default;
  /// Number of workers, >= 1.
  virtual int workers() const = 0;
  /// Calls task(i, worker) once for every i in [0, n), 0 <= worker < workers(); returns when all are done. No two calls
  /// with the same worker run at the same time. An exception of a task is rethrown here after the others ended.
  virtual void for_each(std::size_t n, const std::function<void(std::size_t index, int worker)>& task) = 0;
};

/// oneTBB with at most `threads` workers (0 = as many as the machine has cores). Plain threads under ThreadSanitizer.
std::unique_ptr<Executor> make_tbb_executor(int threads);
/// Plain threads, likewise.
std::unique_ptr<Executor> make_thread_executor(int threads);
/// No threads at all.
std::unique_ptr<Executor> make_serial_executor();

}  // namespace espalier
