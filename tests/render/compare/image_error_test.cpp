#include "render/compare/image_error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/compare/flip.h"

namespace malus::render {
namespace {

RenderResult flat(float value, std::size_t channels = kColourChannels) {
  RenderResult p;
  p.width = 40;
  p.height = 25;
  p.channels = channels;
  p.pixels.assign(1000 * channels, value);
  return p;
}

TEST(ImageError, OfTheReferenceItselfIsNone) {
  const ImageError e = imageError(flat(0.5f), flat(0.5f, kStokesChannels), 0);
  EXPECT_EQ(e.meanAbs, 0);
  EXPECT_EQ(e.maxAbs, 0);
  EXPECT_EQ(e.relRms, 0);
  EXPECT_EQ(e.shareOver1Percent, 0);
  EXPECT_EQ(e.perceptual, 0);
  EXPECT_DOUBLE_EQ(e.energyRatio, 1);
}

TEST(ImageError, CountsWhatIsKnown) {
  RenderResult p = flat(1);
  for (std::size_t i = 0; i < 100; ++i) p.pixels[3 * i] = 1.5f;
  const ImageError e = imageError(p, flat(1), 0);
  EXPECT_NEAR(e.meanAbs, 100 * 0.5 / 3000, 1e-12);
  EXPECT_NEAR(e.maxAbs, 0.5, 1e-12);
  EXPECT_NEAR(e.relRms, std::sqrt(100 * 0.25 / 3000), 1e-12);
  EXPECT_NEAR(e.shareOver1Percent, 0.1, 1e-12);
  EXPECT_NEAR(e.energyRatio, 1 + 50.0 / 3000, 1e-12);
}

TEST(ImageError, OnePercentIsTheLimit) {
  EXPECT_EQ(imageError(flat(1.009f), flat(1), 0).shareOver1Percent, 0);
  EXPECT_EQ(imageError(flat(1.011f), flat(1), 0).shareOver1Percent, 1);
  // Black pixels are measured against the mean of the image.
  RenderResult dark = flat(1), other = flat(1);
  dark.pixels[0] = 0;
  other.pixels[0] = 1e-6f;
  EXPECT_EQ(imageError(other, dark, 0).shareOver1Percent, 0);
}

TEST(ImageError, PerceptualIsFlip) {
  RenderResult p = flat(0.2f);
  for (std::size_t i = 0; i < 300; ++i) p.pixels[i] = 0.8f;
  EXPECT_GT(imageError(p, flat(0.2f), 0).perceptual, 0);
  EXPECT_EQ(imageError(p, flat(0.2f), 1).perceptual, meanFlip(p, flat(0.2f), 1));
}

TEST(ImageError, NotFiniteIsInfinitelyWrong) {
  RenderResult p = flat(1);
  p.pixels[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(imageError(p, flat(1), 0).relRms));
}

TEST(ImageError, RefusesOtherSizes) {
  RenderResult p = flat(1);
  p.width = 20;
  EXPECT_THROW(imageError(p, flat(1), 0), Error);
}

}  // namespace
}  // namespace malus::render
