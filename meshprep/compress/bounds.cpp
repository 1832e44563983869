#include "meshprep/compress/bounds.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/deviation.h"
#include "meshprep/compress/grid_rounding.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "meshes to compress";

void requireBound(const std::optional<double>& bound, std::string_view what) {
  if (bound && !(*bound > 0 && std::isfinite(*bound)))
    throw Error(kLocation, what, "a positive, finite number", fmt::to_string(*bound));
}

void requireBits(const std::optional<int>& bits, int low, int high, std::string_view what) {
  if (bits && (*bits < low || *bits > high))
    throw Error(kLocation, what, fmt::format("{} to {}", low, high), fmt::to_string(*bits));
}

DeviationLimits deviationLimits(const Bounds& bounds, double conversionError) {
  DeviationLimits limits;
  if (bounds.positionError) limits.position = *bounds.positionError - conversionError;
  limits.normalDegrees = bounds.normalErrorDegrees.value_or(kDefaultNormalErrorDegrees);
  limits.tiltDegrees = kDefaultTiltDegrees;
  limits.newDegenerate = false;
  return limits;
}

Grid enclosingGrid(std::span<const MeshView> meshes, int positionBits) {
  std::vector<glm::vec3> corners;
  for (const MeshView& mesh : meshes) {
    if (mesh.positions.empty()) continue;
    const Grid box = gridFor(mesh.positions, positionBits);  // throws if a position is not finite
    glm::vec3 high = box.origin;
    for (const glm::vec3& p : mesh.positions) high = glm::max(high, p);
    corners.insert(corners.end(), {box.origin, high});
  }
  return gridFor(corners, positionBits);
}

// Returns the smallest number of bits with which every mesh is within the limits.
int positionBits(std::span<const MeshView> meshes, Grid grid, int first, const DeviationLimits& limits) {
  if (meshes.empty()) return first;
  std::size_t failing = 0;  // tested first: the mesh that needed the last bit often needs the next
  for (grid.positionBits = first; grid.positionBits < kMaxPositionBits; ++grid.positionBits) {
    const auto fails = [&](std::size_t i) {
      return !positionsWithin(meshes[i], roundPositions(meshes[i].positions, grid), limits);
    };
    if (fails(failing)) continue;
    std::size_t i = 0;
    while (i < meshes.size() && (i == failing || !fails(i))) ++i;
    if (i == meshes.size()) break;
    failing = i;
  }
  return grid.positionBits;
}

int normalBits(const MeshView& mesh, int first, const DeviationLimits& limits) {
  int bits = first;
  while (bits < kMaxNormalBits && !normalsWithin(mesh, roundNormals(mesh.normals, bits), limits)) ++bits;
  return bits;
}

}  // namespace

Bits chooseBits(std::span<const MeshView> meshes, const Bounds& bounds, double conversionError) {
  requireBound(bounds.positionError, "position error out of range");
  requireBound(bounds.normalErrorDegrees, "normal error out of range");
  requireBits(bounds.positionBits, 1, kMaxPositionBits, "number of position bits out of range");
  requireBits(bounds.normalBits, kMinNormalBits, kMaxNormalBits, "number of normal bits out of range");
  const DeviationLimits limits = deviationLimits(bounds, conversionError);

  // Choose the grid, and its bits.
  Bits bits;
  const int firstPosition = bounds.positionError ? 1 : kFirstPositionBits;
  bits.grid = enclosingGrid(meshes, firstPosition);
  bits.grid.positionBits =
      bounds.positionBits ? *bounds.positionBits : positionBits(meshes, bits.grid, firstPosition, limits);

  // Choose the bits of each mesh's normals.
  const int firstNormal = bounds.normalErrorDegrees ? kMinNormalBits : kFirstNormalBits;
  for (const MeshView& mesh : meshes)
    bits.normalBits.push_back(bounds.normalBits ? *bounds.normalBits : normalBits(mesh, firstNormal, limits));
  return bits;
}

std::vector<std::string> checkBounds(const Deviation& deviation, const Settings& used, const Bounds& bounds,
                                     std::string_view where, double conversionError) {
  // Check the given bounds.
  const double moved = deviation.positionMax + conversionError;
  if (bounds.positionError && !(moved <= *bounds.positionError))
    throw Error(where, "position error exceeds the bound",
                fmt::format("at most {:g} m (--position-error)", *bounds.positionError),
                fmt::format("{:.3g} m with {} bits over {:.3g} m", moved, used.grid.positionBits,
                            static_cast<double>(used.grid.range)));
  if (bounds.normalErrorDegrees && !(deviation.normalMaxDegrees <= *bounds.normalErrorDegrees))
    throw Error(where, "normal error exceeds the bound",
                fmt::format("at most {:g} degrees (--normal-error)", *bounds.normalErrorDegrees),
                fmt::format("{:.3g} degrees with {} bits", deviation.normalMaxDegrees, used.normalBits));

  // Check the default bounds.
  std::vector<std::string> warnings;
  if (!bounds.normalErrorDegrees && deviation.normalMaxDegrees > kDefaultNormalErrorDegrees)
    warnings.push_back(fmt::format("{}: normal error {:.3g} degrees with {} bits exceeds {:g} degrees", where,
                                   deviation.normalMaxDegrees, used.normalBits, kDefaultNormalErrorDegrees));
  if (deviation.tiltMaxDegrees > kDefaultTiltDegrees)
    warnings.push_back(
        fmt::format("{}: face {} tilts by {:.3g} degrees with {} position bits, which exceeds {:g} degrees{}", where,
                    deviation.tiltFace, deviation.tiltMaxDegrees, used.grid.positionBits, kDefaultTiltDegrees,
                    deviation.flipped > 0 ? fmt::format("; {} faces flip", deviation.flipped) : ""));
  if (deviation.newDegenerate > 0)
    warnings.push_back(fmt::format("{}: {} faces lose their area with {} position bits, first face {}", where,
                                   deviation.newDegenerate, used.grid.positionBits, deviation.degenerateFace));
  return warnings;
}

}  // namespace malus::compress
