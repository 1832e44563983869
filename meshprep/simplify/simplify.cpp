#include "meshprep/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalDeviationT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/halfedge/half_edge_mesh.h"
#include "meshprep/simplify/keep_creases.h"
#include "meshprep/simplify/seams.h"
#include "meshprep/simplify/surface.h"
#include "meshprep/simplify/surface_deviation.h"

namespace malus::prep {

namespace {

using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using ModHausdorff = OpenMesh::Decimater::ModHausdorffT<HalfEdgeMesh>;
using ModNormalDeviation = OpenMesh::Decimater::ModNormalDeviationT<HalfEdgeMesh>;
using ModNormalFlipping = OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>;
using ModQuadric = OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>;

// The module for distances checks vertices only, so its tolerance is lowered until the measured deviation is in bounds.
constexpr int kAttempts = 6;
constexpr double kAimBelow = 0.9;      // of the bound
constexpr double kMinReduction = 0.1;  // of the tolerance, by one attempt
constexpr double kMaxReduction = 0.85;
constexpr double kMaxFlipDegrees = 60;         // of a triangle, by one collapse
constexpr double kMeasureTolerance = 0.02;     // of the bound
constexpr double kMinMeasureTolerance = 1e-9;  // of the diagonal
constexpr double kCosineTolerance = 1e-6;      // as for crease normals

double diagonal(const Mesh& mesh) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) low = glm::min(low, mesh.positions[t[k]]), high = glm::max(high, mesh.positions[t[k]]);
  return glm::distance(low, high);
}

// Locks vertices that must stay and marks lines as features.
class Marks {
 public:
  Marks(HalfEdgeMesh& halfEdges, const Mesh& mesh, const SimplifyLines& lines)
      : halfEdges_(halfEdges), mesh_(mesh), lines_(lines), linesAt_(mesh.positions.size(), 0) {
    if (lines.creaseDegrees) minCosine_ = std::cos(glm::radians(*lines.creaseDegrees)) - kCosineTolerance;
  }

  void apply() {
    for (const OpenMesh::EdgeHandle e : halfEdges_.edges()) markEdge(e);
    const std::vector<std::uint32_t> position = positionIds(mesh_);
    for (std::uint32_t i = 0; i < position.size(); ++i) {
      const OpenMesh::VertexHandle v(static_cast<int>(i));
      if (position[i] != i) {
        lock(v);
        lock(OpenMesh::VertexHandle(static_cast<int>(position[i])));
      }
      if (linesAt_[i] != 0) halfEdges_.status(v).set_feature(true);
      if (linesAt_[i] != 0 && linesAt_[i] != 2) lock(v);  // an end or a crossing of lines
    }
  }

 private:
  void lock(OpenMesh::VertexHandle v) { halfEdges_.status(v).set_locked(true); }

  bool isCrease(std::size_t a, std::size_t b, OpenMesh::FaceHandle fa, OpenMesh::FaceHandle fb) const {
    if (lines_.smoothingGroups &&
        (mesh_.smoothingGroups[a] != mesh_.smoothingGroups[b] || mesh_.smoothingGroups[a] == 0))
      return true;
    return lines_.creaseDegrees && (halfEdges_.normal(fa) | halfEdges_.normal(fb)) < minCosine_;
  }

  void markEdge(OpenMesh::EdgeHandle e) {
    const OpenMesh::HalfedgeHandle h = halfEdges_.halfedge_handle(e, 0);
    const OpenMesh::VertexHandle from = halfEdges_.from_vertex_handle(h), to = halfEdges_.to_vertex_handle(h);
    const OpenMesh::FaceHandle fa = halfEdges_.face_handle(h);
    const OpenMesh::FaceHandle fb = halfEdges_.face_handle(halfEdges_.opposite_halfedge_handle(h));
    if (!fa.is_valid() || !fb.is_valid()) return lock(from), lock(to);
    const auto a = static_cast<std::size_t>(fa.idx()), b = static_cast<std::size_t>(fb.idx());
    if (!lines_.materials.empty() && lines_.materials[a] != lines_.materials[b]) lock(from), lock(to);
    if (!isCrease(a, b, fa, fb)) return;
    halfEdges_.status(e).set_feature(true);
    for (const OpenMesh::VertexHandle v : {from, to}) {
      std::uint8_t& count = linesAt_[static_cast<std::size_t>(v.idx())];
      count = static_cast<std::uint8_t>(std::min(count + 1, 3));
    }
  }

  HalfEdgeMesh& halfEdges_;
  const Mesh& mesh_;
  const SimplifyLines& lines_;
  std::vector<std::uint8_t> linesAt_;  // features at each vertex, at most 3
  double minCosine_ = -1;
};

// Collapses edges until the budget is reached or no legal collapse is left. `factor` scales the tolerances.
Mesh decimate(const Mesh& mesh, const HalfEdgeMesh& marked, double scale, const SimplifyBounds& bounds,
              const SimplifyLines& lines, double factor) {
  HalfEdgeMesh halfEdges = marked;
  Decimater decimater(halfEdges);
  OpenMesh::Decimater::ModHandleT<ModQuadric> quadric;
  OpenMesh::Decimater::ModHandleT<ModNormalFlipping> flipping;
  OpenMesh::Decimater::ModHandleT<KeepCreases> creases;
  OpenMesh::Decimater::ModHandleT<ModNormalDeviation> normals;
  OpenMesh::Decimater::ModHandleT<ModHausdorff> distance;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();  // sets the order only
  decimater.add(flipping);
  decimater.module(flipping).set_max_normal_deviation(kMaxFlipDegrees);
  decimater.add(creases);
  if (lines.creaseDegrees)
    decimater.module(creases).setMinCosine(std::cos(glm::radians(*lines.creaseDegrees)) - kCosineTolerance);
  if (bounds.maxNormalErrorDegrees) {
    decimater.add(normals);
    decimater.module(normals).set_normal_deviation(2 * factor * *bounds.maxNormalErrorDegrees);  // of a cone
  }
  if (bounds.maxError) {
    decimater.add(distance);
    decimater.module(distance).set_tolerance(factor * *bounds.maxError * scale);
  }
  decimater.initialize();
  decimater.decimate_to_faces(0, static_cast<std::size_t>(bounds.triangles.value_or(0)));
  return fromHalfEdges(halfEdges, mesh);
}

struct Deviation {
  double metres = 0, normalDegrees = 0;
  double imageMetres = 0;  // by which the image moves on the surface
};

// seams: of a mesh with texture attributes, or nullptr.
Deviation measure(const Mesh& before, const Surface& surfaceBefore, const Mesh& after, const SimplifyBounds& bounds,
                  const Seams* seams, double size) {
  const Surface surfaceAfter(after);
  const double tolerance = bounds.maxError ? kMeasureTolerance * *bounds.maxError : kMinMeasureTolerance * size;
  Deviation deviation;
  deviation.metres =
      std::max(maxDistance(before, surfaceAfter, tolerance), maxDistance(after, surfaceBefore, tolerance));
  deviation.normalDegrees = maxNormalDeviation(before, surfaceAfter, deviation.metres);
  if (seams != nullptr && bounds.maxError)
    deviation.imageMetres = seams->imageDeviation(before, after, deviation.metres + kMinMeasureTolerance * size);
  return deviation;
}

// The largest ratio of a deviation to its bound.
double excessOver(const SimplifyBounds& bounds, const Deviation& deviation) {
  double excess = 0;
  if (bounds.maxError) excess = std::max(deviation.metres, deviation.imageMetres) / *bounds.maxError;
  if (bounds.maxNormalErrorDegrees) excess = std::max(excess, deviation.normalDegrees / *bounds.maxNormalErrorDegrees);
  return excess;
}

// Simplifies a mesh without corner attributes of textures. seams: as for measure().
Simplification simplifyCut(Mesh& mesh, const SimplifyBounds& bounds, const SimplifyLines& lines, const Seams* seams) {
  Simplification result;
  result.applied = true;
  result.trianglesBefore = result.trianglesAfter = mesh.triangles.size();
  if (bounds.triangles && *bounds.triangles >= mesh.triangles.size()) return result;

  // Convert to half-edges in the unit cube, because OpenMesh keeps priorities in float. A power of two is exact.
  const double size = diagonal(mesh);
  const double scale = std::exp2(-std::ceil(std::log2(size)));
  const glm::dvec3 origin = mesh.positions[mesh.triangles[0].x];
  Mesh unit = mesh;
  for (glm::dvec3& p : unit.positions) p = (p - origin) * scale;
  HalfEdgeMesh halfEdges = toHalfEdges(unit);
  halfEdges.request_face_normals();
  halfEdges.update_face_normals();
  Marks(halfEdges, unit, lines).apply();

  // Lower the tolerances until the measured deviation is in bounds.
  const Surface surface(mesh);
  double factor = 1;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Mesh simplified = decimate(mesh, halfEdges, scale, bounds, lines, factor);
    if (simplified.triangles.size() == mesh.triangles.size()) break;
    const Deviation deviation = measure(mesh, surface, simplified, bounds, seams, size);
    const double excess = excessOver(bounds, deviation);
    if (excess <= 1) {
      result.maxDeviation = deviation.metres;
      result.maxNormalDegrees = deviation.normalDegrees;
      result.trianglesAfter = simplified.triangles.size();
      mesh = std::move(simplified);
      break;
    }
    factor *= std::clamp(kAimBelow / excess, kMinReduction, kMaxReduction);
  }
  if (result.trianglesAfter == result.trianglesBefore)
    result.warnings.emplace_back(
        "the mesh is unchanged: no collapse keeps the bounds; raise --simplify-error or "
        "--simplify-normal");
  else if (bounds.triangles && result.trianglesAfter > *bounds.triangles)
    result.warnings.push_back(fmt::format(
        "{} triangles are left, expected {}: locked vertices and the other bounds allow no more collapses; raise "
        "--simplify-error, --simplify-normal or --crease",
        result.trianglesAfter, *bounds.triangles));
  return result;
}

}  // namespace

void checkSimplifyBounds(const SimplifyBounds& bounds) {
  if (bounds.maxError && !(*bounds.maxError > 0 && std::isfinite(*bounds.maxError)))
    throw Error("prep --simplify-error", "invalid bound", "a finite number of metres over 0",
                fmt::to_string(*bounds.maxError));
  if (bounds.triangles && *bounds.triangles == 0)
    throw Error("prep --simplify-triangles", "invalid number of triangles", "1 or more", "0");
  if (bounds.maxNormalErrorDegrees && !(*bounds.maxNormalErrorDegrees > 0 && *bounds.maxNormalErrorDegrees <= 180))
    throw Error("prep --simplify-normal", "invalid bound", "over 0 and up to 180 degrees",
                fmt::to_string(*bounds.maxNormalErrorDegrees));
}

Simplification simplify(Mesh& mesh, const SimplifyBounds& bounds, const SimplifyLines& lines) {
  checkSimplifyBounds(bounds);
  if (mesh.cornerTextures.empty()) return simplifyCut(mesh, bounds, lines, nullptr);
  Mesh cut = mesh;
  const Seams seams(cut);
  Simplification result = simplifyCut(cut, bounds, lines, &seams);
  if (result.trianglesAfter == result.trianglesBefore) return result;
  seams.join(cut);
  mesh = std::move(cut);
  return result;
}

}  // namespace malus::prep
