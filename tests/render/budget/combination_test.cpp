// Combinations of measured choices, and the error that a budget bounds.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "render/budget/budget.h"
#include "render/budget/display_error.h"

namespace malus::render {
namespace {

using Kind = MeasuredChoice::Kind;

// stokes takes 100 ms; fresnel half of that with an error of 0.03; effects and a depth in between.
Measurements measured() {
  Measurements m;
  m.depth = 8;
  m.fullPixels = m.measuredPixels = 100;
  m.choices = {{Kind::method, "stokes", 8, 0, 0, 100},
               {Kind::method, "fresnel", 8, 0, 0.03, 50},
               {Kind::tolerance, "importance", 8, 1e-3, 0.001, 80},
               {Kind::effect, "shadows", 8, 0, 0.02, 70},
               {Kind::effect, "highlights", 8, 0, 0.0001, 95},
               {Kind::effect, "glass", 8, 0, 0.4, 99.5},
               {Kind::depth, "bounce 5", 4, 0, 0.005, 80}};
  return m;
}

const Combination& fastest(const std::vector<Combination>& list, double error) {
  return *std::find_if(list.begin(), list.end(), [&](const Combination& c) { return c.error <= error; });
}

TEST(Combinations, LeaveOutWhatSavesMostPerErrorFirst) {
  const std::vector<Combination> list = combinations(measured(), "stokes");
  EXPECT_TRUE(std::any_of(list.begin(), list.end(), [](const Combination& c) { return c.off.size() == 2; }));
  for (const Combination& c : list) {
    // highlights: 5 % for 0.0001; shadows: 30 % for 0.02.
    if (c.off.size() == 1) {
      EXPECT_EQ(c.off, std::vector<std::string>{"highlights"});
    }
    if (c.off.size() == 2) {
      EXPECT_EQ(c.off, (std::vector<std::string>{"highlights", "shadows"}));
    }
    // glass saves less than 2 %.
    EXPECT_LE(c.off.size(), 2u);
  }
}

TEST(Combinations, AddErrorsAndMultiplyTimes) {
  const std::vector<Combination> list = combinations(measured(), "stokes");
  const auto found = std::find_if(list.begin(), list.end(), [](const Combination& c) {
    return c.method == "fresnel" && c.depth == 4 && c.off.size() == 2;
  });
  ASSERT_NE(found, list.end());
  EXPECT_NEAR(found->error, 0.03 + 0.005 + 0.0001 + 0.02, 1e-12);
  EXPECT_NEAR(found->milliseconds, 50 * 0.8 * 0.95 * 0.7, 1e-9);
}

TEST(Combinations, TheFastestWithinAnErrorIsExactForZero) {
  const std::vector<Combination> list = combinations(measured(), "stokes");
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end(), [](const Combination& a, const Combination& b) {
    return a.milliseconds < b.milliseconds;
  }));
  EXPECT_EQ(fastest(list, 0).method, "stokes");
  EXPECT_TRUE(fastest(list, 0).off.empty());
  EXPECT_EQ(fastest(list, 0.0012).method, "importance");
  EXPECT_EQ(fastest(list, 1).method, "fresnel");
}

RenderResult image(std::vector<float> pixels) {
  RenderResult result;
  result.width = static_cast<std::uint32_t>(pixels.size() / 3);
  result.height = 1;
  result.pixels = std::move(pixels);
  return result;
}

TEST(DisplayError, IsRelativeRms) {
  const SquaredError e = displayError(image({0.5f, 0.25f, 0}), image({0.25f, 0.25f, 0}), 0);
  EXPECT_DOUBLE_EQ(e.relRms(), 0.25 / std::sqrt(2 * 0.0625));
  EXPECT_EQ(e.pixels, 1u);
  EXPECT_EQ(e.wrongPixels, 1u);
}

TEST(DisplayError, ClampsAtTheDisplaysWhite) {
  const RenderResult sun = image({1000, 0.5f, 0.5f}), other = image({500, 0.5f, 0.5f});
  EXPECT_EQ(displayError(sun, other, 0).relRms(), 0);
  EXPECT_EQ(displayError(sun, other, -8).relRms(), 0);
  EXPECT_GT(displayError(sun, other, -10).relRms(), 0.4);
}

TEST(DisplayError, ANonFiniteValueIsInfinitelyWrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(displayError(image({nan, 0, 0}), image({1, 1, 1}), 0).relRms()));
}

}  // namespace
}  // namespace malus::render
