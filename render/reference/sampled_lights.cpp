#include "render/reference/sampled_lights.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>

namespace malus::reference {

using render::AreaLight;
using render::LightNode;

namespace {

struct Point {
  double u, v;
};

// Sample k of a hit.
Point samplePoint(std::uint32_t path, std::uint32_t purpose, std::uint32_t k, std::uint32_t samples) {
  double turnU, turnV;
  f64::pathRotation(path, purpose, turnU, turnV);
  return {(k + turnU) / samples, f64::wrapUnit(f64::radicalInverse(k) + turnV)};
}

bool isInFront(const Hit& h, const dvec3& direction) {
  return glm::dot(h.normal, direction) > 0 && glm::dot(h.face, direction) > 0;
}

struct Choice {
  std::uint32_t light;
  double probability, u;
};

Choice chooseLight(const render::AreaLights& lights, const Hit& h, double u) {
  const auto importance = [&](const LightNode& n) {
    return f64::lightImportance(h.position, h.normal, n.centre, n.radius, n.axis, n.spread, n.power);
  };
  const LightNode* node = lights.nodes.data();
  Choice choice{0, 1, u};
  while (node->isInner > 0) {
    const LightNode *a = lights.nodes.data() + node->index, *b = a + 1;
    const double left = importance(*a), sum = left + importance(*b);
    if (!(sum > 0)) return {0, 0, 0};
    const double share = left / sum;
    const bool goesLeft = choice.u < share;
    const double part = goesLeft ? share : 1 - share;
    choice.u = std::min((goesLeft ? choice.u : choice.u - share) / part, 1 - 0x1p-53);
    choice.probability *= part;
    node = goesLeft ? a : b;
  }
  choice.light = node->index;
  return choice;
}

void addAreaLights(const SceneAccess& access, const Hit& h, std::uint32_t path, std::vector<Arrival>& arrivals,
                   std::vector<ShadowRay>& ways) {
  if (access.areaLights.lights.empty()) return;
  for (std::uint32_t k = 0; k < access.lightSamples; ++k) {
    const Point point = samplePoint(path, 1, k, access.lightSamples);
    const Choice choice = chooseLight(access.areaLights, h, point.u);
    if (choice.probability == 0) continue;
    const AreaLight& l = access.areaLights.lights[choice.light];
    const dvec3 corner = l.corner - h.position, across = l.normal * l.parallelogram;
    const f64::AreaSample s = l.isRectangle > 0
                                  ? f64::sampleRectangleLight(corner, l.edgeU, l.edgeV, across, choice.u, point.v)
                                  : f64::sampleTriangleLight(corner, l.edgeU, l.edgeV, across, choice.u, point.v);
    const double distance = glm::length(s.toLight);
    if (!(distance > 0)) continue;
    const dvec3 direction = s.toLight / distance;
    const bool front = glm::dot(direction, l.normal) < 0;
    const dvec3 radiance = front ? l.radiance : l.backRadiance;
    if (radiance == dvec3(0) || !isInFront(h, direction)) continue;
    arrivals.push_back({direction, glm::dot(h.normal, direction), 0,
                        radiance * (s.measure / (choice.probability * access.lightSamples)), distance,
                        glm::cross(l.normal, l.axis), l.degree, "emitter", access.areaLights.placements[choice.light]});
    const double offset = l.offset + f64::largestPart(h.position) * 0x1p-20;
    ways.push_back(wayTo(h, s.toLight + l.normal * (front ? offset : -offset)));
  }
}

struct EnvironmentSample {
  dvec3 direction;
  double share;  // inverse of the density
};

// The interval of a distribution of `size` intervals that contains u.
std::size_t search(const float* distribution, std::size_t size, double& u, double& mass) {
  const float* const above = std::upper_bound(distribution, distribution + size, static_cast<double>(u),
                                              [](double value, float entry) { return value < entry; });
  const std::size_t index = static_cast<std::size_t>(above - distribution) - 1;
  const double low = distribution[index];
  mass = distribution[index + 1] - low;
  u = f64::clampUnit((u - low) / mass);
  return index;
}

EnvironmentSample sampleEnvironment(const SceneAccess& access, const Hit& h, Point point) {
  const std::size_t size = access.scene.environment.size;
  if (size == 0) {
    const dvec3 direction = f64::cosineDirection(h.normal, point.u, point.v);
    return {direction, std::numbers::pi / std::max(glm::dot(h.normal, direction), 1e-6)};
  }
  const float* const all = access.environmentDistributions.data();
  double rowMass, columnMass;
  const std::size_t row = search(all, size, point.u, rowMass),
                    column = search(all + (row + 1) * (size + 1), size, point.v, columnMass);
  const double texels = static_cast<double>(size);
  const dvec3 direction = f64::directionFromOctahedral((static_cast<double>(column) + point.v) / texels,
                                                       (static_cast<double>(row) + point.u) / texels);
  return {direction, f64::octahedralSolidAngle(direction) / (texels * texels * rowMass * columnMass)};
}

void addEnvironment(const SceneAccess& access, const Hit& h, std::uint32_t path, std::vector<Arrival>& arrivals,
                    std::vector<ShadowRay>& ways) {
  const pack::Environment& e = access.scene.environment;
  if (!e.illuminates) return;
  for (std::uint32_t k = 0; k < access.lightSamples; ++k) {
    const auto [direction, share] = sampleEnvironment(access, h, samplePoint(path, 2, k, access.lightSamples));
    if (!isInFront(h, direction)) continue;
    const double cosine = glm::dot(direction, e.sun);
    const double phase = e.hasSun() && e.size == 0 ? f64::rayleighPhase(cosine) : 1.0;
    arrivals.push_back({direction, glm::dot(h.normal, direction), 0,
                        environmentRadiance(e, direction) * (phase * share / access.lightSamples), 0, e.sun,
                        e.hasSun() ? f64::rayleighDegree(cosine, e.skyDegree) : 0, "environment", 0});
    ways.push_back(wayTo(h, direction * access.lightReach));
  }
}

}  // namespace

void findSampledArrivals(const SceneAccess& access, const Hit& h, std::uint32_t path, std::vector<Arrival>& arrivals,
                         std::vector<ShadowRay>& ways) {
  addAreaLights(access, h, path, arrivals, ways);
  addEnvironment(access, h, path, arrivals, ways);
}

}  // namespace malus::reference
