#include "bake/environment/octahedral_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "bake/pack/texel_storage.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image_colour.h"
#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

constexpr double kPi = std::numbers::pi;

// The image as a function of direction.
class LatLong {
 public:
  LatLong(const image::Image& image, std::string_view where, double scale, std::vector<std::string>& notes)
      : width_(image.width), height_(image.height) {
    const image::LinearColours colours(image, where);
    notes.insert(notes.end(), colours.notes().begin(), colours.notes().end());
    texels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (std::size_t i = 0; i < texels_.size(); ++i) {
      const std::array<double, 3> linear = colours.at(i);
      for (int c = 0; c < 3; ++c) {
        const double value = linear[static_cast<std::size_t>(c)], radiance = value * scale;
        // Written so that a NaN fails.
        if (!(value >= 0 && radiance <= pack::kMaxLight))
          throw Error(where,
                      fmt::format("environment texel {}, {}", i % static_cast<std::size_t>(width_),
                                  i / static_cast<std::size_t>(width_)),
                      fmt::format("a radiance of 0 to {:g} after 'scale'", pack::kMaxLight),
                      fmt::format("{:g}", radiance));
        texels_[i][c] = radiance;
      }
    }
  }

  glm::dvec3 at(const glm::dvec3& d) const {
    const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * kPi), v = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi;
    return interpolate(u * width_, v * height_);
  }
  // Bilinear, at a position in texels; columns wrap around, rows end at the poles.
  glm::dvec3 interpolate(double column, double row) const {
    const double x = column - 0.5, y = row - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
           (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
  }
  const glm::dvec3& texel(int x, int y) const {
    const int column = ((x % width_) + width_) % width_, row = std::clamp(y, 0, height_ - 1);
    return texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)];
  }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  std::vector<glm::dvec3> texels_;
};

glm::dvec3 rotateAboutY(const glm::dvec3& d, double degrees) {
  const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
  return {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
}

// Coefficients in the order of irradiancePolynomial: the clamped cosine's weights pi, 2 pi/3, pi/4 of the
// bands times the squared norms of the basis times the moments of the radiance. Source: Ramamoorthi and
// Hanrahan 2001 (shaders/optics/environment.h).
struct Moments {
  std::array<glm::dvec3, 9> sums{};
  void add(const glm::dvec3& n, const glm::dvec3& light) {
    const double basis[9] = {
        1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
    for (std::size_t i = 0; i < 9; ++i) sums[i] += light * basis[i];
  }
  std::array<glm::dvec3, 9> coefficients() const {
    const double k0 = 1 / (4 * kPi), k1 = 3 / (4 * kPi), k2 = 15 / (4 * kPi), k20 = 5 / (16 * kPi),
                 k22 = 15 / (16 * kPi);
    const double weights[9] = {kPi * k0,     2 * kPi / 3 * k1, 2 * kPi / 3 * k1, 2 * kPi / 3 * k1, kPi / 4 * k2,
                               kPi / 4 * k2, kPi / 4 * k20,    kPi / 4 * k2,     kPi / 4 * k22};
    std::array<glm::dvec3, 9> result = sums;
    for (std::size_t i = 0; i < 9; ++i) result[i] *= weights[i];
    return result;
  }
};

// Sides of the octahedral map, in texels.
constexpr int kLeastSide = 64, kMostSide = 1024;
// The irradiance is summed over at least so many rows.
constexpr int kLeastRows = 512;

// Sums over the texels of the image, or of smaller parts of a small image, each weighted by its solid angle.
std::array<glm::dvec3, 9> irradiance(const LatLong& source, double rotationDegrees) {
  const auto parts = [](int count, int least) { return (least + count - 1) / count; };
  const int across = parts(source.width(), 2 * kLeastRows), down = parts(source.height(), kLeastRows);
  const int columns = source.width() * across, rows = source.height() * down;
  Moments moments;
  for (int y = 0; y < rows; ++y) {
    const double top = kPi * y / rows, bottom = kPi * (y + 1) / rows, middle = (top + bottom) / 2;
    const double solidAngle = (std::cos(top) - std::cos(bottom)) * 2 * kPi / columns;
    for (int x = 0; x < columns; ++x) {
      const double azimuth = ((x + 0.5) / columns - 0.5) * 2 * kPi;
      const glm::dvec3 d(std::sin(middle) * std::sin(azimuth), std::cos(middle), -std::sin(middle) * std::cos(azimuth));
      const glm::dvec3 radiance =
          across == 1 && down == 1 ? source.texel(x, y) : source.interpolate((x + 0.5) / across, (y + 0.5) / down);
      moments.add(rotateAboutY(d, rotationDegrees), radiance * solidAngle);
    }
  }
  return moments.coefficients();
}

}  // namespace

glm::vec3& octahedralTexel(pack::Environment& environment, int i, int j) {
  const std::size_t row = environment.size + std::size_t{2};
  return environment.texels[static_cast<std::size_t>(j + 1) * row + static_cast<std::size_t>(i + 1)];
}

void fillOctahedralBorder(pack::Environment& environment) {
  const int size = static_cast<int>(environment.size);
  // Each edge of the square is folded about its middle.
  for (int j = -1; j <= size; ++j)
    for (int i = -1; i <= size; ++i) {
      int x = i, y = j;
      if (x < 0 || x >= size) x = x < 0 ? -1 - x : 2 * size - 1 - x, y = size - 1 - y;
      if (y < 0 || y >= size) y = y < 0 ? -1 - y : 2 * size - 1 - y, x = size - 1 - x;
      if (x != i || y != j) octahedralTexel(environment, i, j) = octahedralTexel(environment, x, y);
    }
}

void bakeEnvironment(const image::Image& image, std::string_view where, double scale, double rotationDegrees,
                     pack::Environment& environment, std::vector<std::string>& notes) {
  const LatLong source(image, where, scale, notes);
  // A texel of the octahedral map is as wide as 1.13 rows of an image of the same height. A small map would blur the
  // image's own interpolation.
  const int rows = std::max(source.height(), (source.width() + 1) / 2), size = std::clamp(rows, kLeastSide, kMostSide);
  const int samples = std::max(2, static_cast<int>(std::ceil(1.13 * rows / size)));

  // Each texel is the mean of a grid of samples over its area, so that none of the image's texels is missed.
  const auto texelAt = [&](int i, int j) {
    glm::dvec3 sum(0.0);
    for (int b = 0; b < samples; ++b)
      for (int a = 0; a < samples; ++a)
        sum += source.at(rotateAboutY(
            f64::directionFromOctahedral((i + (a + 0.5) / samples) / size, (j + (b + 0.5) / samples) / size),
            -rotationDegrees));
    return sum * (1.0 / (samples * samples));
  };
  environment.size = static_cast<std::uint32_t>(size);
  const int row = size + 2;
  environment.texels.assign(static_cast<std::size_t>(row) * static_cast<std::size_t>(row), glm::vec3(0));
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) octahedralTexel(environment, i, j) = glm::vec3(texelAt(i, j));
  fillOctahedralBorder(environment);
  environment.storage = pack::chooseTexelStorage(environment.texels);
  pack::roundTexels(environment.storage, environment.texels);
  environment.irradiance = irradiance(source, rotationDegrees);
}

void bakeConstantEnvironment(const glm::dvec3& radiance, pack::Environment& environment) {
  environment.radiance = radiance;
  environment.size = 0;
  environment.irradiance = {};
  environment.irradiance[0] = radiance * kPi;
}

void bakeRayleighIrradiance(const glm::dvec3& sun, pack::Environment& environment) {
  // 3/4 (1 + (d.sun)^2) = 1 + 3/4 ((d.sun)^2 - 1/3): bands 0 and 2, whose clamped cosines weigh pi and pi/4.
  const glm::dvec3 band = environment.radiance * (3 * kPi / 16);
  environment.irradiance[4] = band * (2 * sun.x * sun.y);
  environment.irradiance[5] = band * (2 * sun.y * sun.z);
  environment.irradiance[6] = band * ((2 * sun.z * sun.z - sun.x * sun.x - sun.y * sun.y) / 6);
  environment.irradiance[7] = band * (2 * sun.x * sun.z);
  environment.irradiance[8] = band * ((sun.x * sun.x - sun.y * sun.y) / 2);
}

}  // namespace malus::bake
