#include "render/compare/statistics.h"

#include <gtest/gtest.h>

namespace malus::render {
namespace {

TEST(Statistics, QuantilesInterpolate) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4, 5}, 0.25), 2);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.9), 7);
  const Spread s = computeSpread({5, 1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.low, 2);
  EXPECT_DOUBLE_EQ(s.high, 4);
}

TEST(Statistics, RatiosArePaired) {
  // A round that is slow for both does not change the ratio.
  const Spread s = ratioSpread({10, 200, 10}, {20, 400, 20});
  EXPECT_DOUBLE_EQ(s.median, 0.5);
  EXPECT_DOUBLE_EQ(s.low, 0.5);
  EXPECT_DOUBLE_EQ(s.high, 0.5);
}

TEST(Statistics, SignTestNeedsSixRoundsOfOneSign) {
  EXPECT_FALSE(differSignificantly({1, 1, 1, 1, 1}, {2, 2, 2, 2, 2}));       // 2/32
  EXPECT_TRUE(differSignificantly({1, 1, 1, 1, 1, 1}, {2, 2, 2, 2, 2, 2}));  // 2/64
  EXPECT_FALSE(differSignificantly({1, 1, 1, 1, 1, 3}, {2, 2, 2, 2, 2, 2}));
  EXPECT_FALSE(differSignificantly({2, 2, 2, 2, 2, 2, 2}, {2, 2, 2, 2, 2, 2, 2}));
  EXPECT_FALSE(differSignificantly({1, 3, 1, 3, 1, 3, 1, 3}, {2, 2, 2, 2, 2, 2, 2, 2}));
}

}  // namespace
}  // namespace malus::render
