// A way to render an image with less work: method, effects, depth and tolerance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace malus::render {

struct Combination {
  std::string method;
  std::vector<std::string> off;  // effects that are left out, by name
  std::uint32_t depth = 0;       // most specular interactions along a path
  double tolerance = 0;          // of iterative methods: share of a source's radiance that a path may lose
  double error = 0;              // expected relative RMS error (display_error.h), a bound: the sum of its parts
  double milliseconds = 0;       // expected time of the image that was measured
};

// Error and time of one choice alone: the method, an effect that is left out, a depth or a tolerance.
struct MeasuredChoice {
  enum class Kind { method, effect, depth, tolerance } kind = Kind::method;
  std::string name;         // of the method or the effect; of a tolerance its method
  std::uint32_t depth = 0;  // of a depth
  double tolerance = 0;     // of a tolerance
  double error = 0;         // against the complete image of the same renderer
  double milliseconds = 0;  // median of interleaved rounds
};

// Every choice, measured alone: each method with every effect, and by the complete recursive method each effect left
// out and each smaller depth.
struct Measurements {
  std::uint32_t depth = 0;  // of the complete image
  std::vector<MeasuredChoice> choices;
  std::size_t leftOut = 0;                    // choices that the time limit left unmeasured
  double precision = 0;                       // error of the complete image against the double-precision reference
  double fullPixels = 0, measuredPixels = 0;  // of the image, and of the small one whose times are measured
  const MeasuredChoice* find(MeasuredChoice::Kind kind, const std::string& name) const;
};

// Combinations worth considering, fastest first: for every method, tolerance and depth, effects are left out one after
// the other, greedily by time saved per error added. Errors of the parts add up; the shares of time multiply. A choice
// that saves less than 2 % of the time is not made. complete: the method whose times the effects and depths relate to.
std::vector<Combination> combinations(const Measurements& measurements, const std::string& complete);

}  // namespace malus::render
