// Light of a pixel by the number of specular interactions on its paths, without a limit of the depth: the tracer of the
// reference in the other direction, from the camera. A path carries an importance vector per colour (a row of the
// Mueller matrices up to the camera), so that polarization is that of the reference. The paths with the largest
// importance are followed first, until a pixel has used its rays; the light of the others is estimated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <queue>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/depth_probe.h"
#include "bake/pack/format.h"
#include "render/reference/hit.h"
#include "render/reference/lights.h"
#include "render/scene/render_scene.h"

namespace malus::reference {

inline constexpr std::uint32_t kRaysPerPixel = 1024;
inline constexpr std::uint32_t kMostInteractions = 4096;
inline constexpr double kLeastImportance = 1e-6;  // of S0; paths below are left

class DepthPaths {
 public:
  // energy[i]: light after i interactions, the last element also after more; over pixels and colours.
  std::vector<double> energy = std::vector<double>(pack::kMaxDepth + 2);
  std::vector<bool> darkBacks;  // per material: a one-sided emitter was met from behind
  std::uint64_t rays = 0, unfollowed = 0;

  std::set<bake::BlockedLight> blockedLights;

  explicit DepthPaths(const SceneAccess& access)
      : darkBacks(access.scene.materials.size()),
        access_(access),
        hasGlass_(std::ranges::any_of(access.scene.materials,
                                      [](const pack::Material& m) { return pack::hasInside(m.kind); })) {}

  // Returns the light of the pixel, the mean of the colours, as basic radiance.
  double followPixel(const dvec3& origin, const dvec3& direction) {
    waiting_ = {};
    const std::uint32_t start = f64::pathStart(started_++, 0);
    push({{origin, direction, glm::vec3(origin), 0, 0, false, start}, unpolarized(dvec3(1)), 0});
    endedLight_ = endedImportance_ = pixelLight_ = 0;
    for (std::uint32_t ray = 0; ray < kRaysPerPixel && !waiting_.empty(); ++ray) {
      const Path path = waiting_.top();
      waiting_.pop();
      follow(path);
    }
    unfollowed += waiting_.size();
    estimateRest();
    return pixelLight_ / 3;
  }

 private:
  struct Path {
    Ray ray;
    Light importance;  // row vectors, in the canonical frame of the ray
    std::uint32_t interactions;
    double size() const { return std::max({importance[0][0], importance[1][0], importance[2][0]}); }
    bool operator<(const Path& other) const { return size() < other.size(); }
  };

  static Light times(const Light& row, const Mueller& m) { return {row[0] * m[0], row[1] * m[1], row[2] * m[2]}; }
  static Light times(const Light& row, const FrameRotation& m) { return {row[0] * m, row[1] * m, row[2] * m}; }

  void push(const Path& path) {
    if (path.size() >= kLeastImportance && path.interactions <= kMostInteractions) waiting_.push(path);
  }
  void add(double light, std::uint32_t interactions) {
    energy[std::min<std::size_t>(interactions, energy.size() - 1)] += light;
    pixelLight_ += light;
  }
  static double dot(const Light& importance, const Light& light) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += glm::dot(importance[c], light[c]);
    return sum;
  }
  void record(const Light& importance, const Light& light, std::uint32_t interactions) {
    add(dot(importance, light), interactions);
  }
  // Records light at the end of a path.
  void end(const Light& importance, const Light& light, std::uint32_t interactions) {
    record(importance, light, interactions);
    endedLight_ += dot(importance, light);
    endedImportance_ += sum(importance);
  }
  static double sum(const Light& importance) { return importance[0][0] + importance[1][0] + importance[2][0]; }

  // Estimates the light of the paths that are left: the mean radiance at the ends of the others, after the interactions
  // that they have had, which is the least. A body of a high index has hundreds of paths of little importance each.
  void estimateRest() {
    if (!(endedImportance_ > 0)) return;
    for (; !waiting_.empty(); waiting_.pop())
      add(sum(waiting_.top().importance) * (endedLight_ / endedImportance_), waiting_.top().interactions);
  }

  void follow(const Path& p) {
    const dvec3& d = p.ray.d;
    ++rays;
    const embree::Intersection found = access_.bvh.nearest(p.ray.queryOrigin, glm::vec3(d));
    if (found.mesh == embree::Intersection::kMiss) {
      end(p.importance, environmentLight(access_.scene.environment, d), p.interactions);
      return;
    }
    Hit h;
    findHit(access_, p.ray, found, h);
    const pack::Material& m = *h.surface.material;
    const Light row = scaled(p.importance, mediumTransmittance(p.ray, h));
    if (pack::isEmitter(m.kind)) {
      if (!h.outside && !m.twoSided) darkBacks[h.materialIndex] = true;
      end(row, emittedLight(h), p.interactions);
    } else if (!pack::isInterface(m.kind)) {
      end(row, unpolarized(directLightAt(h, h.normal, p.ray.path).diffuse), p.interactions);
    } else if (pack::isPolarizingElement(m.kind)) {
      const FrameRotation rotation = toSurface(d, f64::sDirection(d, glm::cross(h.face, m.axis)));
      const Light behind = times(times(times(row, transposed(rotation)), polarizingElementMatrix(m)), rotation);
      push({rayBelow(h, d, p), behind, p.interactions + 1});
    } else {
      followInterface(p, h, row);
    }
  }

  static Ray rayAbove(const Hit& h, const dvec3& d, bool isBehindRough, std::uint32_t path) {
    return {h.position, d, glm::vec3(h.above), 0, 0, isBehindRough, path};
  }
  static Ray rayBelow(const Hit& h, const dvec3& d, const Path& p) {
    return {h.position, d, glm::vec3(queryBelow(h)), 0, 0, p.ray.isBehindRough, transmittedPath(h)};
  }

  DirectLight directLightAt(const Hit& h, const dvec3& mirror, std::uint32_t path) {
    arrivals_.clear(), ways_.clear(), visible_.clear(), filters_.clear();
    findArrivals(access_, h, true, mirror, path, arrivals_, ways_);
    if (access_.filtersShadows) {
      passAllFilters(access_, ways_, visible_, filters_, rays);
    } else {
      for (const ShadowRay& way : ways_)
        visible_.push_back(access_.bvh.visible(way.origin, way.direction, way.length) ? 1 : 0);
      rays += ways_.size();
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (visible_[i] == 0) findBlockingGlass(arrivals_[i], ways_[i]);
    return directLight(access_, h, arrivals_, visible_, filters_);
  }

  // Notes the closed body of glass that is first in the way of a light, behind thin surfaces that let it pass.
  void findBlockingGlass(const Arrival& a, const ShadowRay& way) {
    if (!hasGlass_) return;
    WayFilter filter;
    const embree::Intersection found = findBlocker(access_, way, filter, rays);
    if (found.mesh == embree::Intersection::kMiss) return;
    const std::uint32_t mesh = access_.records.meshes[found.mesh], instance = access_.records.instances[found.mesh];
    const pack::Material& m = access_.scene.materials[access_.scene.meshes[mesh].material];
    if (!pack::hasInside(m.kind)) return;
    const auto placement =
        instance == render::kNoInstance ? mesh : static_cast<std::uint32_t>(access_.scene.meshes.size()) + instance;
    blockedLights.insert({std::string(a.kind), a.number, placement});
  }

  void followInterface(const Path& p, Hit& h, const Light& row) {
    const pack::Material& m = *h.surface.material;
    const Refraction refraction = refractionAt(h);
    const Interface interface = evaluateInterface(h.surface, h.c, refraction.n1, refraction.n2);
    const dvec3 mirror = f64::mirrorDirection(h.d, h.normal, h.c), s = f64::sDirection(h.d, h.normal);
    const auto [diffuse, highlight] = directLightAt(h, mirror, p.ray.path);

    // Light of the surface itself, in the frame of the surface.
    const Light atSurface = times(row, transposed(toSurface(h.d, s)));
    const bool isClear = pack::isClear(m.kind);
    if (!isClear) record(atSurface, interface.transmission * unpolarized(diffuse), p.interactions);
    const Light reflected = times(atSurface, interface.reflection);
    record(reflected, unpolarized(highlight), p.interactions + 1);

    // Rays that leave it.
    if (h.surface.roughness > 0 && !p.ray.isBehindRough) {
      followFacets(p, h, row, refraction);
      return;
    }
    push({rayAbove(h, mirror, p.ray.isBehindRough, reflectedPath(access_, h)), times(reflected, toSurface(mirror, s)),
          p.interactions + 1});
    if (isClear && !refraction.isTotal)
      push({rayBelow(h, refraction.direction, p),
            times(times(atSurface, interface.transmission), toSurface(refraction.direction, s)), p.interactions + 1});
  }

  void followFacets(const Path& p, const Hit& h, const Light& row, const Refraction& refraction) {
    const f64::VisibleFacets visible = f64::visibleFacets(-h.d, h.normal, h.surface.roughness);
    for (std::uint32_t i = 0; i < gpu::kFacets; ++i) {
      const glm::dvec2 point = render::facetPoint(i);
      const dvec3 normal = f64::facetNormal(visible, point.x, point.y);
      const double c = f64::clampUnit(-glm::dot(h.d, normal));
      const dvec3 mirror = f64::mirrorDirection(h.d, normal, c);
      const double weight = f64::facetWeight(visible, mirror) / gpu::kFacets;
      if (weight <= 0 || glm::dot(mirror, h.face) <= 0) continue;
      const dvec3 s = f64::sDirection(h.d, normal);
      const Light atFacet = times(times(row, transposed(toSurface(h.d, s))),
                                  evaluateInterface(h.surface, c, refraction.n1, refraction.n2).reflection);
      push({rayAbove(h, mirror, true, facetPath(access_, h, i)),
            scaled(times(atFacet, toSurface(mirror, s)), dvec3(weight)), p.interactions + 1});
    }
  }

  const SceneAccess& access_;
  std::vector<Arrival> arrivals_;
  std::vector<ShadowRay> ways_;
  std::vector<std::uint8_t> visible_;
  std::vector<WayFilter> filters_;
  bool hasGlass_;
  std::priority_queue<Path> waiting_;
  std::uint32_t started_ = 0;                                     // pixels
  double endedLight_ = 0, endedImportance_ = 0, pixelLight_ = 0;  // of the current pixel
};

// The shares of bake::DepthProbe::beyond.
inline std::vector<double> sharesBeyond(const std::vector<double>& energy) {
  std::vector<double> shares(energy.size());
  double sum = 0;
  for (std::size_t i = energy.size(); i-- > 0;) {
    shares[i] = sum;
    sum += energy[i];
  }
  if (!(sum > 0)) return {};
  for (double& share : shares) share /= sum;
  shares.pop_back();  // nothing is beyond the last element
  while (!shares.empty() && shares.back() == 0) shares.pop_back();
  return shares;
}

}  // namespace malus::reference
