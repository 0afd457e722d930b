#include "base/executor.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace espalier {
namespace {

class ExecutorThread : public testing::TestWithParam<int> {
 protected:
  std::unique_ptr<Executor> make() const {
    switch (GetParam()) {
      case 0: return make_serial_executor();
      case 1: return make_tbb_executor(2);
      default: return make_thread_executor(3);
    }
  }
};

TEST_P(ExecutorThread, RunsEveryTaskOnce) {
  const auto executor = make();
  std::vector<std::atomic<int>> seen(1000);
  std::vector<std::atomic<int>> busy(static_cast<std::size_t>(executor->workers()));
  executor->for_each(seen.size(), [&](std::size_t i, int worker) {
    ASSERT_LT(worker, executor->workers());
    EXPECT_EQ(busy[static_cast<std::size_t>(worker)].fetch_add(1), 0) << "two calls share worker " << worker;
    ++seen[i];
    busy[static_cast<std::size_t>(worker)].fetch_sub(1);
  });
  for (const auto& count : seen) EXPECT_EQ(count.load(), 1);
}

TEST_P(ExecutorThread, PassesExceptionsOn) {
  const auto executor = make();
  EXPECT_THROW(executor->for_each(10, [](std::size_t i, int) { if (i == 7) throw std::runtime_error("seven"); }),
               std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(All, ExecutorThread, testing::Values(0, 1, 2));

}  // namespace
}  // namespace espalier
