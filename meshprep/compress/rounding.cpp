#include "meshprep/compress/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/deviation.h"
#include "meshprep/compress/grid_rounding.h"
#include "meshprep/compress/shared_positions.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "meshes to compress";
constexpr int kFloatBits = 24;                // significant bits of a float
constexpr double kSharedTolerance = 0x1p-46;  // of the largest coordinate: 64 rounding errors of double

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double power(int exponent) { return std::ldexp(1.0, exponent); }

class Rounder {
 public:
  Rounder(std::span<const MeshView> meshes, const Bounds& bounds, Precision precision)
      : meshes_(meshes), bounds_(bounds), precision_(precision), limits_(deviationLimits(bounds)) {
    if (precision == Precision::floats) limits_.leastCross = kLeastFloatCross;
  }

  std::vector<RoundedMesh> run(const Inspection& inspect) {
    requireFinite();
    chooseFirstSteps();
    for (std::uint32_t g = 0; g < meshes_.size(); ++g)
      if (!groups_[g].empty()) roundGroup(g);
    keepBounds();
    while (inspect.find) {
      const std::vector<std::size_t> found = inspect.find(rounded_);
      if (found.empty()) break;
      if (!refineAll(found)) {
        inspect.refuse(rounded_);
        break;
      }
      keepBounds();
    }
    chooseNormalBits();
    return std::move(rounded_);
  }

 private:
  void requireFinite() const {
    for (const MeshView& mesh : meshes_)
      for (const glm::dvec3& p : mesh.positions)
        if (!isFinite(p)) throw Error(kLocation, "a position is not finite");
  }

  void chooseFirstSteps() {
    // Find the bounding boxes of the meshes and of the scene.
    std::vector<glm::dvec3> corners;
    for (const MeshView& mesh : meshes_) {
      extents_.push_back(mesh.positions.empty() ? Extent{} : findExtent(mesh.positions));
      if (!mesh.positions.empty()) corners.insert(corners.end(), {extents_.back().low, extents_.back().high});
    }
    const Extent scene = corners.empty() ? Extent{} : findExtent(corners);
    const int sceneStep = corners.empty() ? 0 : stepExponent(scene, kFirstPositionBits);

    // Choose the first and the finest step of each mesh.
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      int first = 0, finest = 0;
      if (!meshes_[i].positions.empty()) {
        finest = stepExponent(extents_[i], bounds_.positionBits.value_or(kMaxPositionBits));
        first = bounds_.positionBits    ? finest
                : bounds_.positionError ? stepExponent(extents_[i], 1)
                                        : std::min(sceneStep - std::ilogb(meshes_[i].magnification.largest),
                                                   stepExponent(extents_[i], kFirstMeshBits));
      }
      finest_.push_back(finest);
      steps_.push_back(std::max(first, finest));
    }

    // Group the meshes that share positions.
    shared_ = findSharedPositions(meshes_, (corners.empty() ? 0 : scene.farthest()) * kSharedTolerance);
    groups_.resize(meshes_.size());
    for (std::uint32_t i = 0; i < meshes_.size(); ++i) groups_[shared_.groupOf[i]].push_back(i);
    rounded_.resize(meshes_.size());
    withinBounds_.assign(meshes_.size(), 0);
  }

  // Rounds the meshes of a group with their current steps.
  void roundGroup(std::uint32_t group) {
    for (bool fits = false; !fits;) {
      const glm::dvec3 origin = precision_ == Precision::floats ? groupOrigin(groups_[group]) : glm::dvec3(0);
      fits = true;
      for (const std::uint32_t i : groups_[group]) {
        roundMesh(i, origin);
        withinBounds_[i] = 0;
        if (rounded_[i].grid.positionBits <= kMaxPositionBits) continue;
        // Positions that are rounded to the coarser step of another mesh are beyond the last bit.
        ++steps_[i];
        finest_[i] = steps_[i];
        fits = false;
      }
    }
  }

  void roundMesh(std::uint32_t i, const glm::dvec3& origin) {
    const MeshView& mesh = meshes_[i];
    RoundedMesh& rounded = rounded_[i];
    rounded.origin = origin;
    rounded.positions = roundPositions(mesh.positions, power(steps_[i]));
    for (const auto& [vertex, position] : shared_.vertices[i]) {
      int coarsest = steps_[i];
      for (const std::uint32_t user : shared_.users[position]) coarsest = std::max(coarsest, steps_[user]);
      rounded.positions[vertex] = roundToStep(mesh.positions[vertex], power(coarsest));
    }
    if (precision_ == Precision::floats)
      for (glm::dvec3& p : rounded.positions) p = origin + roundToFloat(p - origin);
    rounded.grid = gridWithStep(rounded.positions, power(steps_[i]));
  }

  // Returns 0 if floats relative to 0 can represent all points of the grids. Else the median of the vertices along each
  // axis, where the details of a mesh are, rounded so that it is a float and a point of all grids.
  glm::dvec3 groupOrigin(const std::vector<std::uint32_t>& group) const {
    int finest = std::numeric_limits<int>::max(), coarsest = std::numeric_limits<int>::min();
    double farthest = 0;
    for (const std::uint32_t i : group) {
      if (meshes_[i].positions.empty()) continue;
      finest = std::min(finest, steps_[i]);
      coarsest = std::max(coarsest, steps_[i]);
      farthest = std::max(farthest, extents_[i].farthest());
    }
    // Transforms would round positions far from the mesh, so that the origin of a mesh with instances is near it.
    const bool isPlaced =
        std::any_of(group.begin(), group.end(), [&](std::uint32_t i) { return meshes_[i].magnification.isPlaced; });
    if (farthest == 0 || (!isPlaced && farthest <= power(finest + kFloatBits))) return glm::dvec3(0);
    glm::dvec3 median(0);
    std::vector<double> coordinates;
    for (int axis = 0; axis < 3; ++axis) {
      coordinates.clear();
      for (const std::uint32_t i : group)
        for (const glm::dvec3& p : meshes_[i].positions) coordinates.push_back(p[axis]);
      const auto middle = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
      std::nth_element(coordinates.begin(), middle, coordinates.end());
      median[axis] = *middle;
    }
    const double largest = std::max({std::abs(median.x), std::abs(median.y), std::abs(median.z)});
    if (largest == 0) return median;
    return roundToStep(median, power(std::max(coarsest, std::ilogb(largest) - (kFloatBits - 2))));
  }

  // Refines the group of a mesh by one bit of this mesh, or of the meshes that share its positions. Returns false if
  // all have their finest steps.
  bool refine(std::uint32_t mesh) {
    const std::uint32_t group = shared_.groupOf[mesh];
    std::optional<int> most;  // largest step that remains
    if (steps_[mesh] > finest_[mesh]) most = steps_[mesh] - 1;
    for (const std::uint32_t i : groups_[group])
      if (!most && steps_[i] > finest_[i]) most = std::max(most.value_or(steps_[i] - 1), steps_[i] - 1);
    if (!most) return false;
    for (const std::uint32_t i : groups_[group]) steps_[i] = std::max(finest_[i], std::min(steps_[i], *most));
    return true;
  }

  // Refines the groups of these meshes. Returns false if none can be refined.
  bool refineAll(const std::vector<std::size_t>& meshes) {
    std::vector<char> done(meshes_.size(), 0);
    bool refined = false;
    for (const std::size_t i : meshes) {
      const std::uint32_t group = shared_.groupOf[i];
      if (done[group] != 0 || !refine(static_cast<std::uint32_t>(i))) continue;
      done[group] = 1;
      refined = true;
      roundGroup(group);
    }
    return refined;
  }

  // Refines until every mesh is within the bounds or has its finest step.
  void keepBounds() {
    std::vector<std::size_t> failing;
    do {
      failing.clear();
      for (std::size_t i = 0; i < meshes_.size(); ++i) {
        if (withinBounds_[i] != 0) continue;
        if (!positionsWithin(meshes_[i], rounded_[i].positions, limitsBefore(meshes_[i].magnification, limits_)))
          failing.push_back(i);
        withinBounds_[i] = 1;  // or as good as it gets, unless it is refined
      }
    } while (refineAll(failing));
  }

  // Rounds the normals in blocks until one exceeds the limit.
  bool areNormalsWithin(const MeshView& mesh, int bits) const {
    constexpr std::size_t kBlock = 1u << 16u;
    const DeviationLimits limits = limitsBefore(mesh.magnification, limits_);
    for (std::size_t first = 0; first < mesh.normals.size(); first += kBlock) {
      const auto block = mesh.normals.subspan(first, std::min(kBlock, mesh.normals.size() - first));
      if (!normalsWithin(MeshView({}, block, {}), roundNormals(block, bits), limits)) return false;
    }
    return true;
  }

  void chooseNormalBits() {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      int bits = bounds_.normalErrorDegrees ? kMinNormalBits : kFirstNormalBits;
      while (bits < kMaxNormalBits && !areNormalsWithin(meshes_[i], bits)) ++bits;
      rounded_[i].normalBits = bounds_.normalBits.value_or(bits);
    }
  }

  std::span<const MeshView> meshes_;
  const Bounds& bounds_;
  Precision precision_;
  DeviationLimits limits_;
  std::vector<Extent> extents_;      // per mesh
  std::vector<int> steps_, finest_;  // exponents, per mesh
  SharedPositions shared_;
  std::vector<std::vector<std::uint32_t>> groups_;  // meshes, at the index of the first one
  std::vector<char> withinBounds_;                  // 1: inspected since the last rounding
  std::vector<RoundedMesh> rounded_;
};

}  // namespace

std::vector<RoundedMesh> roundMeshes(std::span<const MeshView> meshes, const Bounds& bounds, Precision precision,
                                     const Inspection& inspect) {
  requireValid(bounds);
  return Rounder(meshes, bounds, precision).run(inspect);
}

}  // namespace malus::compress
