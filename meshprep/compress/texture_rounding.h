// Rounding of texture coordinates and tangents to integers, with the choice of steps and bits by bounds.
//
// A set of coordinates has a grid as positions have (draco_mesh.h): origin + step * integer, with a step that is a
// power of two. Errors are counted in texels of the largest image that a mesh has: the larger of the errors of u and v,
// times the longer side of the image. Every rounded coordinate is a float, because its source is one.
//
// Tangents are octahedral: (x, y, z) / (|x| + |y| + |z|), with the lower half folded outward, on a square of
// 2^bits - 2 steps, whose middle and corners are the axes. Source: Q. Meyer, J. Suessmuth, G. Sussner, M. Stamminger,
// G. Greiner, "On floating-point normal vectors", EGSR 2010.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace malus::compress {

// Error of coordinates without a bound, and side of the image in texels if it is not known.
inline constexpr double kDefaultUvErrorTexels = 1.0 / 16;
inline constexpr std::uint32_t kDefaultTexels = 4096;

// Largest texture coordinate, in repeats of the image; beyond it floats resolve less than 1/16 of one.
inline constexpr double kMaxTextureCoordinate = 1e6;
inline constexpr int kMinTangentBits = 4;
inline constexpr int kMaxTangentBits = 16;
inline constexpr int kMaxCoordinateBits = 30;  // as kMaxPositionBits

struct CoordinateGrid {
  glm::dvec2 origin{0};  // multiple of the step
  double step = 0;       // power of two, in repeats of the image; 0: the mesh does not have this set
  friend bool operator==(const CoordinateGrid&, const CoordinateGrid&) = default;
};

// Numbers that give the integers of a mesh their meaning.
struct TextureGrids {
  std::array<CoordinateGrid, 2> sets;
  int tangentBits = 0;  // of each coordinate; 0: no tangents
  bool any() const { return sets[0].step > 0 || sets[1].step > 0 || tangentBits > 0; }
};

// Texture attributes of a mesh, one per vertex, or empty.
struct TextureView {
  std::array<std::span<const glm::vec2>, 2> coordinates;
  std::span<const glm::vec4> tangents;
};

struct RoundedTextures {
  TextureGrids grids;
  std::array<std::vector<glm::ivec2>, 2> coordinates;
  std::vector<glm::ivec2> tangents;  // y is twice the coordinate, plus 1 if the bitangent's sign is -1
};

struct TextureDeviation {
  double uvTexels = 0;        // largest error of a coordinate
  double tangentDegrees = 0;  // largest angle of a tangent from its source
};

// Rounds with the coarsest steps that keep the errors below uvErrorTexels, and the fewest bits that keep tangents
// within tangentDegrees. texels: longer side of the image. If 30 bits do not suffice for the range of the coordinates,
// the step is coarser; the caller checks the deviation. Throws Error (begins with `where`): a bound that is not
// positive, values that are not finite or out of range.
RoundedTextures roundTextures(const TextureView& source, double texels, double uvErrorTexels, double tangentDegrees,
                              std::string_view where);

// Decode integers.
glm::vec2 decodedCoordinate(const CoordinateGrid& grid, const glm::ivec2& integer);
glm::vec4 decodedTangent(const glm::ivec2& integers, int bits);

// Largest deviation of the rounded attributes from their source.
TextureDeviation measureTextures(const TextureView& source, const RoundedTextures& rounded, double texels);

// Throws Error (begins with `where`) unless steps are 0 or powers of two, origins multiples of them in the accepted
// range, and bits in range.
void requireValid(const TextureGrids& grids, std::string_view where);

}  // namespace malus::compress
