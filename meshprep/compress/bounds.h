// How many bits are enough: one number for the positions of all meshes, because they share a grid so that nothing
// cracks, and one for each mesh's normals.
//
// Bits are raised until every mesh keeps its bounds: distance of a vertex from its source, angle of a normal, tilt of a
// face, no face that loses its area, and none that turns over (which its tilt tells). Choosing goes by the quantizers'
// own arithmetic (grid_rounding.h); judging goes by what was decoded.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Kept where nothing else is asked for; what cannot keep them gets the most bits and a warning.
inline constexpr double kDefaultNormalErrorDegrees = 0.05;
inline constexpr double kDefaultTiltDegrees = 0.1;

// Where raising begins, unless a bound is asked for: then every number of bits is tried.
inline constexpr int kFirstPositionBits = 20;
inline constexpr int kFirstNormalBits = 12;

struct Bounds {
  std::optional<double> maxError;               // asked for: metres, over 0
  std::optional<double> maxNormalErrorDegrees;  // asked for: degrees, over 0
  std::optional<int> positionBits;              // just these, whatever they bring: 1 to kMaxPositionBits
  std::optional<int> normalBits;                // kMinNormalBits to kMaxNormalBits
};

struct Bits {
  Grid grid;                    // of all meshes
  std::vector<int> normalBits;  // one a mesh
};

// The grid is the smallest cube about all meshes. Where no number of bits keeps a bound, the most. Throws Error: bits
// or bounds out of range, a position that is not finite, an extent that a float does not hold.
// movedBefore: how far positions are already off, by rounding to float; it counts towards maxError.
Bits chooseBits(std::span<const MeshView> meshes, const Bounds& bounds, double movedBefore = 0);

// What a mesh that was encoded does not keep of the defaults, one line each: which face, how much, with which bits.
// Throws Error that begins with `where` for a bound that was asked for and is not kept, saying what was reached.
std::vector<std::string> judge(const Deviation& deviation, const Settings& used, const Bounds& bounds,
                               std::string_view where, double movedBefore = 0);

}  // namespace malus::compress
