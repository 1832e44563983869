#include "render/reference/shadow_filters.h"

#include <glm/geometric.hpp>

namespace malus::reference {

namespace {

// Matrix of a surface for light against the direction of the hit's ray, in the ray's canonical frame.
WayFilter surfaceFilter(const Hit& h) {
  const pack::Material& m = *h.surface.material;
  const bool isElement = pack::isPolarizingElement(m.kind);
  const dvec3 s = f64::sDirection(h.d, isElement ? glm::cross(h.face, m.axis) : h.normal);
  const Mueller terms = isElement ? polarizingElementMatrix(m)
                                  : evaluateInterface(h.surface, h.c, m.outsideEta, h.surface.eta.y).transmission;
  const FrameRotation rotation = toSurface(h.d, s);
  WayFilter result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = matrix(transposed(rotation)) * matrix(terms[i]) * matrix(rotation);
  return result;
}

}  // namespace

embree::Intersection findBlocker(const SceneAccess& access, const ShadowRay& way, WayFilter& filter,
                                 std::uint64_t& rays) {
  filter.fill(dmat4(1));
  const dvec3 d = glm::normalize(dvec3(way.direction));
  Ray ray{dvec3(way.origin), d, way.origin, 0, 0, false, 0};
  for (int i = 0; i <= kMostFilters; ++i) {
    ++rays;
    const embree::Intersection found = access.bvh.nearest(ray.queryOrigin, glm::vec3(d));
    if (found.mesh == embree::Intersection::kMiss) return {};
    Hit h;
    findHit(access, ray, found, h);
    if (glm::dot(h.position - dvec3(way.origin), d) >= way.length) return {};
    const pack::MaterialKind kind = h.surface.material->kind;
    if (i == kMostFilters || !pack::transmits(kind) || pack::hasInside(kind)) return found;
    const WayFilter surface = surfaceFilter(h);
    for (std::size_t c = 0; c < 3; ++c) filter[c] = filter[c] * surface[c];
    ray.origin = h.position;
    ray.queryOrigin = glm::vec3(queryBelow(h));
  }
  return {};
}

void passAllFilters(const SceneAccess& access, std::span<const ShadowRay> ways, std::vector<std::uint8_t>& visible,
                    std::vector<WayFilter>& filters, std::uint64_t& rays) {
  visible.resize(ways.size());
  filters.resize(ways.size());
  for (std::size_t i = 0; i < ways.size(); ++i)
    visible[i] = findBlocker(access, ways[i], filters[i], rays).mesh == embree::Intersection::kMiss ? 1 : 0;
}

}  // namespace malus::reference
