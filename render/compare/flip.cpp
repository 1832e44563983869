#include "render/compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "meshprep/base/error.h"

namespace malus::render {

namespace {

using Colour = std::array<double, 3>;

// Linear sRGB to CIE XYZ (the paper's supplement), and the white of R = G = B = 1.
constexpr double kToXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                 {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                 {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double kFromXyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                   {-0.969224334, 1.875930071, 0.041554224},
                                   {0.055639423, -0.204011202, 1.057148933}};
Colour product(const double (&m)[3][3], const Colour& v) {
  Colour r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}
const Colour kWhite = product(kToXyz, {1, 1, 1});

// Opponent space YCxCz, in which the contrast sensitivity of human vision is known, and back.
Colour toOpponent(const Colour& linear) {
  const Colour xyz = product(kToXyz, linear);
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Colour toLinearRgb(const Colour& opponent) {
  const double y = (opponent[0] + 16) / 116, x = y + opponent[1] / 500, z = y - opponent[2] / 200;
  return product(kFromXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

// CIELAB with the Hunt effect: colours of low luminance look less saturated.
Colour toHuntLab(const Colour& linear) {
  const Colour xyz = product(kToXyz, linear);
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  const double l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}
double hyAb(const Colour& a, const Colour& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

using Plane = std::vector<double>;
struct Size {
  std::size_t width, height;
};

// Taps from -radius to radius.
using Kernel = std::vector<double>;
template <class F>
Kernel makeKernel(int radius, F value) {
  Kernel k;
  for (int i = -radius; i <= radius; ++i) k.push_back(value(static_cast<double>(i)));
  return k;
}
// Scaled so that the positive taps sum to 1 and the negative ones to -1.
Kernel balanced(Kernel k) {
  double positive = 0, negative = 0;
  for (const double v : k) (v > 0 ? positive : negative) += v;
  for (double& v : k) v /= v > 0 ? positive : negative < 0 ? -negative : 1;
  return k;
}

// Separable convolution. Pixels outside the image repeat its border.
Plane convolved(const Plane& in, const Size& size, const Kernel& kernelX, const Kernel& kernelY) {
  Plane rows(in.size()), out(in.size());
  const auto pass = [&](const Plane& from, Plane& to, const Kernel& kernel, bool horizontal) {
    const auto radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
    oneapi::tbb::parallel_for(std::size_t{0}, size.height, [&](std::size_t y) {
      const auto last = static_cast<std::ptrdiff_t>(horizontal ? size.width : size.height) - 1;
      for (std::size_t x = 0; x < size.width; ++x) {
        double sum = 0;
        for (std::ptrdiff_t i = -radius; i <= radius; ++i) {
          const auto at = static_cast<std::size_t>(
              std::clamp(static_cast<std::ptrdiff_t>(horizontal ? x : y) + i, std::ptrdiff_t{0}, last));
          sum += kernel[static_cast<std::size_t>(i + radius)] *
                 (horizontal ? from[y * size.width + at] : from[at * size.width + x]);
        }
        to[y * size.width + x] = sum;
      }
    });
  };
  pass(in, rows, kernelX, true);
  pass(rows, out, kernelY, false);
  return out;
}

// Contrast sensitivity of one opponent channel: a sum of two separable Gaussians over the image.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Plane filteredBySensitivity(const Plane& in, const Size& size, const Sensitivity& s, double pixelsPerDegree) {
  constexpr double kPi = std::numbers::pi, kWidest = 0.04;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
  const auto gaussian = [&](double b) {
    return makeKernel(
        radius, [&](double i) { return std::exp(-kPi * kPi * (i / pixelsPerDegree) * (i / pixelsPerDegree) / b); });
  };
  const auto tapSum = [](const Kernel& k) {
    double sum = 0;
    for (const double v : k) sum += v;
    return sum;
  };
  const Kernel g1 = gaussian(s.b1), g2 = gaussian(s.b2);
  const double w1 = s.a1 * std::sqrt(kPi / s.b1), w2 = s.a2 * std::sqrt(kPi / s.b2);
  const double total = w1 * tapSum(g1) * tapSum(g1) + w2 * tapSum(g2) * tapSum(g2);
  Plane out = convolved(in, size, g1, g1);
  for (double& v : out) v *= w1 / total;
  if (w2 > 0) {
    const Plane second = convolved(in, size, g2, g2);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += second[i] * (w2 / total);
  }
  return out;
}

// Strengths of edges and of points (lines) in the achromatic channel: first and second derivatives of Gaussians.
struct Features {
  Plane edges, points;
};
Features detectFeatures(const Plane& achromatic, const Size& size, double pixelsPerDegree) {
  constexpr double kFeatureDegrees = 0.082;
  const double sd = 0.5 * kFeatureDegrees * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  const auto g = [&](double i) { return std::exp(-i * i / (2 * sd * sd)); };
  const Kernel smooth = balanced(makeKernel(radius, g));
  const Kernel first = balanced(makeKernel(radius, [&](double i) { return -i * g(i); }));
  const Kernel second = balanced(makeKernel(radius, [&](double i) { return (i * i / (sd * sd) - 1) * g(i); }));
  const auto strength = [&](const Kernel& kernel) {
    Plane x = convolved(achromatic, size, kernel, smooth);
    const Plane y = convolved(achromatic, size, smooth, kernel);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  return {strength(first), strength(second)};
}

struct Perceived {
  std::array<Plane, 3> filtered;  // opponent channels, filtered by the contrast sensitivity
  Features features;
};
Perceived perceive(const RenderResult& image, double gain, double pixelsPerDegree) {
  const Size size{image.width, image.height};
  const std::size_t count = size.width * size.height;
  std::array<Plane, 3> planes;
  for (Plane& p : planes) p.resize(count);
  Plane achromatic(count);
  for (std::size_t i = 0; i < count; ++i) {
    Colour c{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = image.pixels[i * image.channels + k] * gain;
      c[k] = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 1.0;
    }
    const Colour o = toOpponent(c);
    for (std::size_t k = 0; k < 3; ++k) planes[k][i] = o[k];
    achromatic[i] = (o[0] + 16) / 116;
  }
  Perceived result;
  for (std::size_t k = 0; k < 3; ++k)
    result.filtered[k] = filteredBySensitivity(planes[k], size, kSensitivity[k], pixelsPerDegree);
  result.features = detectFeatures(achromatic, size, pixelsPerDegree);
  return result;
}

constexpr double kColourPower = 0.7, kFeaturePower = 0.5;
// Colour errors up to kKnee of the largest take kKneeValue of the scale.
constexpr double kKnee = 0.4, kKneeValue = 0.95;

}  // namespace

std::vector<double> flipValues(const RenderResult& image, const RenderResult& reference, double exposureEv,
                               double pixelsPerDegree) {
  if (image.width != reference.width || image.height != reference.height)
    throw Error("", "the images differ in size", fmt::format("{} x {}", reference.width, reference.height),
                fmt::format("{} x {}", image.width, image.height));
  const double gain = std::exp2(exposureEv);
  const Perceived a = perceive(image, gain, pixelsPerDegree), b = perceive(reference, gain, pixelsPerDegree);
  // The largest colour difference that a display can make: green against blue.
  const double largest = std::pow(hyAb(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColourPower);
  const double knee = kKnee * largest;
  const auto labAt = [](const Perceived& s, std::size_t i) {
    Colour c = toLinearRgb({s.filtered[0][i], s.filtered[1][i], s.filtered[2][i]});
    for (double& v : c) v = std::clamp(v, 0.0, 1.0);
    return toHuntLab(c);
  };
  std::vector<double> values(a.features.edges.size());
  oneapi::tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
    double colour = std::pow(hyAb(labAt(a, i), labAt(b, i)), kColourPower);
    colour =
        colour < knee ? kKneeValue / knee * colour : kKneeValue + (colour - knee) / (largest - knee) * (1 - kKneeValue);
    const double feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                    std::abs(a.features.points[i] - b.features.points[i]));
    values[i] = std::pow(colour, 1 - std::pow(std::numbers::sqrt2 / 2 * feature, kFeaturePower));
  });
  return values;
}

double meanFlip(const RenderResult& image, const RenderResult& reference, double exposureEv, double pixelsPerDegree) {
  double sum = 0;
  const std::vector<double> values = flipValues(image, reference, exposureEv, pixelsPerDegree);
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace malus::render
