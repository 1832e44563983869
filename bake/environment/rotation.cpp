#include "bake/environment/rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "bake/environment/octahedral_map.h"
#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

// Lookups per texel along each axis.
constexpr int kSamples = 4;

glm::dmat3 rotationAboutY(double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}

// Bilinear, as the renderers read the map.
glm::dvec3 lookUp(const pack::Environment& environment, const glm::dvec3& direction) {
  double u = 0, v = 0;
  f64::octahedralFromDirection(direction, u, v);
  const int size = static_cast<int>(environment.size), row = size + 2;
  const double x = u * size + 0.5, y = v * size + 0.5;  // the border's texels are at 0 and size + 1
  const int x0 = std::clamp(static_cast<int>(x), 0, size), y0 = std::clamp(static_cast<int>(y), 0, size);
  const double fx = x - x0, fy = y - y0;
  const auto texel = [&](int i, int j) {
    return glm::dvec3(
        environment.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(row) + static_cast<std::size_t>(i)]);
  };
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

void rotateMap(const glm::dmat3& back, pack::Environment& environment) {
  const pack::Environment source = environment;
  const int size = static_cast<int>(environment.size);
  oneapi::tbb::parallel_for(0, size, [&](int j) {
    for (int i = 0; i < size; ++i) {
      glm::dvec3 sum(0.0);
      for (int b = 0; b < kSamples; ++b)
        for (int a = 0; a < kSamples; ++a)
          sum += lookUp(source, back * f64::directionFromOctahedral((i + (a + 0.5) / kSamples) / size,
                                                                    (j + (b + 0.5) / kSamples) / size));
      octahedralTexel(environment, i, j) = glm::vec3(sum / (1.0 * kSamples * kSamples));
    }
  });
  fillOctahedralBorder(environment);
}

// The coefficients of irradiancePolynomial: a constant, a linear form, and a quadratic form without trace.
void rotateIrradiance(const glm::dmat3& rotation, std::array<glm::dvec3, 9>& coefficients) {
  for (int colour = 0; colour < 3; ++colour) {
    const auto c = [&](std::size_t i) -> double& { return coefficients[i][colour]; };
    const glm::dvec3 linear = rotation * glm::dvec3(c(3), c(1), c(2));
    c(3) = linear.x, c(1) = linear.y, c(2) = linear.z;
    // c4 xy + c5 yz + c6 (3 z^2 - 1) + c7 xz + c8 (x^2 - y^2), with 1 = x^2 + y^2 + z^2.
    const glm::dmat3 form = {
        {c(8) - c(6), c(4) / 2, c(7) / 2}, {c(4) / 2, -c(8) - c(6), c(5) / 2}, {c(7) / 2, c(5) / 2, 2 * c(6)}};
    const glm::dmat3 rotated = rotation * form * glm::transpose(rotation);
    c(4) = 2 * rotated[0][1], c(5) = 2 * rotated[1][2], c(6) = rotated[2][2] / 2, c(7) = 2 * rotated[0][2];
    c(8) = (rotated[0][0] - rotated[1][1]) / 2;
  }
}

}  // namespace

void rotateEnvironment(double degrees, pack::Environment& environment) {
  if (std::fmod(degrees, 360) == 0) return;
  const glm::dmat3 rotation = rotationAboutY(std::fmod(degrees, 360));
  environment.sun = rotation * environment.sun;
  rotateIrradiance(rotation, environment.irradiance);
  if (environment.size > 0) rotateMap(glm::transpose(rotation), environment);
}

}  // namespace malus::bake
