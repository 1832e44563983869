#include "meshprep/compress/bounds.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/deviation.h"
#include "meshprep/compress/grid_rounding.h"

namespace malus::compress {

namespace {

constexpr std::string_view kWhere = "meshes to compress";

void requireBound(const std::optional<double>& bound, std::string_view what) {
  if (bound && !(*bound > 0 && std::isfinite(*bound)))
    throw Error(kWhere, what, "over 0 and finite", fmt::to_string(*bound));
}

void requireBits(const std::optional<int>& bits, int low, int high, std::string_view what) {
  if (bits && (*bits < low || *bits > high))
    throw Error(kWhere, what, fmt::format("{} to {}", low, high), fmt::to_string(*bits));
}

DeviationLimits limitsOf(const Bounds& bounds, double movedBefore) {
  DeviationLimits limits;
  if (bounds.maxError) limits.position = *bounds.maxError - movedBefore;
  limits.normalDegrees = bounds.maxNormalErrorDegrees.value_or(kDefaultNormalErrorDegrees);
  limits.tiltDegrees = kDefaultTiltDegrees;
  limits.newDegenerate = false;
  return limits;
}

Grid gridAround(std::span<const MeshView> meshes, int positionBits) {
  std::vector<glm::vec3> corners;
  for (const MeshView& mesh : meshes) {
    if (mesh.positions.empty()) continue;
    const Grid box = gridFor(mesh.positions, positionBits);  // refuses what is not finite
    glm::vec3 high = box.origin;
    for (const glm::vec3& p : mesh.positions) high = glm::max(high, p);
    corners.insert(corners.end(), {box.origin, high});
  }
  return gridFor(corners, positionBits);
}

// The least bits that every mesh keeps the limits with.
int positionBits(std::span<const MeshView> meshes, Grid grid, int first, const DeviationLimits& limits) {
  if (meshes.empty()) return first;
  std::size_t failing = 0;  // asked first: the mesh that needed the last bit often needs the next
  for (grid.positionBits = first; grid.positionBits < kMaxPositionBits; ++grid.positionBits) {
    const auto fails = [&](std::size_t i) {
      return !positionsKeep(meshes[i], roundedPositions(meshes[i].positions, grid), limits);
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
  while (bits < kMaxNormalBits && !normalsKeep(mesh, roundedNormals(mesh.normals, bits), limits)) ++bits;
  return bits;
}

}  // namespace

Bits chooseBits(std::span<const MeshView> meshes, const Bounds& bounds, double movedBefore) {
  requireBound(bounds.maxError, "largest error of a position");
  requireBound(bounds.maxNormalErrorDegrees, "largest error of a normal");
  requireBits(bounds.positionBits, 1, kMaxPositionBits, "bits of a position");
  requireBits(bounds.normalBits, kMinNormalBits, kMaxNormalBits, "bits of a normal");
  const DeviationLimits limits = limitsOf(bounds, movedBefore);

  // Step 1: positions, all on one grid.
  Bits bits;
  const int firstPosition = bounds.maxError ? 1 : kFirstPositionBits;
  bits.grid = gridAround(meshes, firstPosition);
  bits.grid.positionBits =
      bounds.positionBits ? *bounds.positionBits : positionBits(meshes, bits.grid, firstPosition, limits);

  // Step 2: normals, mesh by mesh.
  const int firstNormal = bounds.maxNormalErrorDegrees ? kMinNormalBits : kFirstNormalBits;
  for (const MeshView& mesh : meshes)
    bits.normalBits.push_back(bounds.normalBits ? *bounds.normalBits : normalBits(mesh, firstNormal, limits));
  return bits;
}

std::vector<std::string> judge(const Deviation& deviation, const Settings& used, const Bounds& bounds,
                               std::string_view where, double movedBefore) {
  // Step 1: what was asked for.
  const double moved = deviation.positionMax + movedBefore;
  if (bounds.maxError && !(moved <= *bounds.maxError))
    throw Error(where, "positions are farther off than asked for", fmt::format("at most {:g} m", *bounds.maxError),
                fmt::format("{:.3g} m with {} bits over {:.3g} m", moved, used.grid.positionBits,
                            static_cast<double>(used.grid.range)));
  if (bounds.maxNormalErrorDegrees && !(deviation.normalMaxDegrees <= *bounds.maxNormalErrorDegrees))
    throw Error(where, "normals are farther off than asked for",
                fmt::format("at most {:g} degrees", *bounds.maxNormalErrorDegrees),
                fmt::format("{:.3g} degrees with {} bits", deviation.normalMaxDegrees, used.normalBits));

  // Step 2: what is wished for.
  std::vector<std::string> warnings;
  if (!bounds.maxNormalErrorDegrees && deviation.normalMaxDegrees > kDefaultNormalErrorDegrees)
    warnings.push_back(fmt::format("{}: normals are off by up to {:.3g} degrees, over {:g}, with {} bits", where,
                                   deviation.normalMaxDegrees, kDefaultNormalErrorDegrees, used.normalBits));
  if (deviation.tiltMaxDegrees > kDefaultTiltDegrees)
    warnings.push_back(
        fmt::format("{}: face {} is tilted by {:.3g} degrees, over {:g}, with positions of {} bits{}", where,
                    deviation.tiltFace, deviation.tiltMaxDegrees, kDefaultTiltDegrees, used.grid.positionBits,
                    deviation.flipped > 0 ? fmt::format("; {} faces turn over", deviation.flipped) : ""));
  if (deviation.newDegenerate > 0)
    warnings.push_back(fmt::format("{}: {} faces lose their area with positions of {} bits, the first is face {}",
                                   where, deviation.newDegenerate, used.grid.positionBits, deviation.degenerateFace));
  return warnings;
}

}  // namespace malus::compress
