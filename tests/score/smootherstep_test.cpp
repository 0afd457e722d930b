#include "score/smootherstep.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(Smootherstep, HasThePublishedValues) {
  EXPECT_EQ(smootherstep(0, 0, 1), 0);
  EXPECT_EQ(smootherstep(0.25, 0, 1), 0.103515625);
  EXPECT_EQ(smootherstep(0.5, 0, 1), 0.5);
  EXPECT_EQ(smootherstep(0.75, 0, 1), 0.896484375);
  EXPECT_NEAR(smootherstep(0.1, 0, 1), 0.00856, 1e-15);
  EXPECT_EQ(smootherstep(1, 0, 1), 1);
  EXPECT_EQ(smootherstep(70, 40, 100), 0.5);
}

TEST(Smootherstep, IsClampedAndAStepWithoutARamp) {
  EXPECT_EQ(smootherstep(-3, 0, 1), 0);
  EXPECT_EQ(smootherstep(8, 0, 1), 1);
  EXPECT_EQ(smootherstep(5, 5, 5), 0);
  EXPECT_EQ(smootherstep(5.001, 5, 5), 1);
  EXPECT_EQ(smootherstep(0, 0, 0), 0);  // no voxels of none
}

}  // namespace
}  // namespace espalier
