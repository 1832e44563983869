#include "render/scene/view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace malus::render {
namespace {

TEST(View, LinearPolarizerIsHalfAndTurnsByTwiceItsAngle) {
  EXPECT_NEAR(linearPolarizer(0)[1], 0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(90)[1], -0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(45)[2], 0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(-45)[2], -0.5, 1e-15);
  for (const double degrees : {0.0, 17.0, 90.0, 133.0}) {
    const Analyser a = linearPolarizer(degrees), b = linearPolarizer(degrees + 180);
    EXPECT_EQ(a[0], 0.5);
    EXPECT_NEAR(std::hypot(a[1], a[2]), 0.5, 1e-15);
    EXPECT_EQ(a[3], 0);
    EXPECT_NEAR(a[1], b[1], 1e-14);
    EXPECT_NEAR(a[2], b[2], 1e-14);
  }
}

}  // namespace
}  // namespace malus::render
