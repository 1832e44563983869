#include "meshprep/compress/texture_rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr double kMostInteger = (1u << kMaxCoordinateBits) - 1;
constexpr float kLengthTolerance = 1e-3f;

double maxComponent(const glm::dvec2& v) { return std::max(v.x, v.y); }

// Returns the coarsest grid whose rounding errors are at most maxError.
CoordinateGrid coordinateGrid(std::span<const glm::vec2> coordinates, double maxError) {
  glm::dvec2 low(coordinates.front()), high = low;
  for (const glm::vec2& uv : coordinates) low = glm::min(low, glm::dvec2(uv)), high = glm::max(high, glm::dvec2(uv));
  CoordinateGrid grid;
  const auto lowest = [&] { return glm::round(low / grid.step); };
  const auto range = [&] { return maxComponent(glm::round(high / grid.step) - lowest()); };
  grid.step = std::exp2(std::floor(std::log2(2 * maxError)));
  while (range() > kMostInteger) grid.step *= 2;
  grid.origin = lowest() * grid.step;
  return grid;
}

glm::dvec2 folded(const glm::dvec2& p) {
  return (1.0 - glm::abs(glm::dvec2(p.y, p.x))) * glm::dvec2(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
}

glm::ivec2 encodeTangent(const glm::vec4& tangent, int bits) {
  const glm::dvec3 t(tangent);
  const double sum = std::abs(t.x) + std::abs(t.y) + std::abs(t.z);
  glm::dvec2 p = glm::dvec2(t) / sum;
  if (t.z < 0) p = folded(p);
  const double steps = (1u << static_cast<unsigned>(bits)) - 2;
  const glm::ivec2 integers(glm::round((p * 0.5 + 0.5) * steps));
  return {integers.x, 2 * integers.y + (tangent.w < 0 ? 1 : 0)};
}

double angleDegrees(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 u(a), v(b);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180 / std::numbers::pi;
}

double largestAngle(std::span<const glm::vec4> tangents, std::span<const glm::ivec2> integers, int bits) {
  double largest = 0;
  for (std::size_t i = 0; i < tangents.size(); ++i)
    largest = std::max(largest, angleDegrees(glm::vec3(tangents[i]), glm::vec3(decodedTangent(integers[i], bits))));
  return largest;
}

void checkSource(const TextureView& source, std::string_view where) {
  for (const auto& set : source.coordinates)
    for (const glm::vec2& uv : set)
      if (!(maxComponent(glm::abs(glm::dvec2(uv))) <= kMaxTextureCoordinate) || std::isnan(uv.x) || std::isnan(uv.y))
        throw Error(where, "texture coordinate is out of range", fmt::format("-{0:g} to {0:g}", kMaxTextureCoordinate),
                    fmt::format("({}, {})", uv.x, uv.y));
  for (const glm::vec4& t : source.tangents)
    if (!(std::abs(glm::length(glm::vec3(t)) - 1) <= kLengthTolerance) || std::abs(t.w) != 1)
      throw Error(where, "invalid tangent", "a unit vector, and a sign of 1 or -1",
                  fmt::format("({}, {}, {}, {})", t.x, t.y, t.z, t.w));
}

bool isPowerOfTwo(double value) {
  int exponent = 0;
  return value > 0 && std::isfinite(value) && std::frexp(value, &exponent) == 0.5;
}

}  // namespace

RoundedTextures roundTextures(const TextureView& source, double texels, double uvErrorTexels, double tangentDegrees,
                              std::string_view where) {
  if (!(uvErrorTexels > 0 && std::isfinite(uvErrorTexels)))
    throw Error(where, "error of texture coordinates out of range", "a positive number of texels (--max-uv-error)",
                fmt::to_string(uvErrorTexels));
  checkSource(source, where);
  RoundedTextures result;
  for (std::size_t set = 0; set < source.coordinates.size(); ++set) {
    if (source.coordinates[set].empty()) continue;
    CoordinateGrid& grid = result.grids.sets[set];
    grid = coordinateGrid(source.coordinates[set], uvErrorTexels / texels);
    for (const glm::vec2& uv : source.coordinates[set])
      result.coordinates[set].emplace_back(glm::round((glm::dvec2(uv) - grid.origin) / grid.step));
  }
  if (source.tangents.empty()) return result;
  int& bits = result.grids.tangentBits;
  for (bits = kMinTangentBits; bits <= kMaxTangentBits; ++bits) {
    result.tangents.clear();
    for (const glm::vec4& t : source.tangents) result.tangents.push_back(encodeTangent(t, bits));
    if (bits == kMaxTangentBits || largestAngle(source.tangents, result.tangents, bits) <= tangentDegrees) break;
  }
  return result;
}

glm::vec2 decodedCoordinate(const CoordinateGrid& grid, const glm::ivec2& integer) {
  return grid.origin + grid.step * glm::dvec2(integer);
}

glm::vec4 decodedTangent(const glm::ivec2& integers, int bits) {
  const double steps = (1u << static_cast<unsigned>(bits)) - 2;
  const glm::dvec2 p = glm::dvec2(integers.x, integers.y / 2) / steps * 2.0 - 1.0;
  const double z = 1 - std::abs(p.x) - std::abs(p.y);
  const glm::dvec2 xy = z < 0 ? folded(p) : p;
  return {glm::vec3(glm::normalize(glm::dvec3(xy, z))), integers.y % 2 == 0 ? 1.0f : -1.0f};
}

TextureDeviation measureTextures(const TextureView& source, const RoundedTextures& rounded, double texels) {
  TextureDeviation deviation;
  for (std::size_t set = 0; set < source.coordinates.size(); ++set)
    for (std::size_t i = 0; i < source.coordinates[set].size(); ++i) {
      const glm::dvec2 decoded(decodedCoordinate(rounded.grids.sets[set], rounded.coordinates[set][i]));
      const double error = maxComponent(glm::abs(decoded - glm::dvec2(source.coordinates[set][i])));
      deviation.uvTexels = std::max(deviation.uvTexels, error * texels);
    }
  deviation.tangentDegrees = largestAngle(source.tangents, rounded.tangents, rounded.grids.tangentBits);
  return deviation;
}

void requireValid(const TextureGrids& grids, std::string_view where) {
  for (const CoordinateGrid& grid : grids.sets) {
    if (grid.step == 0) continue;
    const glm::dvec2 steps = grid.origin / grid.step;
    if (!isPowerOfTwo(grid.step) || steps != glm::round(steps) ||
        !(maxComponent(glm::abs(grid.origin)) <= kMaxTextureCoordinate + grid.step))
      throw Error(
          where, "invalid grid of texture coordinates",
          fmt::format("a step that is a power of two, and an origin of whole steps up to {:g}", kMaxTextureCoordinate),
          fmt::format("({:.17g}, {:.17g}) with steps of {:g}", grid.origin.x, grid.origin.y, grid.step));
  }
  if (grids.tangentBits != 0 && (grids.tangentBits < kMinTangentBits || grids.tangentBits > kMaxTangentBits))
    throw Error(where, "number of tangent bits out of range",
                fmt::format("0, or {} to {}", kMinTangentBits, kMaxTangentBits), fmt::to_string(grids.tangentBits));
}

}  // namespace malus::compress
