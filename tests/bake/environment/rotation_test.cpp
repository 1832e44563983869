// Rotated environments against environments that are baked from a rotated image.
#include "bake/environment/rotation.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bake/environment/octahedral_map.h"

namespace malus::bake {
namespace {

// A smooth image with a bright side.
image::Image skyImage() {
  image::Image image;
  image.width = 256;
  image.height = 128;
  image.channels = {"R", "G", "B"};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double azimuth = 2 * std::numbers::pi * (x + 0.5) / image.width,
                   height = std::sin(std::numbers::pi * (y + 0.5) / image.height);
      image.pixels.push_back(static_cast<float>(2 + height * std::sin(azimuth)));
      image.pixels.push_back(static_cast<float>(1 + 0.5 * height * height * std::cos(2 * azimuth)));
      image.pixels.push_back(static_cast<float>(1.5 + 0.3 * std::cos(std::numbers::pi * (y + 0.5) / image.height)));
    }
  return image;
}

pack::Environment bakedAt(double degrees) {
  pack::Environment environment;
  std::vector<std::string> notes;
  bakeEnvironment(skyImage(), "sky", 1, degrees, environment, notes);
  return environment;
}

TEST(RotatedEnvironment, IsThatOfARotatedImage) {
  for (const double degrees : {37.0, -110.0, 200.0}) {
    pack::Environment rotated = bakedAt(15);
    rotateEnvironment(degrees, rotated);
    const pack::Environment expected = bakedAt(15 + degrees);
    ASSERT_EQ(rotated.texels.size(), expected.texels.size());
    for (std::size_t i = 0; i < expected.texels.size(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(rotated.texels[i][c], expected.texels[i][c], 0.01) << degrees;
    for (std::size_t i = 0; i < 9; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(rotated.irradiance[i][c], expected.irradiance[i][c], 1e-9) << degrees << ", coefficient " << i;
  }
}

TEST(RotatedEnvironment, SunTurnsCounterClockwiseSeenFromAbove) {
  pack::Environment environment;
  bakeConstantEnvironment({1, 2, 3}, environment);
  environment.sun = glm::normalize(glm::dvec3(0, 1, -1));
  bakeRayleighIrradiance(environment.sun, environment);
  rotateEnvironment(90, environment);
  // From above, with x to the right and z down, -z turns to -x.
  EXPECT_LT(glm::length(environment.sun - glm::normalize(glm::dvec3(-1, 1, 0))), 1e-15);
  pack::Environment expected;
  bakeConstantEnvironment({1, 2, 3}, expected);
  bakeRayleighIrradiance(environment.sun, expected);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_LT(glm::length(environment.irradiance[i] - expected.irradiance[i]), 1e-13) << i;
}

TEST(RotatedEnvironment, WholeTurnsChangeNothing) {
  const pack::Environment before = bakedAt(0);
  for (const double degrees : {0.0, 360.0, -720.0}) {
    pack::Environment environment = before;
    rotateEnvironment(degrees, environment);
    EXPECT_EQ(environment.texels, before.texels);
    EXPECT_EQ(environment.irradiance, before.irradiance);
  }
}

}  // namespace
}  // namespace malus::bake
