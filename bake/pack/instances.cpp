#include "bake/pack/instances.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "meshprep/compress/grid_rounding.h"

namespace malus::pack {

void Box::add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
void Box::add(const Box& box) {
  if (!box.isEmpty()) add(box.low), add(box.high);
}

Box findBox(std::span<const glm::dvec3> positions) {
  Box box;
  for (const glm::dvec3& p : positions) box.add(p);
  return box;
}

double farthestCoordinate(const Box& box) {
  if (box.isEmpty()) return 0;
  const glm::dvec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
  return std::max({far.x, far.y, far.z});
}

double Stretch::condition() const {
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

// Square roots of the eigenvalues of the product of the transposed map and the map. Source: O. K. Smith, "Eigenvalues
// of a symmetric 3 x 3 matrix", Communications of the ACM 4(4), 1961.
Stretch measureStretch(const glm::dmat3& linear) {
  double scale = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) scale = std::max(scale, std::abs(linear[column][row]));
  if (!(scale > 0)) return {0, 0};
  const glm::dmat3 map = linear * (1 / scale), product = glm::transpose(map) * map;
  const double q = (product[0][0] + product[1][1] + product[2][2]) / 3;
  double squares = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) {
      const double x = product[column][row] - (column == row ? q : 0);
      squares += x * x;
    }
  const double p = std::sqrt(squares / 6);
  if (p <= 1e-14 * q) return {scale * std::sqrt(q), scale * std::sqrt(q)};
  const glm::dmat3 centred = (product - glm::dmat3(q)) * (1 / p);
  const double angle = std::acos(std::clamp(glm::determinant(centred) / 2, -1.0, 1.0)) / 3;
  const double largest = q + 2 * p * std::cos(angle), smallest = q + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3);
  return {scale * std::sqrt(std::max(smallest, 0.0)), scale * std::sqrt(largest)};
}

bool isMirrored(const glm::dmat3& linear) { return glm::dot(linear[0], glm::cross(linear[1], linear[2])) < 0; }

glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

Box placedBox(const Box& box, const Instance& instance) {
  Box result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.add(
        placedPoint(instance, {(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                               (corner & 4) != 0 ? box.high.z : box.low.z}));
  return result;
}

Mesh placedMesh(const Scene& scene, const Instance& instance) {
  Mesh mesh = scene.meshes[instance.mesh];
  mesh.name = instance.name;
  mesh.origin = compress::roundToFloat(placedPoint(instance, mesh.origin));
  for (glm::dvec3& p : mesh.positions) p = mesh.origin + compress::roundToFloat(placedPoint(instance, p) - mesh.origin);
  const bool mirrored = isMirrored(instance.linear);
  const glm::dmat3 normalMatrix = cofactors(instance.linear) * (mirrored ? -1.0 : 1.0);
  for (glm::vec3& n : mesh.normals) n = glm::vec3(glm::normalize(normalMatrix * glm::dvec3(n)));
  for (glm::vec4& t : mesh.tangents)
    t = glm::vec4(glm::vec3(glm::normalize(instance.linear * glm::dvec3(t))), mirrored ? -t.w : t.w);
  if (mirrored)
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

Scene withoutInstances(const Scene& scene) {
  Scene result = scene;
  result.instances.clear();
  for (const Instance& instance : scene.instances) result.meshes.push_back(placedMesh(scene, instance));
  return result;
}

std::vector<Placement> placements(const Scene& scene) {
  std::vector<Placement> result;
  result.reserve(scene.meshes.size() + scene.instances.size());
  for (const Mesh& mesh : scene.meshes) result.push_back({&mesh, nullptr});
  for (const Instance& instance : scene.instances) result.push_back({&scene.meshes[instance.mesh], &instance});
  return result;
}

std::vector<Box> placementBoxes(const Scene& scene) {
  std::vector<Box> boxes;
  boxes.reserve(scene.meshes.size() + scene.instances.size());
  for (const Mesh& mesh : scene.meshes) boxes.push_back(findBox(mesh.positions));
  for (const Instance& instance : scene.instances) boxes.push_back(placedBox(boxes[instance.mesh], instance));
  return boxes;
}

Box sceneBox(const Scene& scene) {
  Box all;
  for (const Box& box : placementBoxes(scene)) all.add(box);
  return all;
}

InstanceCounts countInstances(const Scene& scene) {
  InstanceCounts counts;
  counts.placedTriangles = scene.triangleCount();
  std::vector<char> isInstanced(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) {
    counts.placedTriangles += scene.meshes[instance.mesh].triangles.size();
    isInstanced[instance.mesh] = 1;
  }
  counts.meshes = static_cast<std::uint64_t>(std::count(isInstanced.begin(), isInstanced.end(), 1));
  counts.placements = counts.meshes + scene.instances.size();
  return counts;
}

std::string triangleText(const Scene& scene) {
  if (scene.instances.empty()) return fmt::format("{} triangles", scene.triangleCount());
  const InstanceCounts counts = countInstances(scene);
  return fmt::format("{} triangles stored, {} placed in {} instances", scene.triangleCount(), counts.placedTriangles,
                     counts.placements);
}

}  // namespace malus::pack
