#include "bake/effects/mutual_visibility.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/pack/instances.h"

namespace malus::bake {

namespace {

bool isInterface(const pack::Scene& scene, const pack::Mesh& mesh) {
  return pack::isInterface(scene.materials[mesh.material].kind);
}

// Whether every edge of every interface has a face on both sides; corners at the same position count as one.
bool allClosed(const pack::Scene& scene) {
  for (const pack::Mesh& mesh : scene.meshes) {
    if (!isInterface(scene, mesh)) continue;
    std::map<std::array<double, 3>, int> positionIds;
    const auto positionId = [&](std::uint32_t corner) {
      const glm::dvec3& p = mesh.positions[corner];
      return positionIds.emplace(std::array<double, 3>{p.x, p.y, p.z}, static_cast<int>(positionIds.size()))
          .first->second;
    };
    std::map<std::pair<int, int>, int> edges;
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const int from = positionId(t[i]), to = positionId(t[(i + 1) % 3]);
        ++edges[{from, to}];
        --edges[{to, from}];
      }
    for (const auto& [edge, balance] : edges)
      if (balance != 0) return false;
  }
  return true;
}

}  // namespace

double flatness(const pack::Scene& scene) {
  const pack::Box box = pack::sceneBox(scene);
  const glm::dvec3 extent = box.high - box.low, far = glm::max(glm::abs(box.low), glm::abs(box.high));
  return 2e-6 * std::max({0.0, extent.x, extent.y, extent.z}) + 2.5e-7 * std::max({0.0, far.x, far.y, far.z});
}

bool interfacesMutuallyVisible(const pack::Scene& scene) {
  // Step 1: the faces and corners of interfaces.
  std::vector<glm::dvec3> corners;
  struct Face {
    glm::dvec3 point, normal;
  };
  std::vector<Face> faces;
  constexpr std::size_t kMostTests = 20'000'000;
  for (const pack::Placement& placement : pack::placements(scene)) {
    const pack::Mesh& mesh = *placement.mesh;
    if (!isInterface(scene, mesh)) continue;
    if (pack::transmits(scene.materials[mesh.material].kind)) return true;
    corners.reserve(corners.size() + mesh.positions.size());
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
    for (std::uint32_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      corners.emplace_back(placement.point(i));
    }
    const double side = placement.isMirrored() ? -1 : 1;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 p0 = placement.point(t.x),
                       n = glm::cross(placement.point(t.y) - p0, placement.point(t.z) - p0) * side;
      if (glm::length(n) > 0) faces.push_back({p0, glm::normalize(n)});
      if (faces.size() * corners.size() > kMostTests) return true;
    }
  }

  // Step 2: whether a corner is in front of a face.
  if (faces.empty()) return true;
  const double tolerance = flatness(scene);
  bool before = false, behind = false;
  for (const Face& face : faces)
    for (const glm::dvec3& corner : corners) {
      const double height = glm::dot(corner - face.point, face.normal);
      before = before || height > tolerance;
      behind = behind || height < -tolerance;
    }
  if (before) return true;
  // Convex. A flat mirror has no inside; light reaches the inside of a body from a camera in it, and that of a shell
  // through its open sides.
  // The rays of an orthographic camera start all over its image.
  const bool cameraInside =
      scene.camera.isOrthographic() || std::all_of(faces.begin(), faces.end(), [&](const Face& face) {
        return glm::dot(scene.camera.position - face.point, face.normal) <= tolerance;
      });
  return behind && (cameraInside || !allClosed(scene));
}

}  // namespace malus::bake
