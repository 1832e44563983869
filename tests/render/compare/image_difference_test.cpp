#include "render/compare/image_difference.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"

namespace malus::render {
namespace {

const std::vector<std::string> kRgb = {"R", "G", "B"};

image::Image flat(int width, int height, float value) {
  image::Image image;
  image.width = width;
  image.height = height;
  image.channels = kRgb;
  image.pixels.assign(static_cast<std::size_t>(width * height * 3), value);
  return image;
}

TEST(ImageDifference, OfEqualImagesIsZero) {
  const ImageDifference d = difference(flat(7, 5, 0.3f), flat(7, 5, 0.3f), kRgb, 0);
  EXPECT_EQ(d.mean, 0);
  EXPECT_EQ(d.rms, 0);
  EXPECT_EQ(d.max, 0);
  EXPECT_EQ(d.p999, 0);
  EXPECT_EQ(d.outliers, 0u);
  EXPECT_EQ(d.pixels, 35u);
}

TEST(ImageDifference, CountsWhatIsKnown) {
  image::Image a = flat(100, 100, 1), b = a;
  b.pixels[3 * 17 + 1] += 2;  // one channel of one pixel
  const ImageDifference d = difference(a, b, kRgb, 0.5);
  EXPECT_NEAR(d.mean, 2.0 / 30000, 1e-12);
  EXPECT_NEAR(d.rms, std::sqrt(4.0 / 30000), 1e-12);
  EXPECT_NEAR(d.relRms, std::sqrt(4.0 / 30008), 1e-12);
  EXPECT_EQ(d.max, 2);
  EXPECT_EQ(d.p999, 0);  // one pixel in ten thousand
  EXPECT_EQ(d.outliers, 1u);
}

TEST(ImageDifference, TakesTheNamedChannelsOnly) {
  image::Image a = flat(4, 4, 1), b = a;
  b.pixels[2] = 5;
  EXPECT_EQ(difference(a, b, {"R", "G"}, 0).outliers, 0u);
  EXPECT_EQ(difference(a, b, {"B"}, 0).outliers, 1u);
}

TEST(ImageDifference, CountsNonFinitePixels) {
  image::Image a = flat(4, 4, 1), b = a;
  b.pixels[0] = std::numeric_limits<float>::quiet_NaN();
  a.pixels[5] = std::numeric_limits<float>::infinity();
  const ImageDifference d = difference(a, b, kRgb, 1e9);
  EXPECT_EQ(d.nonFinite, 2u);
  EXPECT_EQ(d.outliers, 2u);
  EXPECT_TRUE(std::isinf(d.max));
}

TEST(ImageDifference, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(difference(flat(4, 4, 1), flat(4, 5, 1), kRgb, 0), Error);
  EXPECT_THROW(difference(flat(4, 4, 1), flat(4, 4, 1), {"S1.R"}, 0), Error);
}

TEST(ImageDifference, ImageShowsTheAmplifiedDifference) {
  image::Image a = flat(2, 1, 1), b = a;
  b.pixels[3] = 0.75f;
  const image::Image d = differenceImage(a, b, 10);
  EXPECT_FLOAT_EQ(d.pixels[3], 2.5f);
  EXPECT_EQ(d.pixels[0], 0);
}

}  // namespace
}  // namespace malus::render
