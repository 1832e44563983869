// Bounds of the deviation of an encoded mesh from its source. rounding.h chooses grids and numbers of bits by them;
// checkBounds checks the values that were decoded.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/compress/deviation.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Bounds that apply unless others are given. The grid becomes finer until every face keeps the tilt. With the most bits
// that is every face of a height above steps / tan(tilt) = 573 steps; lower ones are counted.
inline constexpr double kDefaultNormalErrorDegrees = 0.05;
inline constexpr double kDefaultTiltDegrees = 0.1;

struct Bounds {
  std::optional<double> positionError;       // largest distance of a vertex from its source, metres, > 0
  std::optional<double> normalErrorDegrees;  // largest angle of a normal from its source, degrees, > 0
  std::optional<double> uvErrorTexels;       // largest error of a texture coordinate, texels, > 0
  std::optional<int> positionBits;           // exact number, 1 to kMaxPositionBits; positionError is still checked
  std::optional<int> normalBits;             // exact number, kMinNormalBits to kMaxNormalBits
};

// Throws Error: bits or bounds out of range.
void requireValid(const Bounds& bounds);

// Limits of positions, normals and faces that the bounds demand.
DeviationLimits deviationLimits(const Bounds& bounds);

// Limits that a mesh must keep, so that it keeps `limits` at all of its places.
DeviationLimits limitsBefore(const Magnification& magnification, DeviationLimits limits);

// Bounds on the deviation of a mesh at all of its places, from that of the mesh. Areas are those of the mesh.
Deviation deviationAfter(const Magnification& magnification, Deviation deviation);

// Checks an encoded mesh. glass: light is refracted at its faces. Returns a warning for each exceeded default bound,
// with the value and the number of bits. Throws Error if a bound that was given is exceeded or a face is upside down,
// and for glass if a face is tilted by more than the default or lost its area. Texts begin with `where`.
std::vector<std::string> checkBounds(const Deviation& deviation, const Settings& used, const Bounds& bounds, bool glass,
                                     std::string_view where);

// Rounds the attributes of textures of a mesh by the bounds. texels: longer side of the largest image of the mesh.
RoundedTextures roundTextures(const TextureView& source, double texels, const Bounds& bounds, std::string_view where);

// Checks them as checkBounds() does.
std::vector<std::string> checkTextures(const TextureDeviation& deviation, const TextureGrids& used,
                                       const Bounds& bounds, std::string_view where);

}  // namespace malus::compress
