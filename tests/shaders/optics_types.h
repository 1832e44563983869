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
#ifdef MALUS_EMULATED_PRECISION
#include "tests/shaders/emulated.h"
#endif
#include "tests/shaders/jones.h"

namespace malus::test {

// Every function of the optics that the tests call: X(space, name).
#define MALUS_OPTICS_FUNCTIONS(X, space) \
  X(space, make3)                        \
  X(space, splat3)                       \
  X(space, dot3)                         \
  X(space, cross3)                       \
  X(space, select3)                      \
  X(space, max3)                         \
  X(space, normalize3)                   \
  X(space, signNotZero)                  \
  X(space, square)                       \
  X(space, clampUnit)                    \
  X(space, powInteger)                   \
  X(space, refractionTerms)              \
  X(space, reflectanceFromTerms)         \
  X(space, transmittanceFromTerms)       \
  X(space, dielectricReflectance)        \
  X(space, dielectricTransmittance)      \
  X(space, conductorReflectance)         \
  X(space, schlickReflectance)           \
  X(space, cisTwoPi)                     \
  X(space, complexSqrtLower)             \
  X(space, thinFilm)                     \
  X(space, thinGlass)                    \
  X(space, partialThinGlass)             \
  X(space, coatOnDielectric)             \
  X(space, coatOnConductor)              \
  X(space, rayleighDegree)               \
  X(space, rayleighPhase)                \
  X(space, visibleFacets)                \
  X(space, facetNormal)                  \
  X(space, facetWeight)                  \
  X(space, mirrorDirection)              \
  X(space, refractedDirection)           \
  X(space, canonicalFrame)               \
  X(space, sDirection)                   \
  X(space, frameRotation)                \
  X(space, stokesUnpolarized)            \
  X(space, stokesAdd)                    \
  X(space, rotateStokes)                 \
  X(space, stokesInterface)              \
  X(space, lambertRadiance)              \
  X(space, phongLobe)                    \
  X(space, octahedralFromDirection)      \
  X(space, directionFromOctahedral)      \
  X(space, irradiancePolynomial)         \
  X(space, shadingNormal)                \
  X(space, hitPointError)                \
  X(space, intersectionError)            \
  X(space, insideTriangle)               \
  X(space, rayOrigin)                    \
  X(space, cameraDirection)              \
  X(space, cameraSampleDirection)        \
  X(space, trianglePoint)                \
  X(space, pointOnRay)                   \
  X(space, refractionTermsWith)          \
  X(space, conductorReflectanceWith)     \
  X(space, schlickReflectanceWith)       \
  X(space, filmResponse)                 \
  X(space, thinGlassFromTerms)           \
  X(space, refractedDirectionFromTerms)  \
  X(space, cameraFrameRotation)          \
  X(space, analysed)                     \
  X(space, rotateImportance)             \
  X(space, applyInterfaceTransposed)

// Types of a build whose structs are those of `space`.
#define MALUS_OPTICS_TYPES(space, label)                   \
  using real3 = malus::space::real3;                       \
  using Stokes = malus::space::Stokes;                     \
  using Reflectance = malus::space::Reflectance;           \
  using Transmittance = malus::space::Transmittance;       \
  using RefractionTerms = malus::space::RefractionTerms;   \
  using Film = malus::space::Film;                         \
  using FilmLayers = malus::space::FilmLayers;             \
  using ThinGlass = malus::space::ThinGlass;               \
  using ClearCoat = malus::space::ClearCoat;               \
  using Complex = malus::space::Complex;                   \
  using ImportanceVector = malus::space::ImportanceVector; \
  static constexpr const char* kName = label;

#define MALUS_FORWARD(space, name) static constexpr auto& name = malus::space::name;
// kRoundings: how many times the roundings of IEEE arithmetic are allowed.
#define MALUS_OPTICS(Name, space, scalar, label)   \
  struct Name {                                    \
    using real = scalar;                           \
    static constexpr real kPi = malus::space::kPi; \
    static constexpr int kRoundings = 1;           \
    MALUS_OPTICS_TYPES(space, label)               \
    MALUS_OPTICS_FUNCTIONS(MALUS_FORWARD, space)   \
  };
MALUS_OPTICS(F32, f32, float, "float")
MALUS_OPTICS(F64, f64, double, "double")

#ifdef MALUS_EMULATED_PRECISION
#define MALUS_EMULATED_CALL(space, name)                                                                               \
  static constexpr EmulatedCall<D, decltype(malus::f32::name), decltype(malus::emulated::name), malus::emulated::name> \
      name{};
// The optics with the precision that the Vulkan specification guarantees, called with floats.
template <class D, const char* kLabel>
struct EmulatedOptics {
  using real = float;
  static constexpr real kPi = f32::kPi;
  static constexpr int kRoundings = kEmulatedRoundings;
  static void enter() { D::enter(); }
  MALUS_OPTICS_TYPES(f32, kLabel)
  MALUS_OPTICS_FUNCTIONS(MALUS_EMULATED_CALL, emulated)
};
inline constexpr char kRandomLabel[] = "random", kOtherLabel[] = "other_random", kLargestLabel[] = "largest",
                      kSmallestLabel[] = "smallest";
using EmulatedRandom = EmulatedOptics<EmulatedDevice<emulation::Choice::random, 1>, kRandomLabel>;
using EmulatedOther = EmulatedOptics<EmulatedDevice<emulation::Choice::random, 2>, kOtherLabel>;
using EmulatedLargest = EmulatedOptics<EmulatedDevice<emulation::Choice::largest, 3>, kLargestLabel>;
using EmulatedSmallest = EmulatedOptics<EmulatedDevice<emulation::Choice::smallest, 4>, kSmallestLabel>;
using OpticsTypes = ::testing::Types<EmulatedRandom, EmulatedOther, EmulatedLargest, EmulatedSmallest>;
#else
using OpticsTypes = ::testing::Types<F32, F64>;
#endif
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
// Abbreviations of a typed test: O the build, kEps the unit of its errors (its spacing at 1, times the factor by which
// its operations may be less exact than IEEE's), kExact the unit where IEEE arithmetic is exact, R(x) its rounding of
// x.
#define MALUS_TYPES                                                                            \
  using O = TypeParam;                                                                         \
  using real [[maybe_unused]] = typename O::real;                                              \
  using real3 [[maybe_unused]] = typename O::real3;                                            \
  [[maybe_unused]] constexpr real kEps = O::kRoundings * std::numeric_limits<real>::epsilon(); \
  [[maybe_unused]] constexpr real kExact = O::kRoundings == 1 ? real(0) : kEps;                \
  [[maybe_unused]] const auto R = [](oracle::Real x) { return static_cast<real>(x); }
#define EXPECT_CLOSE(a, b, allowed) \
  EXPECT_NEAR(static_cast<double>(a), static_cast<double>(b), static_cast<double>(allowed))

template <class V>
void expectClose3(const V& got, const V& want, double allowed) {
  EXPECT_CLOSE(got.x, want.x, allowed);
  EXPECT_CLOSE(got.y, want.y, allowed);
  EXPECT_CLOSE(got.z, want.z, allowed);
}

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
// Johnson and Christy 1972 and 1974 at 630, 532, 465 nm, as in bake/presets.yml.
inline constexpr Metal kMetals[] = {
    {"gold", {0.1884, 0.5439, 1.3319}, {3.4034, 2.2309, 1.8693}},
    {"silver", {0.0569, 0.054, 0.0469}, {4.2543, 3.429, 2.8028}},
    {"copper", {0.2753, 1.1159, 1.2469}, {3.3726, 2.5956, 2.4562}},
    {"iron", {2.8924, 2.8954, 2.646}, {3.0655, 2.9179, 2.805}},
    {"chromium", {3.1452, 3.0343, 2.456}, {3.3124, 3.33, 3.21}},
};

}  // namespace malus::test
