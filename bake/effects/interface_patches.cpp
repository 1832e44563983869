#include "bake/effects/interface_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>

#include "bake/pack/instances.h"

namespace malus::bake {
using pack::Material;

namespace {

constexpr double kPi = std::numbers::pi;

// Whether rays meet a surface with other normals than those of its faces and vertices.
bool hasOtherNormals(const Material& m) {
  return m.roughness > 0 || m.meshMaps.roughness.isUsed() || m.meshMaps.normal.isUsed();
}

InterfacePatch anywhere(std::uint32_t material) { return {material, {}, {0, 0, 1}, kPi, false}; }

// Half angle of the cone about an axis that contains some vectors, which need not have length 1.
double spreadAbout(const glm::dvec3& axis, const std::vector<glm::dvec3>& vectors) {
  double least = 1;
  for (const glm::dvec3& v : vectors) least = std::min(least, glm::dot(axis, v) / glm::length(v));
  return std::acos(std::clamp(least, -1.0, 1.0));
}

std::vector<glm::dvec3> corners(const pack::Box& box) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z);
  return points;
}

// The face's normal, not normalized, and those of its corners.
std::vector<glm::dvec3> faceNormals(const pack::Placement& placement, const glm::uvec3& t) {
  const glm::dvec3 p = placement.point(t.x);
  std::vector<glm::dvec3> normals = {glm::cross(placement.point(t.y) - p, placement.point(t.z) - p)};
  if (placement.isMirrored()) normals[0] = -normals[0];
  const glm::dmat3 turn = placement.instance ? pack::cofactors(placement.instance->linear) : glm::dmat3(1.0);
  const double side = placement.isMirrored() ? -1 : 1;
  if (!placement.mesh->normals.empty())
    for (int i = 0; i < 3; ++i) normals.push_back(side * (turn * glm::dvec3(placement.mesh->normals[t[i]])));
  std::erase_if(normals, [](const glm::dvec3& n) { return !(glm::length(n) > 0); });
  return normals;
}

void setNormals(InterfacePatch& patch, const std::vector<glm::dvec3>& normals, const Material& material) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& n : normals) sum += glm::normalize(n);
  const double length = glm::length(sum);
  patch.axis = length > 0 ? sum / length : glm::dvec3(0, 0, 1);
  patch.spread = length > 0 && !hasOtherNormals(material) ? spreadAbout(patch.axis, normals) : kPi;
}

void addFaces(std::vector<InterfacePatch>& patches, const pack::Placement& placement, const Material& material) {
  for (const glm::uvec3& t : placement.mesh->triangles) {
    const std::vector<glm::dvec3> normals = faceNormals(placement, t);
    if (normals.empty()) continue;  // no ray meets it
    InterfacePatch& patch = patches.emplace_back();
    patch.material = placement.mesh->material;
    for (int i = 0; i < 3; ++i) patch.hull.push_back(placement.point(t[i]));
    setNormals(patch, normals, material);
    patch.isFlat = placement.mesh->normals.empty() && !hasOtherNormals(material);
  }
}

void addWhole(std::vector<InterfacePatch>& patches, const pack::Placement& placement, const pack::Box& box,
              const Material& material) {
  std::vector<glm::dvec3> normals;
  for (const glm::uvec3& t : placement.mesh->triangles)
    for (const glm::dvec3& n : faceNormals(placement, t)) normals.push_back(n);
  if (normals.empty()) return;
  InterfacePatch& patch = patches.emplace_back();
  patch.material = placement.mesh->material;
  patch.hull = corners(box);
  setNormals(patch, normals, material);
}

}  // namespace

std::vector<InterfacePatch> interfacePatches(const pack::Scene& scene) {
  std::vector<pack::Placement> places;
  std::vector<pack::Box> boxes;
  std::size_t faces = 0, bare = 0;
  std::set<std::uint32_t> materials;
  const std::vector<pack::Placement> all = pack::placements(scene);
  const std::vector<pack::Box> allBoxes = pack::placementBoxes(scene);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t material = all[i].mesh->material;
    if (!pack::isInterface(scene.materials[material].kind)) continue;
    materials.insert(material);
    places.push_back(all[i]);
    boxes.push_back(allBoxes[i]);
    faces += all[i].mesh->triangles.size();
    bare += all[i].mesh->triangles.empty() ? 1 : 0;
  }
  std::vector<InterfacePatch> patches;
  if (places.size() > kMostPatches || bare > 0) {
    for (const std::uint32_t material : materials) patches.push_back(anywhere(material));
    return patches;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Material& material = scene.materials[places[i].mesh->material];
    if (faces <= kMostPatches)
      addFaces(patches, places[i], material);
    else
      addWhole(patches, places[i], boxes[i], material);
  }
  return patches;
}

CosineRange incidence(const std::vector<glm::dvec3>& from, const InterfacePatch& to, double flatness) {
  if (from.empty() || to.hull.empty() || to.spread >= kPi) return {};
  if (to.isFlat && std::all_of(from.begin(), from.end(), [&](const glm::dvec3& p) {
        return std::abs(glm::dot(p - to.hull[0], to.axis)) <= flatness;
      }))
    return {1, 0};

  // The directions are in the convex cone of the differences of the points, and that is in a cone about their mean.
  std::vector<glm::dvec3> directions;
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : from)
    for (const glm::dvec3& q : to.hull) {
      const glm::dvec3 d = p - q;
      const double length = glm::length(d);
      if (!(length > 0)) return {};
      directions.push_back(d / length);
      sum += directions.back();
    }
  const double length = glm::length(sum);
  const double spread = length > 0 ? spreadAbout(sum / length, directions) : kPi;
  if (spread >= kPi / 2) return {};

  const double middle = std::acos(std::clamp(glm::dot(sum / length, to.axis), -1.0, 1.0));
  double first = middle - spread, last = middle + spread;
  // On one side of the plane the most oblique direction is that of a corner: the level sets of the angle are cones.
  double least = 1, most = -1;
  for (const glm::dvec3& d : directions) {
    least = std::min(least, glm::dot(d, to.axis));
    most = std::max(most, glm::dot(d, to.axis));
  }
  if (least > 0) last = std::min(last, std::acos(least));
  if (most < 0) first = std::max(first, std::acos(most));
  constexpr double kRounding = 1e-9;
  first = std::max(0.0, first - to.spread - kRounding);
  last = std::min(kPi, last + to.spread + kRounding);
  const double a = std::abs(std::cos(first)), b = std::abs(std::cos(last));
  return {first <= kPi / 2 && last >= kPi / 2 ? 0 : std::min(a, b), std::max(a, b)};
}

}  // namespace malus::bake
