// The octahedral map against the directions that bake/SCENE.md defines for a latitude-longitude image.
#include "bake/environment/octahedral_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

#include <glm/geometric.hpp>

#include "shaders/optics/optics.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using test::contains;
using test::errorMessage;
constexpr double kPi = std::numbers::pi;

// The direction of an image point by bake/SCENE.md: +y up, the centre column toward -z, +x to its right.
glm::dvec3 directionAt(double column, double row, int width, int height) {
  const double azimuth = (column / width - 0.5) * 2 * kPi, fromTop = row / height * kPi;
  return {std::sin(fromTop) * std::sin(azimuth), std::cos(fromTop), -std::sin(fromTop) * std::cos(azimuth)};
}

template <class Radiance>
image::Image makeImage(int width, int height, Radiance radiance) {
  image::Image result;
  result.width = width;
  result.height = height;
  result.channels = {"R", "G", "B"};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 value = radiance(directionAt(x + 0.5, y + 0.5, width, height));
      for (int c = 0; c < 3; ++c) result.pixels.push_back(static_cast<float>(value[c]));
    }
  return result;
}

pack::Environment baked(const image::Image& source, double scale = 1, double rotationDegrees = 0) {
  pack::Environment environment;
  std::vector<std::string> notes;
  bakeEnvironment(source, "sky.hdr", scale, rotationDegrees, environment, notes);
  return environment;
}

image::Image uniform(int width, int height, double value) {
  return makeImage(width, height, [=](const glm::dvec3&) { return glm::dvec3(value); });
}

glm::dvec3 texel(const pack::Environment& e, int i, int j) {
  const int row = static_cast<int>(e.size) + 2;
  return glm::dvec3(e.texels.at(static_cast<std::size_t>((j + 1) * row + i + 1)));
}

// Bilinear lookup at map coordinates in [0, 1], as in the renderers.
glm::dvec3 lookUp(const pack::Environment& e, double u, double v) {
  const double x = u * e.size - 0.5, y = v * e.size - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  return (texel(e, i, j) * (1 - fx) + texel(e, i + 1, j) * fx) * (1 - fy) +
         (texel(e, i, j + 1) * (1 - fx) + texel(e, i + 1, j + 1) * fx) * fy;
}

glm::dvec3 lookUp(const pack::Environment& e, const glm::dvec3& d) {
  double u = 0, v = 0;
  f64::octahedralFromDirection(d, u, v);
  return lookUp(e, u, v);
}

double irradiance(const pack::Environment& e, const glm::dvec3& n) {
  const auto& c = e.irradiance;
  return f64::irradiancePolynomial(n, c[0].x, c[1].x, c[2].x, c[3].x, c[4].x, c[5].x, c[6].x, c[7].x, c[8].x);
}

std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> list = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i)
    list.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return list;
}

// A radiance without symmetry, different in every direction.
glm::dvec3 gradient(const glm::dvec3& d) { return d * 0.5 + 0.5; }

image::Image noise() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  return makeImage(64, 32, [&](const glm::dvec3&) {
    const double r = uniform(random), g = uniform(random), b = uniform(random);
    return glm::dvec3(r, g, b);
  });
}

TEST(OctahedralMap, ConstantStaysConstant) {
  const pack::Environment e = baked(makeImage(192, 96, [](const glm::dvec3&) { return glm::dvec3(0.5, 2, 8); }), 0.25);
  EXPECT_EQ(e.size, 96u);
  ASSERT_EQ(e.texels.size(), 98u * 98u);
  for (const glm::vec3& t : e.texels) EXPECT_EQ(t, glm::vec3(0.125f, 0.5f, 2));
}

TEST(OctahedralMap, DirectionsAreThoseOfTheDocument) {
  const pack::Environment e = baked(makeImage(256, 128, gradient));
  for (const glm::dvec3& d : directions())
    EXPECT_LT(glm::distance(lookUp(e, d), gradient(d)), 0.02) << d.x << " " << d.y << " " << d.z;
}

TEST(OctahedralMap, RotationIsCounterClockwiseFromAbove) {
  // 90 degrees move -z to -x and +x to -z.
  const pack::Environment e = baked(makeImage(256, 128, gradient), 1, 90);
  EXPECT_LT(glm::distance(lookUp(e, {-1, 0, 0}), gradient({0, 0, -1})), 0.02);
  EXPECT_LT(glm::distance(lookUp(e, {0, 0, -1}), gradient({1, 0, 0})), 0.02);
  EXPECT_LT(glm::distance(lookUp(e, {0, 1, 0}), gradient({0, 1, 0})), 0.02);
  // The irradiance rotates with the image.
  const auto lobe = [](const glm::dvec3& d) { return glm::dvec3(std::max(-d.z, 0.0)); };
  const pack::Environment still = baked(makeImage(128, 64, lobe)), turned = baked(makeImage(128, 64, lobe), 1, 90);
  EXPECT_NEAR(irradiance(turned, {-1, 0, 0}), irradiance(still, {0, 0, -1}), 1e-3);
  EXPECT_NEAR(irradiance(turned, {0, 0, 1}), irradiance(still, {-1, 0, 0}), 1e-3);
  EXPECT_LT(irradiance(turned, {1, 0, 0}), 0.1);
}

TEST(OctahedralMap, BorderRepeatsTexelsAcrossTheEdges) {
  const pack::Environment e = baked(noise());
  const int n = static_cast<int>(e.size);
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(texel(e, i, -1), texel(e, n - 1 - i, 0));
    EXPECT_EQ(texel(e, i, n), texel(e, n - 1 - i, n - 1));
    EXPECT_EQ(texel(e, -1, i), texel(e, 0, n - 1 - i));
    EXPECT_EQ(texel(e, n, i), texel(e, n - 1, n - 1 - i));
  }
  EXPECT_EQ(texel(e, -1, -1), texel(e, n - 1, n - 1));
  EXPECT_EQ(texel(e, n, n), texel(e, 0, 0));
  EXPECT_EQ(texel(e, n, -1), texel(e, 0, n - 1));
  EXPECT_EQ(texel(e, -1, n), texel(e, n - 1, 0));
}

TEST(OctahedralMap, ContinuousAcrossEveryEdge) {
  // Edge points of the square with the same direction have the same value.
  const pack::Environment e = baked(noise());
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    const glm::dvec3 here = f64::directionFromOctahedral(0.0, t), there = f64::directionFromOctahedral(0.0, 1 - t);
    ASSERT_LT(glm::distance(here, there), 1e-12);
    EXPECT_LT(glm::distance(lookUp(e, 0, t), lookUp(e, 0, 1 - t)), 1e-12) << t;
    EXPECT_LT(glm::distance(lookUp(e, 1, t), lookUp(e, 1, 1 - t)), 1e-12) << t;
    EXPECT_LT(glm::distance(lookUp(e, t, 0), lookUp(e, 1 - t, 0)), 1e-12) << t;
    EXPECT_LT(glm::distance(lookUp(e, t, 1), lookUp(e, 1 - t, 1)), 1e-12) << t;
  }
}

TEST(OctahedralMap, NoStepAlongAnyPath) {
  // Great circles through poles, edges and corners of the map: neighbours differ by what a texel's slope allows.
  const pack::Environment e = baked(makeImage(256, 128, gradient));
  constexpr int kSteps = 20000;
  for (const auto& [a, b] : {std::pair<glm::dvec3, glm::dvec3>{{1, 0, 0}, {0, 1, 0}},
                             {{1, 0, 0}, {0, 0, 1}},
                             {{0, 1, 0}, {0, 0, 1}},
                             {{0.6, 0.8, 0}, {0, 0, 1}},
                             {{0.6, -0.8, 0}, {0.64, 0.48, 0.6}}}) {
    glm::dvec3 last = lookUp(e, a);
    for (int i = 1; i <= kSteps; ++i) {
      const double angle = 2 * kPi * i / kSteps;
      const glm::dvec3 value = lookUp(e, a * std::cos(angle) + b * std::sin(angle));
      ASSERT_LT(glm::distance(value, last), 10.0 / kSteps) << i;
      last = value;
    }
  }
}

TEST(OctahedralMap, TexelsAreHalves) {
  for (const glm::vec3& t : baked(noise(), 0.37).texels)
    for (int c = 0; c < 3; ++c) {
      const float scaled = t[c] * 4194304;  // between 2^-12 and 1, halves are multiples of 2^-22
      ASSERT_EQ(scaled, std::round(scaled));
    }
}

// The map and the irradiance keep every radiance within the error that texel_storage.h states.
TEST(OctahedralMap, RadianceOutsideTheRangeOfHalvesIsKept) {
  for (const double value : {1e-12, 1e-8, 1e-7, 1e-6, 1.0, 7e4, 3e5, 1e9}) {
    const pack::Environment e = baked(uniform(64, 32, value));
    EXPECT_NEAR(lookUp(e, {0, 1, 0}).x / value, 1, 5e-4) << value;
    EXPECT_NEAR(irradiance(e, {0, 1, 0}) / value, kPi, 1e-4) << value;
    EXPECT_FALSE(e.storage.isFloat) << value;
    EXPECT_EQ(e.storage.isPlain(), value == 1) << value;
  }
  EXPECT_NEAR(lookUp(baked(uniform(4, 2, 1), 1e-9), {0, 1, 0}).x, 1e-9, 1e-12);
}

// A sun of 3e5 beside a night sky of 1e-6: no scale brings both into the range of halves.
TEST(OctahedralMap, RangesWiderThanThatOfHalvesAreFloats) {
  const pack::Environment e =
      baked(makeImage(128, 64, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0 ? 3e5 : 1e-6); }));
  EXPECT_TRUE(e.storage.isFloat);
  EXPECT_FLOAT_EQ(static_cast<float>(lookUp(e, {0.9, 0.1, 0.1}).x), 3e5f);
  EXPECT_FLOAT_EQ(static_cast<float>(lookUp(e, {-0.9, 0.1, 0.1}).x), 1e-6f);
}

TEST(OctahedralMap, SmallImagesAreNotBlurred) {
  const pack::Environment one = baked(uniform(1, 1, 3));
  EXPECT_EQ(one.size, 64u);
  EXPECT_EQ(lookUp(one, {0.6, 0, 0.8}), glm::dvec3(3));
  // Columns 4 to 7 of 8 are toward +x.
  const pack::Environment half =
      baked(makeImage(8, 4, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0 ? 1 : 0); }));
  EXPECT_NEAR(lookUp(half, {1, 0, 0}).x, 1, 1e-6);
  EXPECT_NEAR(lookUp(half, {-1, 0, 0}).x, 0, 1e-6);
  // A row of pixels is as wide as an image of half its width is high.
  EXPECT_EQ(baked(uniform(512, 1, 1)).size, 256u);
}

// A sun of one texel is not missed by a map with fewer texels than the image.
TEST(OctahedralMap, LargeImagesKeepTheirLight) {
  constexpr int kWidth = 4096, kHeight = 2048;
  image::Image source = uniform(kWidth, kHeight, 0);
  for (const int x : {100, 1234, 2777}) {
    for (int c = 0; c < 3; ++c)
      source.pixels[3 * (600 * kWidth + static_cast<std::size_t>(x)) + static_cast<std::size_t>(c)] = 1e6f;
  }
  const pack::Environment e = baked(source);
  ASSERT_EQ(e.size, 1024u);
  double sum = 0;  // over the solid angles of the map's texels
  for (int j = 0; j < 1024; ++j)
    for (int i = 0; i < 1024; ++i) {
      double u = (i + 0.5) / 512 - 1, v = (j + 0.5) / 512 - 1;
      const double z = 1 - std::abs(u) - std::abs(v);
      if (z < 0) std::tie(u, v) = std::pair(1 - std::abs(v), 1 - std::abs(u));
      sum += texel(e, i, j).x * 4 / (1024.0 * 1024.0) / std::pow(u * u + v * v + z * z, 1.5);
    }
  const double rows = kPi / kHeight, expected = 3 * 1e6 * std::sin(600.5 * rows) * rows * 2 * kPi / kWidth;
  EXPECT_NEAR(sum / expected, 1, 0.05);
}

// The irradiance does not depend on the number of texels.
TEST(Irradiance, IsThatOfTheSameSkyAtEverySize) {
  const pack::Environment large = baked(uniform(1024, 512, 2));
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(2, 1), std::pair(4, 2), std::pair(7, 3), std::pair(1024, 1)}) {
    const pack::Environment small = baked(uniform(width, height, 2));
    for (const glm::dvec3& n : directions()) {
      EXPECT_NEAR(irradiance(small, n), irradiance(large, n), 1e-6) << width << " x " << height;
      EXPECT_NEAR(irradiance(small, n), 2 * kPi, 1e-3);
    }
  }
}

TEST(Irradiance, ConstantRadianceGivesPiTimesIt) {
  const pack::Environment e = baked(makeImage(64, 32, [](const glm::dvec3&) { return glm::dvec3(2.5); }));
  pack::Environment constant;
  bakeConstantEnvironment(glm::dvec3(2.5), constant);
  EXPECT_EQ(constant.size, 0u);
  EXPECT_EQ(constant.radiance, glm::dvec3(2.5));
  for (const glm::dvec3& n : directions()) {
    EXPECT_NEAR(irradiance(e, n), kPi * 2.5, 1e-4);
    EXPECT_NEAR(irradiance(constant, n), kPi * 2.5, 1e-12);
  }
}

TEST(Irradiance, ClampedCosineLobe) {
  // Both are clamped cosines with the weights pi, 2 pi/3 and pi/4 of bands 0 to 2: the sum over the bands of
  // (2 l + 1)/(4 pi) weight^2 P_l(cos).
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.7, -0.5));
  const pack::Environment e =
      baked(makeImage(256, 128, [&](const glm::dvec3& d) { return glm::dvec3(std::max(glm::dot(d, axis), 0.0)); }));
  for (const glm::dvec3& n : directions()) {
    const double c = glm::dot(n, axis);
    const double expected = kPi / 4 + kPi / 3 * c + 5 * kPi / 64 * (3 * c * c - 1) / 2;
    EXPECT_NEAR(irradiance(e, n), std::max(expected, 0.0), 2e-3) << c;
  }
}

TEST(OctahedralMap, InvalidImages) {
  image::Image grey = makeImage(4, 2, gradient);
  grey.channels = {"U", "V", "W"};
  EXPECT_TRUE(contains(errorMessage([&] { baked(grey); }), "no colour"));
  for (const float bad :
       {-1.0f, 2e15f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    image::Image source = makeImage(4, 2, gradient);
    source.pixels[3 * 5 + 1] = bad;
    const std::string error = errorMessage([&] { baked(source); });
    EXPECT_TRUE(contains(error, "sky.hdr", "texel 1, 1")) << error;
  }
}

TEST(OctahedralMap, ColoursAreLinear) {
  image::Image png = uniform(4, 2, 188.0 / 255);
  png.encoding.transfer = image::Encoding::Transfer::sRgb;
  EXPECT_NEAR(lookUp(baked(png), {0, 1, 0}).x, 0.502886, 5e-4);
}

TEST(OctahedralMap, ChannelsByName) {
  image::Image source;
  source.width = source.height = 1;
  source.channels = {"A", "B", "G", "R"};
  source.pixels = {9, 3, 2, 1};
  EXPECT_EQ(lookUp(baked(source), {0, 1, 0}), glm::dvec3(1, 2, 3));
}

}  // namespace
}  // namespace malus::bake
