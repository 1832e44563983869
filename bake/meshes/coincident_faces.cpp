#include "bake/meshes/coincident_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "bake/meshes/body_contacts.h"
#include "bake/meshes/face_rounding.h"
#include "bake/pack/instances.h"
#include "meshprep/clean/box_pairs.h"

namespace malus::bake {

namespace {

constexpr double kLeastOverlap = 1e-6;          // share of the smaller face
constexpr std::size_t kMostPlaced = 16;         // instances whose faces are kept
constexpr std::uint64_t kMostPairs = 50000000;  // a second of tests

Corners corners(const pack::Mesh& mesh, std::uint32_t face) {
  const glm::uvec3& t = mesh.triangles[face];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

glm::dvec3 areaVector(const Corners& t) { return glm::cross(t[1] - t[0], t[2] - t[0]) * 0.5; }

// The part of a convex polygon on the inner side of the edge from p to q of a face with normal n.
std::vector<glm::dvec3> clip(const std::vector<glm::dvec3>& polygon, const glm::dvec3& p, const glm::dvec3& q,
                             const glm::dvec3& n) {
  const glm::dvec3 inward = glm::cross(n, q - p);
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(a - p, inward), db = glm::dot(b - p, inward);
    if (da >= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

// A mesh, and its origin as the pack will have it, about.
struct PlacedMesh {
  const pack::Mesh& mesh;
  prep::Box box;
  glm::dvec3 origin() const { return (box.low + box.high) * 0.5; }
};

// Distance within which rays that leave one of the faces may start beyond the other.
double startDistance(const Corners& a, const glm::dvec3& originA, const Corners& b, const glm::dvec3& originB) {
  return std::max(largestStart(a, originA), largestStart(b, originB));
}

// Whether b overlaps a, seen along the normal of a, and is within the start distance of the plane of a there.
bool coincide(const Corners& a, const glm::dvec3& originA, const Corners& b, const glm::dvec3& originB) {
  const glm::dvec3 va = areaVector(a), vb = areaVector(b);
  const double areaA = glm::length(va), areaB = glm::length(vb);
  if (!(areaA > 0 && areaB > 0) || std::abs(glm::dot(va, vb)) < 0.999 * areaA * areaB) return false;
  const glm::dvec3 n = va / areaA;
  std::vector<glm::dvec3> part(b.begin(), b.end());
  for (std::size_t i = 0; i < 3 && !part.empty(); ++i) part = clip(part, a[i], a[(i + 1) % 3], n);
  glm::dvec3 overlap(0);
  for (std::size_t i = 2; i < part.size(); ++i) overlap += glm::cross(part[i - 1] - part[0], part[i] - part[0]) * 0.5;
  if (glm::length(overlap) <= kLeastOverlap * std::min(areaA, areaB)) return false;
  const double distance = startDistance(a, originA, b, originB);
  return std::all_of(part.begin(), part.end(),
                     [&](const glm::dvec3& p) { return std::abs(glm::dot(p - a[0], n)) <= distance; });
}

// Returns the box with a margin of the start distances of all faces in the box of their mesh.
prep::Box widened(const prep::Box& box, const PlacedMesh& placed) {
  const double margin = boundStart(placed.box.low, placed.box.high, placed.origin());
  return {box.low - margin, box.high + margin};
}

// The faces of a mesh that reach into a region, and their boxes.
struct Faces {
  std::vector<std::uint32_t> index;
  std::vector<prep::Box> box;
};
Faces facesIn(const PlacedMesh& placed, const prep::Box& region) {
  Faces faces;
  for (std::uint32_t f = 0; f < placed.mesh.triangles.size(); ++f) {
    const Corners t = corners(placed.mesh, f);
    const prep::Box box = widened({glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))}, placed);
    if (!overlap(box, region)) continue;
    faces.index.push_back(f);
    faces.box.push_back(box);
  }
  return faces;
}

struct Found {
  std::size_t count = 0;
  std::pair<std::uint32_t, std::uint32_t> first;  // faces of the glass and of the other mesh
  bool isComplete = true;
};

Found findCoincident(const PlacedMesh& glass, const PlacedMesh& other) {
  const prep::Box first = widened(glass.box, glass), second = widened(other.box, other);
  const prep::Box region{glm::max(first.low, second.low), glm::min(first.high, second.high)};
  const Faces a = facesIn(glass, region), b = facesIn(other, region);
  Found found;
  std::mutex mutex;
  found.isComplete =
      prep::forOverlappingBoxes(a.box, b.box, kMostPairs, [&](std::uint32_t i, std::uint32_t j) -> std::uint32_t {
        const std::pair faces(a.index[i], b.index[j]);
        if (coincide(corners(glass.mesh, faces.first), glass.origin(), corners(other.mesh, faces.second),
                     other.origin())) {
          const std::lock_guard lock(mutex);
          if (found.count++ == 0 || faces < found.first) found.first = faces;
        }
        return 1;
      });
  return found;
}

}  // namespace

std::vector<std::string> inspectCoincidentFaces(const pack::Scene& scene) {
  std::vector<std::string> warnings;
  const std::vector<pack::Placement> placements = pack::placements(scene);
  const auto isGlass = [&](std::size_t i) {
    return pack::hasInside(scene.materials[placements[i].mesh->material].kind);
  };
  std::vector<prep::Box> boxes, wide;
  for (const pack::Box& box : pack::placementBoxes(scene)) {
    boxes.push_back({box.low, box.high});
    wide.push_back(widened(boxes.back(), {*placements[boxes.size() - 1].mesh, boxes.back()}));
  }
  // Instances are placed when they are compared.
  std::map<std::size_t, pack::Mesh> placed;
  const auto meshAt = [&](std::size_t i) -> const pack::Mesh& {
    if (placements[i].instance == nullptr) return *placements[i].mesh;
    const auto found = placed.find(i);
    return found != placed.end() ? found->second
                                 : placed.emplace(i, pack::placedMesh(scene, *placements[i].instance)).first->second;
  };
  for (const auto& [first, second] : overlappingPairs(wide)) {
    if (isGlass(first) == isGlass(second)) continue;
    const std::size_t glassIndex = isGlass(first) ? first : second, otherIndex = isGlass(first) ? second : first;
    if (placed.size() > kMostPlaced) placed.clear();
    const PlacedMesh glass{meshAt(glassIndex), boxes[glassIndex]}, other{meshAt(otherIndex), boxes[otherIndex]};
    const Found found = findCoincident(glass, other);
    if (!found.isComplete) {
      warnings.push_back(fmt::format(
          "glass: too many overlapping faces to find where meshes '{}' and '{}' coincide; cut long thin faces",
          glass.mesh.name, other.mesh.name));
    } else if (found.count > 0) {
      const Corners face = corners(glass.mesh, found.first.first);
      const glm::dvec3 at = (face[0] + face[1] + face[2]) / 3.0 + scene.origin;
      const double apart =
          2 * startDistance(face, glass.origin(), corners(other.mesh, found.first.second), other.origin());
      warnings.push_back(fmt::format(
          "glass: meshes '{}' and '{}' coincide in {} {}, first faces {} and {} near ({:.6g}, {:.6g}, {:.6g}); either "
          "may be hit there: move them at least {:.1g} m apart, or cut the covered faces from one mesh",
          glass.mesh.name, other.mesh.name, found.count, found.count == 1 ? "pair of faces" : "pairs of faces",
          found.first.first, found.first.second, at.x, at.y, at.z, apart));
    }
  }
  return warnings;
}

}  // namespace malus::bake
