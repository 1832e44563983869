#include "render/scene/area_lights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/pack/instances.h"

namespace malus::render {

using glm::dvec3;

namespace {

// Largest relative error of a right angle and of opposite sides for which two triangles count as a rectangle: several
// steps of a pack's position grid.
constexpr double kRectangleError = 2e-5;

bool illuminates(const pack::Material& m) {
  return m.illuminates && pack::isEmitter(m.kind) && (m.radiance.x > 0 || m.radiance.y > 0 || m.radiance.z > 0);
}

using Triangle = std::array<dvec3, 3>;

// The corner of a right angle of a triangle, whose opposite side is the diagonal of a rectangle.
std::optional<std::size_t> rightCorner(const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 u = t[(i + 1) % 3] - t[i], v = t[(i + 2) % 3] - t[i];
    if (std::abs(glm::dot(u, v)) <= kRectangleError * glm::length(u) * glm::length(v)) return i;
  }
  return {};
}

// The lights of one placement of a mesh.
class MeshLights {
 public:
  MeshLights(const pack::Placement& placement, const pack::Material& material, std::vector<AreaLight>& lights)
      : material_(material), lights_(lights) {
    std::vector<Triangle> triangles;
    for (const glm::uvec3& t : placement.mesh->triangles) {
      triangles.push_back({placement.point(t.x), placement.point(t.y), placement.point(t.z)});
      if (placement.isMirrored()) std::swap(triangles.back()[1], triangles.back()[2]);
    }
    std::vector<bool> isUsed(triangles.size());
    // A rectangle's triangles have its diagonal in opposite directions.
    std::map<std::array<double, 6>, std::size_t> diagonals;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Triangle& t = triangles[i];
      const auto corner = rightCorner(t);
      if (!corner) continue;
      const dvec3 &from = t[(*corner + 1) % 3], &to = t[(*corner + 2) % 3];
      const auto other = diagonals.find({to.x, to.y, to.z, from.x, from.y, from.z});
      if (other != diagonals.end() && !isUsed[other->second] && isRectangle(t, *corner, triangles[other->second])) {
        add(t[*corner], from - t[*corner], to - t[*corner], true);
        isUsed[i] = isUsed[other->second] = true;
      } else {
        diagonals[{from.x, from.y, from.z, to.x, to.y, to.z}] = i;
      }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (!isUsed[i]) add(triangles[i][0], triangles[i][1] - triangles[i][0], triangles[i][2] - triangles[i][0], false);
  }

 private:
  static bool isRectangle(const Triangle& t, std::size_t corner, const Triangle& other) {
    const auto otherCorner = rightCorner(other);
    if (!otherCorner) return false;
    const dvec3 u = t[(corner + 1) % 3] - t[corner], v = t[(corner + 2) % 3] - t[corner], expected = t[corner] + u + v;
    return glm::length(other[*otherCorner] - expected) <= kRectangleError * std::min(glm::length(u), glm::length(v));
  }

  void add(const dvec3& corner, const dvec3& edgeU, const dvec3& edgeV, bool isRectangle) {
    const dvec3 across = glm::cross(edgeU, edgeV);
    const double area = glm::length(across);
    if (!(area > 0)) return;
    AreaLight& l = lights_.emplace_back();
    l.corner = corner;
    l.edgeU = edgeU;
    l.edgeV = edgeV;
    l.normal = across / area;
    l.radiance = material_.radiance / (material_.outsideEta * material_.outsideEta);
    l.backRadiance = material_.twoSided ? l.radiance : dvec3(0);
    l.axis = material_.axis;
    l.degree = material_.polarization;
    l.parallelogram = area;
    l.isRectangle = isRectangle ? 1 : 0;
    // 16 roundings of the largest coordinate, as a float.
    const dvec3 far = glm::max(glm::abs(corner), glm::max(glm::abs(corner + edgeU), glm::abs(corner + edgeV)));
    l.offset = 0x1p-20 * std::max({far.x, far.y, far.z});
  }

  const pack::Material& material_;
  std::vector<AreaLight>& lights_;
};

dvec3 lightCentre(const AreaLight& l) { return l.corner + (l.edgeU + l.edgeV) * (l.isRectangle > 0 ? 0.5 : 1.0 / 3); }

std::array<dvec3, 4> lightCorners(const AreaLight& l) {
  const dvec3 last = l.isRectangle > 0 ? l.corner + l.edgeU + l.edgeV : l.corner;
  return {l.corner, l.corner + l.edgeU, l.corner + l.edgeV, last};
}

double sum(const dvec3& v) { return v.x + v.y + v.z; }

// Rounding of a node's numbers to float must not cut lights off.
constexpr double kMargin = 1e-5;

// The sphere, cone and power of some lights; index and isInner are set by the caller.
LightNode makeNode(std::span<const std::uint32_t> group, const std::vector<AreaLight>& lights) {
  dvec3 low = lightCentre(lights[group[0]]), high = low, axis(0);
  LightNode node{};
  for (const std::uint32_t i : group) {
    for (const dvec3& p : lightCorners(lights[i])) low = glm::min(low, p), high = glm::max(high, p);
    const double area = lights[i].parallelogram * (lights[i].isRectangle > 0 ? 1 : 0.5);
    node.power += area * sum(lights[i].radiance);
    axis += lights[i].normal * area;
  }
  node.centre = (low + high) * 0.5;
  const double length = glm::length(axis);
  node.axis = length > 0 ? axis / length : dvec3(0, 0, 1);
  node.spread = length > 0 ? 1 : -1;
  for (const std::uint32_t i : group) {
    for (const dvec3& p : lightCorners(lights[i])) node.radius = std::max(node.radius, glm::length(p - node.centre));
    const bool isTwoSided = sum(lights[i].backRadiance) > 0;
    node.spread = isTwoSided ? -1 : std::min(node.spread, glm::dot(node.axis, lights[i].normal));
  }
  node.radius *= 1 + kMargin;
  node.spread = std::max(node.spread - kMargin, -1.0);
  return node;
}

// Splits the lights at the median along the longest axis of their centres; at(node) is written last, because the nodes
// may move.
void build(std::span<std::uint32_t> group, AreaLights& result, std::size_t at) {
  LightNode node = makeNode(group, result.lights);
  if (group.size() == 1) {
    node.index = group[0];
    result.nodes[at] = node;
    return;
  }
  dvec3 low = lightCentre(result.lights[group[0]]), high = low;
  for (const std::uint32_t i : group) {
    const dvec3 c = lightCentre(result.lights[i]);
    low = glm::min(low, c), high = glm::max(high, c);
  }
  const dvec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t half = group.size() / 2;
  std::nth_element(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(half), group.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = lightCentre(result.lights[a])[axis], cb = lightCentre(result.lights[b])[axis];
                     return ca < cb || (ca == cb && a < b);
                   });
  const std::size_t first = result.nodes.size();
  result.nodes.resize(first + 2);
  node.isInner = 1;
  node.index = static_cast<std::uint32_t>(first);
  result.nodes[at] = node;
  build(group.first(half), result, first);
  build(group.subspan(half), result, first + 1);
}

AreaLights collectLights(const pack::Scene& scene) {
  AreaLights result;
  std::uint32_t number = 0;
  for (const pack::Placement& placement : pack::placements(scene)) {
    const pack::Material& material = scene.materials[placement.mesh->material];
    if (illuminates(material)) MeshLights(placement, material, result.lights);
    result.placements.resize(result.lights.size(), number++);
  }
  return result;
}

}  // namespace

AreaLights findAreaLights(const pack::Scene& scene) {
  AreaLights result = collectLights(scene);
  if (result.lights.empty()) return result;
  std::vector<std::uint32_t> group(result.lights.size());
  std::iota(group.begin(), group.end(), 0u);
  result.nodes.resize(1);
  build(group, result, 0);
  return result;
}

AreaLightCount countAreaLights(const pack::Scene& scene) {
  const std::size_t lights = collectLights(scene).lights.size();
  return {lights, lights > 1 ? static_cast<std::size_t>(std::bit_width(lights - 1)) : 0};
}

gpu::AreaLight toFloat(const AreaLight& l) {
  return {glm::vec3(l.corner),
          glm::vec3(l.edgeU),
          glm::vec3(l.edgeV),
          glm::vec3(l.normal),
          glm::vec3(l.radiance),
          glm::vec3(l.backRadiance),
          glm::vec3(l.axis),
          static_cast<float>(l.degree),
          static_cast<float>(l.parallelogram),
          static_cast<float>(l.isRectangle),
          static_cast<float>(l.offset)};
}

gpu::LightNode toFloat(const LightNode& n) {
  return {glm::vec3(n.centre),
          static_cast<float>(n.radius),
          glm::vec3(n.axis),
          static_cast<float>(n.spread),
          static_cast<float>(n.power),
          static_cast<float>(n.isInner),
          n.index};
}

}  // namespace malus::render
