// A float with the precision that the Vulkan specification guarantees to shaders and no more. Source: Vulkan 1.3,
// appendix "Vulkan Environment for SPIR-V", Precision and Operation of SPIR-V Instructions:
//
//   + - * and conversions   correctly rounded: either of the two nearest floats, the exact one where there is one
//   /                       2.5 ulp for a divisor of size 2^-126 to 2^126
//   sqrt                    as 1 / inversesqrt, which has 2 ulp
//   exp(x)                  3 + 2 |x| ulp
//   log(x)                  3 ulp; inside [0.5, 2] an absolute error of 2^-21
//   every operation         may flush denormal operands and results to 0
//   a * b + c               may be one operation (contraction)
//
// Which of the allowed results an operation returns is chosen by a Device: at random, or always the largest or the
// smallest. Further rearrangement, which the specification allows and does not bound, is not emulated.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

namespace malus::emulation {

enum class Choice { ieee, random, largest, smallest };  // ieee: to nearest, nothing flushed or contracted

// Next float above or below x.
inline float neighbour(float x, bool up) {
  if (x == 0) return up ? std::numeric_limits<float>::denorm_min() : -std::numeric_limits<float>::denorm_min();
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + ((x > 0) == up ? 1u : ~0u));
}

// Unit in the last place of a float at x, as the specification defines it: at a power of two, the smaller spacing.
inline double unitInLastPlace(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(std::abs(x), &exponent);  // in [0.5, 1)
  return std::ldexp(1.0, std::max(mantissa == 0.5 ? exponent - 1 : exponent, -125) - 24);
}

class Device {
 public:
  void choose(Choice choice, std::uint64_t seed) {
    if (choice_ == choice && seed_ == seed) return;
    choice_ = choice;
    seed_ = seed;
    engine_.seed(seed);
    bits_ = 0;
  }
  Choice choice() const { return choice_; }

  bool coin() {
    if (bits_ <= 1) bits_ = engine_() | (std::uint64_t(1) << 63);  // the highest set bit marks the end
    const bool result = bits_ & 1;
    bits_ >>= 1;
    return result;
  }
  // Whether a product and a sum are contracted.
  bool contracts() { return choice_ != Choice::ieee && coin(); }

  float flush(float x) {
    if (choice_ == Choice::ieee || !(std::abs(x) < std::numeric_limits<float>::min()) || x == 0) return x;
    return choice_ != Choice::random || coin() ? std::copysign(0.0f, x) : x;
  }
  // Correctly rounded.
  float round(double exact) {
    const float nearest = static_cast<float>(exact);
    if (choice_ == Choice::ieee || std::isnan(exact)) return nearest;
    if (nearest == exact) return flush(nearest);
    const float other = neighbour(nearest, nearest < exact);
    return flush(pick(std::min(nearest, other), std::max(nearest, other)));
  }
  // Within an absolute error.
  float within(double exact, double error) {
    if (choice_ == Choice::ieee || exact == 0 || !std::isfinite(exact)) return static_cast<float>(exact);
    float low = static_cast<float>(exact - error), high = static_cast<float>(exact + error);
    if (low < exact - error) low = neighbour(low, true);
    if (high > exact + error) high = neighbour(high, false);
    if (choice_ == Choice::random && coin()) {  // else one of the ends
      const float inside = static_cast<float>(exact + error * (static_cast<double>(engine_() >> 11) * 0x1p-52 - 1));
      return flush(std::min(std::max(inside, low), high));
    }
    return flush(pick(low, high));
  }
  float withinUlps(double exact, double ulps) {
    return exact == 0 || !std::isfinite(exact) ? static_cast<float>(exact)
                                               : within(exact, ulps * unitInLastPlace(exact));
  }
  template <class T>
  T pick(T low, T high) {
    return choice_ == Choice::largest || (choice_ == Choice::random && coin()) ? high : low;
  }

 private:
  Choice choice_ = Choice::ieee;
  std::uint64_t seed_ = 0;
  std::mt19937_64 engine_;
  std::uint64_t bits_ = 0;
};
inline Device device;  // of the calling test; tests have one thread

// A product remembers its factors, because a sum that follows it may be contracted, also in a later statement.
struct Float {
  float value;
  float a;
  float b;
  bool product;

  Float() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr explicit Float(T x) : value(static_cast<float>(x)), a(0), b(0), product(false) {}
  explicit operator int() const { return static_cast<int>(value); }

  friend Float operator-(Float x) {
    x.value = -x.value;
    x.a = -x.a;
    return x;
  }
  friend Float operator+(Float x, Float y) {
    if (x.product && device.contracts()) return fused(x, y);
    if (y.product && device.contracts()) return fused(y, x);
    return Float(device.round(double(device.flush(x.value)) + double(device.flush(y.value))));
  }
  friend Float operator-(Float x, Float y) { return x + -y; }
  friend Float operator*(Float x, Float y) {
    Float r;
    r.a = device.flush(x.value);
    r.b = device.flush(y.value);
    r.value = device.round(double(r.a) * double(r.b));
    r.product = true;
    return r;
  }
  friend Float operator/(Float x, Float y) {
    const double a = device.flush(x.value), b = device.flush(y.value);
    // No precision is guaranteed for larger divisors: their reciprocal may be flushed.
    if (device.choice() != Choice::ieee && std::abs(b) > 0x1p126 && device.pick(true, false)) return Float(0 * (a / b));
    return Float(device.withinUlps(a / b, 2.5));
  }
  friend bool operator<(Float x, Float y) { return device.flush(x.value) < device.flush(y.value); }
  friend bool operator>(Float x, Float y) { return y < x; }
  friend bool operator<=(Float x, Float y) { return device.flush(x.value) <= device.flush(y.value); }
  friend bool operator==(Float x, Float y) { return device.flush(x.value) == device.flush(y.value); }

 private:
  static Float fused(Float p, Float x) {
    return Float(device.round(double(p.a) * double(p.b) + double(device.flush(x.value))));
  }
};

struct Three {
  Float x, y, z;
  friend Three operator+(Three a, Three b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Three operator-(Three a, Three b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Three operator*(Three a, Three b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Three operator*(Three a, Float b) { return {a.x * b, a.y * b, a.z * b}; }
};

inline float squareRoot(float given) {
  const float x = device.flush(given);
  if (device.choice() == Choice::ieee || !(x > 0) || std::isinf(x)) return std::sqrt(x);
  return device.withinUlps(1 / double(device.withinUlps(1 / std::sqrt(double(x)), 2)), 2.5);
}
inline float exponential(float given) {
  const float x = device.flush(given);
  return device.withinUlps(std::exp(double(x)), 3 + 2 * std::abs(double(x)));
}
inline float logarithm(float given) {
  const float x = device.flush(given);
  const double exact = std::log(double(x));
  if (x < 0.5f || x > 2.0f) return device.withinUlps(exact, 3);
  // The logarithm of 1 has the error too.
  return device.choice() == Choice::ieee ? static_cast<float>(exact)
                                         : device.within(exact == 0 ? 0x1p-60 : exact, 0x1.fffp-22);
}

// Bits of a half: either of the two nearest, denormals possibly flushed.
inline std::uint32_t packHalf(float given) {
  const float x = device.flush(given);
  const std::uint16_t nearest = glm::packHalf1x16(x);
  const float back = glm::unpackHalf1x16(nearest);
  if (device.choice() == Choice::ieee || !(std::abs(x) < 65504.0f) || std::isnan(x)) return nearest;
  std::uint16_t bits = nearest;
  if (back != x) {
    const bool isLarger = std::abs(back) > std::abs(x);  // bits grow with the size
    const auto smaller = static_cast<std::uint16_t>(isLarger ? nearest - 1 : nearest);
    bits = device.pick(smaller, static_cast<std::uint16_t>(smaller + 1));
  }
  const bool isDenormal = (bits & 0x7c00u) == 0 && (bits & 0x3ffu) != 0;
  return isDenormal && device.pick(false, true) ? bits & 0x8000u : bits;
}
inline float unpackHalf(std::uint32_t word) {
  const float x = glm::unpackHalf1x16(static_cast<std::uint16_t>(word));
  const bool isDenormal = x != 0 && std::abs(x) < 0x1p-14f;
  return device.choice() != Choice::ieee && isDenormal && device.pick(true, false) ? std::copysign(0.0f, x) : x;
}
// Fractions of 32767: the product is correctly rounded, and a tie is rounded up or down.
inline std::uint32_t packFraction(float given) {
  if (device.choice() == Choice::ieee) return glm::packSnorm1x16(given);
  const double scaled = device.round(double(std::min(std::max(device.flush(given), -1.0f), 1.0f)) * 32767.0);
  const double low = std::floor(scaled), off = scaled - low;
  const double whole = off == 0.5 ? device.pick(low, low + 1) : off < 0.5 ? low : low + 1;
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(whole));
}
inline float unpackFraction(std::uint32_t word) {
  if (device.choice() == Choice::ieee) return glm::unpackSnorm1x16(static_cast<std::uint16_t>(word));
  const double whole = static_cast<std::int16_t>(static_cast<std::uint16_t>(word));
  return std::min(std::max(device.withinUlps(whole / 32767.0, 2.5), -1.0f), 1.0f);
}

}  // namespace malus::emulation
