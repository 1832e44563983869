// The two builds of the optics as types, for typed tests, and shared parts of the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "shaders/optics/optics.h"
#include "tests/shaders/jones.h"

namespace malus::test {

#define MALUS_FORWARD(space, name) static constexpr auto& name = malus::space::name;
#define MALUS_OPTICS(Name, space, scalar, label)           \
  struct Name {                                            \
    using real = scalar;                                   \
    using real3 = malus::space::real3;                     \
    using Stokes = malus::space::Stokes;                   \
    using Reflectance = malus::space::Reflectance;         \
    using Transmittance = malus::space::Transmittance;     \
    using RefractionTerms = malus::space::RefractionTerms; \
    using Film = malus::space::Film;                       \
    using Complex = malus::space::Complex;                 \
    static constexpr real kPi = malus::space::kPi;         \
    static constexpr const char* kName = label;            \
    MALUS_FORWARD(space, make3)                            \
    MALUS_FORWARD(space, splat3)                           \
    MALUS_FORWARD(space, dot3)                             \
    MALUS_FORWARD(space, cross3)                           \
    MALUS_FORWARD(space, select3)                          \
    MALUS_FORWARD(space, max3)                             \
    MALUS_FORWARD(space, normalize3)                       \
    MALUS_FORWARD(space, signNotZero)                      \
    MALUS_FORWARD(space, square)                           \
    MALUS_FORWARD(space, clampUnit)                        \
    MALUS_FORWARD(space, powInteger)                       \
    MALUS_FORWARD(space, refractionTerms)                  \
    MALUS_FORWARD(space, dielectricReflectance)            \
    MALUS_FORWARD(space, dielectricTransmittance)          \
    MALUS_FORWARD(space, conductorReflectance)             \
    MALUS_FORWARD(space, schlickReflectance)               \
    MALUS_FORWARD(space, cisTwoPi)                         \
    MALUS_FORWARD(space, complexSqrtLower)                 \
    MALUS_FORWARD(space, thinFilm)                         \
    MALUS_FORWARD(space, thinGlass)                        \
    MALUS_FORWARD(space, rayleighDegree)                   \
    MALUS_FORWARD(space, rayleighPhase)                    \
    MALUS_FORWARD(space, facetNormal)                      \
    MALUS_FORWARD(space, facetWeight)                      \
    MALUS_FORWARD(space, mirrorDirection)                  \
    MALUS_FORWARD(space, refractedDirection)               \
    MALUS_FORWARD(space, canonicalFrame)                   \
    MALUS_FORWARD(space, sDirection)                       \
    MALUS_FORWARD(space, frameRotation)                    \
    MALUS_FORWARD(space, stokesUnpolarized)                \
    MALUS_FORWARD(space, stokesAdd)                        \
    MALUS_FORWARD(space, rotateStokes)                     \
    MALUS_FORWARD(space, stokesInterface)                  \
    MALUS_FORWARD(space, lambertRadiance)                  \
    MALUS_FORWARD(space, phongLobe)                        \
    MALUS_FORWARD(space, octahedralFromDirection)          \
    MALUS_FORWARD(space, directionFromOctahedral)          \
    MALUS_FORWARD(space, irradiancePolynomial)             \
    MALUS_FORWARD(space, shadingNormal)                    \
    MALUS_FORWARD(space, hitPointError)                    \
    MALUS_FORWARD(space, intersectionError)                \
    MALUS_FORWARD(space, insideTriangle)                   \
    MALUS_FORWARD(space, rayOrigin)                        \
    MALUS_FORWARD(space, cameraDirection)                  \
    MALUS_FORWARD(space, cameraFrameRotation)              \
    MALUS_FORWARD(space, analysed)                         \
  };
MALUS_OPTICS(F32, f32, float, "float")
MALUS_OPTICS(F64, f64, double, "double")

using OpticsTypes = ::testing::Types<F32, F64>;
struct OpticsNames {
  template <class T>
  static std::string GetName(int) {
    return T::kName;
  }
};

// A suite of typed tests needs its own class.
#define MALUS_OPTICS_SUITE(Name)          \
  template <class T>                      \
  class Name : public ::testing::Test {}; \
  TYPED_TEST_SUITE(Name, OpticsTypes, OpticsNames)
// Abbreviations of a typed test: O the build, kEps its spacing at 1, R(x) its rounding of x.
#define MALUS_TYPES                                                            \
  using O = TypeParam;                                                         \
  using real [[maybe_unused]] = typename O::real;                              \
  using real3 [[maybe_unused]] = typename O::real3;                            \
  [[maybe_unused]] constexpr real kEps = std::numeric_limits<real>::epsilon(); \
  [[maybe_unused]] const auto R = [](oracle::Real x) { return static_cast<real>(x); }
#define EXPECT_CLOSE(a, b, allowed) \
  EXPECT_NEAR(static_cast<double>(a), static_cast<double>(b), static_cast<double>(allowed))

// Largest of the errors given to it; recorded as a property of the test, for reports.
class Worst {
 public:
  Worst(std::string name, double unit) : name_(std::move(name)), unit_(unit) {}
  Worst(const Worst&) = delete;
  ~Worst() { ::testing::Test::RecordProperty(name_, std::to_string(worst_)); }
  void add(oracle::Real error) {
    const double size = static_cast<double>(std::abs(error)) / unit_;
    worst_ = std::isnan(size) ? std::numeric_limits<double>::infinity() : std::max(worst_, size);
  }
  double value() const { return worst_; }

 private:
  std::string name_;
  double unit_;
  double worst_ = 0;
};

// The same draws everywhere: the engine is fixed by the standard, its distributions are not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + (b - a) * unit(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  oracle::Vec direction() {
    const double z = between(-1, 1), phi = between(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return oracle::unit({r * std::cos(phi), r * std::sin(phi), z});
  }

 private:
  std::mt19937_64 engine_;
};

template <class O>
typename O::real3 toReal3(const oracle::Vec& v) {
  using real = typename O::real;
  return O::make3(static_cast<real>(v[0]), static_cast<real>(v[1]), static_cast<real>(v[2]));
}
template <class V>
oracle::Vec toVec(const V& v) {
  return {v.x, v.y, v.z};
}

struct Metal {
  const char* name;
  double n[3];
  double k[3];
};
// Johnson and Christy 1972 and 1974 at 630, 532, 465 nm, as in bake/materials.json.
inline constexpr Metal kMetals[] = {
    {"gold", {0.1884, 0.5439, 1.3319}, {3.4034, 2.2309, 1.8693}},
    {"silver", {0.0569, 0.054, 0.0469}, {4.2543, 3.429, 2.8028}},
    {"copper", {0.2753, 1.1159, 1.2469}, {3.3726, 2.5956, 2.4562}},
    {"iron", {2.8924, 2.8954, 2.646}, {3.0655, 2.9179, 2.805}},
    {"chromium", {3.1452, 3.0343, 2.456}, {3.3124, 3.33, 3.21}},
};

}  // namespace malus::test
