// Choice of the numbers of bits: one for the positions of all meshes, which share a grid so that seams do not crack,
// and one for the normals of each mesh.
//
// The numbers are raised until every mesh is within its bounds: distance of a vertex from its source, angle of a normal
// from its source, tilt of a face; no face may lose its area or flip. chooseBits predicts the decoded values
// (grid_rounding.h); checkBounds checks the values that were decoded.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Bounds that apply unless others are given. A mesh that exceeds them with the most bits gets a warning.
inline constexpr double kDefaultNormalErrorDegrees = 0.05;
inline constexpr double kDefaultTiltDegrees = 0.1;

// First numbers of bits to try. If a bound is given, all numbers are tried.
inline constexpr int kFirstPositionBits = 20;
inline constexpr int kFirstNormalBits = 12;

struct Bounds {
  std::optional<double> positionError;       // largest distance of a vertex from its source, metres, > 0
  std::optional<double> normalErrorDegrees;  // largest angle of a normal from its source, degrees, > 0
  std::optional<int> positionBits;           // exact number, 1 to kMaxPositionBits; positionError is still checked
  std::optional<int> normalBits;             // exact number, kMinNormalBits to kMaxNormalBits
};

struct Bits {
  Grid grid;                    // shared by all meshes
  std::vector<int> normalBits;  // per mesh
};

// Returns the smallest grid that encloses all meshes, and the smallest numbers of bits within the bounds, or the
// largest numbers if none is. conversionError: distance in metres by which the conversion to float already moved
// positions; it counts towards positionError. Throws Error: bits or bounds out of range, a position that is not finite,
// an extent above the range of float.
Bits chooseBits(std::span<const MeshView> meshes, const Bounds& bounds, double conversionError = 0);

// Checks an encoded mesh. Returns a warning for each exceeded default bound, with the value and the number of bits.
// Throws Error if a bound that was given is exceeded. Both texts begin with `where`.
std::vector<std::string> checkBounds(const Deviation& deviation, const Settings& used, const Bounds& bounds,
                                     std::string_view where, double conversionError = 0);

}  // namespace malus::compress
