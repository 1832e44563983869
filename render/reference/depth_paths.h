// Light of a pixel by the number of specular interactions on its paths, without a limit of the depth: the tracer of the
// reference in the other direction, from the camera. A path carries an importance vector per colour (a row of the
// Mueller matrices up to the camera), so that polarization is that of the reference. The paths with the largest
// importance are followed first, until a pixel has used its rays; the light of the others is estimated. Template of the
// tracer, which is private to renderer.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <queue>
#include <vector>

#include "bake/pack/format.h"
#include "render/reference/mueller.h"
#include "render/reference/surface.h"
#include "render/scene/render_scene.h"

namespace malus::reference {

inline constexpr std::uint32_t kRaysPerPixel = 1024;
inline constexpr std::uint32_t kMostInteractions = 4096;
inline constexpr double kLeastImportance = 1e-6;  // of S0; paths below are left

template <class Tracer>
class DepthPaths {
 public:
  // energy[i]: light after i interactions, the last element also after more; over pixels and colours.
  std::vector<double> energy = std::vector<double>(pack::kMaxDepth + 2);
  std::vector<bool> darkBacks;  // per material: a one-sided emitter was met from behind
  std::uint64_t unfollowed = 0;

  explicit DepthPaths(Tracer& tracer) : darkBacks(tracer.scene.materials.size()), tracer_(tracer) {}

  void followPixel(const dvec3& origin, const dvec3& direction) {
    waiting_ = {};
    push({origin, origin, direction, unpolarized(dvec3(1)), 0, false});
    endedLight_ = endedImportance_ = 0;
    for (std::uint32_t ray = 0; ray < kRaysPerPixel && !waiting_.empty(); ++ray) {
      const Path path = waiting_.top();
      waiting_.pop();
      follow(path);
    }
    unfollowed += waiting_.size();
    estimateRest();
  }

 private:
  using Hit = typename Tracer::Hit;

  struct Path {
    dvec3 origin, queryOrigin, d;
    Light importance;  // row vectors, in the canonical frame of the ray
    std::uint32_t interactions;
    bool isBehindRough;
    double size() const { return std::max({importance[0][0], importance[1][0], importance[2][0]}); }
    bool operator<(const Path& other) const { return size() < other.size(); }
  };

  static Light times(const Light& row, const Mueller& m) { return {row[0] * m[0], row[1] * m[1], row[2] * m[2]}; }
  static Light times(const Light& row, const dmat4& m) { return {row[0] * m, row[1] * m, row[2] * m}; }

  void push(const Path& path) {
    if (path.size() >= kLeastImportance && path.interactions <= kMostInteractions) waiting_.push(path);
  }
  void add(double light, std::uint32_t interactions) {
    energy[std::min<std::size_t>(interactions, energy.size() - 1)] += light;
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
    Hit h{};
    h.d = p.d;
    if (!tracer_.intersect(p.origin, p.queryOrigin, p.d, h)) {
      end(p.importance, tracer_.environmentLight(p.d), p.interactions);
      return;
    }
    const pack::Material& m = *h.surface.material;
    const Light row = scaled(p.importance, transmittanceOver(Tracer::absorptionAt(h), h.travelled));
    if (pack::isEmitter(m.kind)) {
      if (!h.outside && !m.twoSided) darkBacks[h.materialIndex] = true;
      end(row, tracer_.emittedLight(h), p.interactions);
    } else if (!pack::isInterface(m.kind)) {
      dvec3 diffuse, highlight;
      tracer_.directLight(h, 1, h.normal, diffuse, highlight);
      end(row, unpolarized(diffuse), p.interactions);
    } else if (pack::isPolarizingElement(m.kind)) {
      const dmat4 rotation = toSurface(p.d, f64::sDirection(p.d, glm::cross(h.face, m.axis)));
      const Light behind = times(times(times(row, glm::transpose(rotation)), polarizingElementMatrix(m)), rotation);
      push({h.position, tracer_.queryBelow(h), p.d, behind, p.interactions + 1, p.isBehindRough});
    } else {
      followInterface(p, h, row);
    }
  }

  void followInterface(const Path& p, Hit& h, const Light& row) {
    const pack::Material& m = *h.surface.material;
    const auto [n1, n2, refracted, isTotal] = tracer_.refractionAt(h);
    const Interface interface = evaluateInterface(h.surface, h.c, n1, n2);
    const dvec3 mirror = f64::mirrorDirection(p.d, h.normal, h.c), s = f64::sDirection(p.d, h.normal);
    dvec3 diffuse, highlight;
    tracer_.directLight(h, 1, mirror, diffuse, highlight);

    // Light of the surface itself, in the frame of the surface.
    const Light atSurface = times(row, glm::transpose(toSurface(p.d, s)));
    const bool isClear = pack::isClear(m.kind);
    if (!isClear) record(atSurface, interface.transmission * unpolarized(diffuse), p.interactions);
    const Light reflected = times(atSurface, interface.reflection);
    record(reflected, unpolarized(highlight), p.interactions + 1);

    // Rays that leave it.
    if (m.roughness > 0 && !p.isBehindRough) {
      followFacets(p, h, row, n1, n2);
      return;
    }
    push({h.position, tracer_.queryAbove(h), mirror, times(reflected, toSurface(mirror, s)), p.interactions + 1,
          p.isBehindRough});
    if (isClear && !isTotal)
      push({h.position, tracer_.queryBelow(h), refracted,
            times(times(atSurface, interface.transmission), toSurface(refracted, s)), p.interactions + 1,
            p.isBehindRough});
  }

  void followFacets(const Path& p, const Hit& h, const Light& row, double n1, double n2) {
    const double alpha = h.surface.material->roughness;
    for (std::size_t i = 0; i < gpu::kFacets; ++i) {
      const glm::dvec2 point = render::facetPoint(i);
      const dvec3 normal = f64::facetNormal(-p.d, h.normal, alpha, point.x, point.y);
      const double c = f64::clampUnit(-glm::dot(p.d, normal));
      const dvec3 mirror = f64::mirrorDirection(p.d, normal, c);
      const double weight = f64::facetWeight(-p.d, mirror, h.normal, alpha) / gpu::kFacets;
      if (weight <= 0 || glm::dot(mirror, h.face) <= 0) continue;
      const dvec3 s = f64::sDirection(p.d, normal);
      const Light atFacet =
          times(times(row, glm::transpose(toSurface(p.d, s))), evaluateInterface(h.surface, c, n1, n2).reflection);
      push({h.position, tracer_.queryAbove(h), mirror, scaled(times(atFacet, toSurface(mirror, s)), dvec3(weight)),
            p.interactions + 1, true});
    }
  }

  Tracer& tracer_;
  std::priority_queue<Path> waiting_;
  double endedLight_ = 0, endedImportance_ = 0;  // of the current pixel
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
