// Wrap modes, levels, cones and the index of a reflectance, in double precision.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "shaders/optics/optics.h"

namespace malus {
namespace {

using glm::dvec3;

TEST(TextureMap, WrapsCoordinatesAndTexels) {
  EXPECT_DOUBLE_EQ(f64::wrapCoordinate(-0.25, false, false), 0.75);
  EXPECT_DOUBLE_EQ(f64::wrapCoordinate(2.25, false, false), 0.25);
  EXPECT_DOUBLE_EQ(f64::wrapCoordinate(2.25, true, false), 1);
  EXPECT_DOUBLE_EQ(f64::wrapCoordinate(-0.25, false, true), 1.75);
  const auto texel = [](double i, bool isClamped, bool isMirrored) {
    return f64::wrapTexel(i, 4, isClamped, isMirrored);
  };
  EXPECT_EQ(texel(-1, false, false), 3);
  EXPECT_EQ(texel(4, false, false), 0);
  EXPECT_EQ(texel(-1, true, false), 0);
  EXPECT_EQ(texel(4, true, false), 3);
  EXPECT_EQ(texel(-1, false, true), 0);
  EXPECT_EQ(texel(4, false, true), 3);
  EXPECT_EQ(texel(7, false, true), 0);
  EXPECT_EQ(texel(8, false, true), 0);  // the next period begins
}

TEST(TextureMap, TheIndexHasTheReflectance) {
  for (const double r : {0.001, 0.04, 0.3, 0.9, 0.999})
    for (const double g : {0.0, 0.25, 1.0}) {
      const f64::ConductorIndex index = f64::conductorIndex(r, g);
      const double n = index.eta, k = index.k;
      EXPECT_NEAR(((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), r, 1e-12) << r << ' ' << g;
      if (g == 0) {
        EXPECT_EQ(k, 0);
      }
    }
  EXPECT_NEAR(f64::conductorIndex(0.04, 0).eta, 1.5, 1e-12);
}

TEST(TextureMap, LevelsAreLogarithms) {
  EXPECT_EQ(f64::textureLevel(0, 8), 0);
  EXPECT_EQ(f64::textureLevel(1, 8), 0);
  EXPECT_EQ(f64::textureLevel(8, 8), 3);
  EXPECT_EQ(f64::textureLevel(1e9, 8), 7);  // the last
  for (double texels = 1; texels < 100; texels *= 1.07) {
    EXPECT_LE(f64::textureLevel(texels, 12), std::log2(texels) + 1e-12);
    EXPECT_GE(f64::textureLevel(texels, 12), std::log2(texels) - 0.0861);
  }
}

TEST(RayCones, SurviveThePathWord) {
  for (const double width : {1e-9, 3e-4, 1.0, 4e5})
    for (const double spread : {-2.0, -1e-3, 1e-6, 0.7}) {
      const std::uint32_t word = f64::pathWithCone(0xabcd0000u, {width, spread});
      EXPECT_EQ(word >> 16, 0xabcdu);
      const f64::RayCone cone = f64::coneOfPath(word, 5, 6);
      EXPECT_NEAR(cone.width / width, 1, 0.125);
      EXPECT_NEAR(cone.spread / spread, 1, 0.125);
    }
  EXPECT_EQ(f64::coneOfPath(0x20000000u, 5, 6).width, 5);  // the camera's
}

TEST(RayCones, WidenBehindTheirTip) {
  const f64::RayCone cone = f64::coneAfter({1, -0.5}, 6);
  EXPECT_DOUBLE_EQ(cone.width, 2);
  EXPECT_DOUBLE_EQ(cone.spread, 0.5);
}

TEST(RayCones, CurvatureOfASphere) {
  const double radius = 0.25;
  const dvec3 n[3] = {glm::normalize(dvec3(0.1, 0, 1)), glm::normalize(dvec3(0, 0.1, 1)),
                      glm::normalize(dvec3(-0.1, 0.05, 1))};
  EXPECT_NEAR(f64::triangleCurvature(n[0] * radius, n[1] * radius, n[2] * radius, n[0], n[1], n[2]), 4, 1e-9);
  EXPECT_DOUBLE_EQ(f64::reflectedCone({0.01, 0.1}, 4, 0.5).spread, 0.1 + 2 * 4 * 0.01 / 0.5);
}

}  // namespace
}  // namespace malus
