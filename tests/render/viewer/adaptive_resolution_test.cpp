// The controller against simulated renderers whose time is proportional to the pixels.
#include "render/viewer/adaptive_resolution.h"

#include <gtest/gtest.h>

#include "render/viewer/frame_times.h"

namespace malus::viewer {
namespace {

// Runs frames of a renderer that takes fullMs at full resolution. Returns the time of the last.
double simulate(AdaptiveResolution& resolution, double fullMs, int frames) {
  double ms = 0;
  for (int i = 0; i < frames; ++i) {
    const double f = resolution.fraction();
    ms = fullMs * f * f;
    resolution.add(f, ms);
  }
  return ms;
}

TEST(AdaptiveResolution, RendersFastImagesInFull) {
  AdaptiveResolution resolution;
  simulate(resolution, 20, 20);
  EXPECT_EQ(resolution.fraction(), 1);
}

TEST(AdaptiveResolution, KeepsTwentyFramesPerSecond) {
  for (const double fullMs : {60.0, 200.0, 1000.0, 5000.0}) {
    AdaptiveResolution resolution;
    const double ms = simulate(resolution, fullMs, 30);
    EXPECT_LE(ms, AdaptiveResolution::kLongestFrameMs) << fullMs;
    // And does not waste: the image could not have a third more pixels per side.
    const double f = 1.34 * resolution.fraction();
    EXPECT_GT(fullMs * f * f, 0.9 * AdaptiveResolution::kLongestFrameMs / 2) << fullMs;
  }
}

TEST(AdaptiveResolution, FollowsASlowerMethodAtOnce) {
  AdaptiveResolution resolution;
  simulate(resolution, 40, 30);
  EXPECT_LE(simulate(resolution, 900, 2), AdaptiveResolution::kLongestFrameMs);  // one slow frame, then a fast one
}

TEST(AdaptiveResolution, DoesNotFlickerAtSmallChanges) {
  AdaptiveResolution resolution;
  simulate(resolution, 300, 30);
  const double before = resolution.fraction();
  for (const double fullMs : {304.0, 296.0, 310.0, 291.0}) simulate(resolution, fullMs, 1);
  EXPECT_EQ(resolution.fraction(), before);
}

TEST(AdaptiveResolution, HasALimitAndIgnoresNonsense) {
  AdaptiveResolution resolution;
  simulate(resolution, 1e9, 50);
  EXPECT_EQ(resolution.fraction(), AdaptiveResolution::kLeast);
  resolution.add(0, 5);
  resolution.add(0.5, 0);
  EXPECT_EQ(resolution.fraction(), AdaptiveResolution::kLeast);
}

TEST(FrameTimes, MedianOfTheLastThirtyAndPlotOfTwoHundred) {
  FrameTimes times;
  EXPECT_EQ(times.median(), 0);
  for (int i = 0; i < 1000; ++i) times.add(1000);
  for (int i = 0; i < 30; ++i) times.add(i);
  EXPECT_NEAR(times.median(), 14.5, 0.51);
  const std::vector<float> values = times.values();
  ASSERT_EQ(values.size(), 200u);
  EXPECT_EQ(values.front(), 1000);
  EXPECT_EQ(values.back(), 29);
}

}  // namespace
}  // namespace malus::viewer
