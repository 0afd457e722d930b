#include "run/stopwatch.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace espalier {
namespace {

void sleep_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(30)); }

TEST(Stopwatch, StandsUntilItIsSetGoingAndWhilePaused) {
  Stopwatch watch(StopwatchClock::wall, 5);
  sleep_a_little();
  EXPECT_EQ(watch.seconds(), 5);
  watch.go();
  sleep_a_little();
  watch.go();  // goes already
  EXPECT_GE(watch.seconds(), 5.03);
  watch.pause();
  const double paused = watch.seconds();
  sleep_a_little();
  EXPECT_EQ(watch.seconds(), paused);
  watch.pause();
  EXPECT_EQ(watch.seconds(), paused);
}

TEST(Stopwatch, ComputingTimeDoesNotCountSleep) {
  Stopwatch wall, computing(StopwatchClock::computing);
  wall.go(), computing.go();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  wall.pause(), computing.pause();
  EXPECT_GE(wall.seconds(), 0.2);
  EXPECT_LT(computing.seconds(), wall.seconds() / 2);
}

}  // namespace
}  // namespace espalier
