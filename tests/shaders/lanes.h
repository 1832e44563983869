// A SIMD type of two lanes for tests, and the shared files compiled on it. It supplies every operation of math.h
// itself. Nothing converts to bool or to a scalar, so that an `if`, a `?:` or a comparison on data in a shared file
// does not compile here.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/gtc/packing.hpp>

namespace malus::lanes {

struct Mask2 {
  bool lane[2];
  Mask2() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a condition that is the same in all lanes
  constexpr Mask2(bool both) : lane{both, both} {}
  constexpr Mask2(bool a, bool b) : lane{a, b} {}
};

// Bits; only the functions of lanes_math.h take them apart.
struct Word2 {
  std::uint32_t lane[2];
  Word2() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a constant that is the same in all lanes
  constexpr Word2(std::uint32_t both) : lane{both, both} {}
  constexpr Word2(std::uint32_t a, std::uint32_t b) : lane{a, b} {}
};

template <class S>
struct Lane2 {
  S lane[2];
  Lane2() = default;
  constexpr Lane2(S a, S b) : lane{a, b} {}
  constexpr explicit Lane2(double both) : lane{static_cast<S>(both), static_cast<S>(both)} {}
  constexpr explicit Lane2(std::uint32_t both) : lane{static_cast<S>(both), static_cast<S>(both)} {}
  constexpr explicit Lane2(int both) : lane{static_cast<S>(both), static_cast<S>(both)} {}
  friend Lane2 operator+(Lane2 a, Lane2 b) { return {a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]}; }
  friend Lane2 operator-(Lane2 a, Lane2 b) { return {a.lane[0] - b.lane[0], a.lane[1] - b.lane[1]}; }
  friend Lane2 operator*(Lane2 a, Lane2 b) { return {a.lane[0] * b.lane[0], a.lane[1] * b.lane[1]}; }
  friend Lane2 operator/(Lane2 a, Lane2 b) { return {a.lane[0] / b.lane[0], a.lane[1] / b.lane[1]}; }
};

template <class S>
struct Three {
  Lane2<S> x, y, z;
  friend Three operator+(Three a, Three b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Three operator-(Three a, Three b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Three operator*(Three a, Three b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Three operator*(Three a, Lane2<S> b) { return {a.x * b, a.y * b, a.z * b}; }
};

}  // namespace malus::lanes

#include "shaders/optics/language_begin.h"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"

namespace malus::lanes32 {
using scalar = float;
#include "tests/shaders/lanes_math.h"

#include "shaders/optics/all.h"

#include "lane_methods.h"
}  // namespace malus::lanes32

namespace malus::lanes64 {
using scalar = double;
#include "tests/shaders/lanes_math.h"

#include "shaders/optics/all.h"

#include "lane_methods.h"
}  // namespace malus::lanes64

#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"
