#include "render/reference/tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "render/scene/render_scene.h"

namespace malus::reference {

namespace {

// |(S1, S2, S3)| - S0.
double excess(const dvec4& s) { return glm::length(dvec3(s[1], s[2], s[3])) - s[0]; }

std::uint32_t count(std::size_t n) { return static_cast<std::uint32_t>(n); }

const std::array<glm::dvec2, gpu::kFacets>& facetPoints() {
  static const std::array<glm::dvec2, gpu::kFacets> points = [] {
    std::array<glm::dvec2, gpu::kFacets> p;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = render::facetPoint(i);
    return p;
  }();
  return points;
}

}  // namespace

Tracer::Tracer(const SceneAccess& access, const render::RenderParameters& parameters)
    : access_(access), parameters_(parameters), levels_(parameters.depth + 1) {}

void Tracer::trace(std::span<const Ray> batch, std::uint32_t depth, std::span<Light> light) {
  // Checks report the first fault of a path, so that they follow one path after the other.
  const std::size_t most = parameters_.checkNumerics ? 1 : kBatch;
  for (std::size_t begin = 0; begin < batch.size(); begin += most) {
    const std::size_t size = std::min(most, batch.size() - begin);
    traceBatch(batch.subspan(begin, size), depth, light.subspan(begin, size));
  }
}

void Tracer::traceBatch(std::span<const Ray> batch, std::uint32_t depth, std::span<Light> light) {
  Level& level = levels_[depth];
  if (level.nodes.size() < batch.size()) level.nodes.resize(batch.size());
  level.arrivals.clear(), level.ways.clear(), level.facets.clear(), level.children.clear();
  findNearest(access_.bvh, batch, level.found);
  rays += batch.size();
  for (std::size_t i = 0; i < batch.size(); ++i) begin(batch[i], level.found[i], depth, level, level.nodes[i]);
  level.filters.clear();
  if (parameters_.shadows && access_.filtersShadows) {
    passAllFilters(access_, level.ways, level.visible, level.filters, rays);
  } else if (parameters_.shadows) {
    findVisible(access_.bvh, level.ways, level.visible);
    rays += level.ways.size();
  } else {
    level.visible.assign(level.ways.size(), 1);
  }
  if (!level.children.empty()) {
    level.arrived.resize(level.children.size());
    trace(level.children, depth - 1, level.arrived);
  }
  for (std::size_t i = 0; i < batch.size(); ++i) light[i] = finish(batch[i], depth, level, level.nodes[i]);
}

// Appends a ray that leaves the hit h of a ray.
void Tracer::addChild(const Ray& ray, const Hit& h, const dvec3& direction, const dvec3& queryOrigin,
                      std::uint32_t path, Level& level) {
  Ray& child = level.children.emplace_back();
  child.origin = h.position;
  child.d = direction;
  child.queryOrigin = glm::vec3(queryOrigin);
  child.pixelX = ray.pixelX;
  child.pixelY = ray.pixelY;
  child.isBehindRough = ray.isBehindRough;
  child.path = path;
}

// Finds the hit, and appends the rays that leave it.
void Tracer::begin(const Ray& ray, const embree::Intersection& found, std::uint32_t depth, Level& level,
                   Node& node) const {
  if (found.mesh == embree::Intersection::kMiss) {
    node.step = Step::environment;
    return;
  }
  // A path ends at its last surface, which reflects and transmits nothing: the hit itself is not needed.
  const pack::MaterialKind kind = findMaterial(access_, found).kind;
  if (depth == 0 && (pack::isPolarizingElement(kind) || pack::isClear(kind))) {
    node.step = Step::nothing;
    return;
  }
  Hit& h = node.hit;
  findHit(access_, ray, found, h);
  node.firstChild = count(level.children.size());
  if (pack::isEmitter(kind)) {
    node.step = Step::emitter;
  } else if (!pack::isInterface(kind)) {
    node.step = Step::diffuse;
    addArrivals(ray, depth, h.normal, level, node);
  } else if (pack::isPolarizingElement(kind)) {  // the ray continues straight on
    node.step = Step::element;
    addChild(ray, h, h.d, queryBelow(h), transmittedPath(h), level);
  } else {
    beginInterface(ray, depth, level, node);
  }
}

// From the index on this side to the index beyond.
void Tracer::beginInterface(const Ray& ray, std::uint32_t depth, Level& level, Node& node) const {
  Hit& h = node.hit;
  node.refraction = refractionAt(h);
  node.mirror = f64::mirrorDirection(h.d, h.normal, h.c);
  node.s = f64::sDirection(h.d, h.normal);
  node.rotation = toSurface(h.d, node.s);
  node.step = Step::interface;
  addArrivals(ray, depth, node.mirror, level, node);
  if (depth == 0) return;
  if (h.surface.roughness > 0 && !ray.isBehindRough) {
    beginFacets(ray, level, node);
    return;
  }
  addChild(ray, h, node.mirror, h.above, reflectedPath(access_, h), level);
  if (pack::isClear(h.surface.material->kind) && !node.refraction.isTotal)
    addChild(ray, h, node.refraction.direction, queryBelow(h), transmittedPath(h), level);
}

void Tracer::beginFacets(const Ray& ray, Level& level, Node& node) const {
  const Hit& h = node.hit;
  const f64::VisibleFacets visible = f64::visibleFacets(-h.d, h.normal, h.surface.roughness);
  node.step = Step::facets;
  node.firstFacet = count(level.facets.size());
  for (std::uint32_t i = 0; i < gpu::kFacets; ++i) {
    const glm::dvec2& point = facetPoints()[i];
    const dvec3 normal = f64::facetNormal(visible, point.x, point.y);
    const double c = f64::clampUnit(-glm::dot(h.d, normal));
    const dvec3 mirror = f64::mirrorDirection(h.d, normal, c);
    const double weight = f64::facetWeight(visible, mirror) / gpu::kFacets;
    if (weight <= 0 || glm::dot(mirror, h.face) <= 0) continue;
    level.facets.push_back({mirror, f64::sDirection(h.d, normal), c, weight});
    addChild(ray, h, mirror, h.above, facetPath(access_, h, i), level);
    level.children.back().isBehindRough = true;
  }
  node.facets = count(level.facets.size()) - node.firstFacet;
}

void Tracer::addArrivals(const Ray& ray, std::uint32_t depth, const dvec3& mirror, Level& level, Node& node) const {
  node.firstArrival = count(level.arrivals.size());
  findArrivals(access_, node.hit, depth > 0, mirror, ray.path, level.arrivals, level.ways);
  node.arrivals = count(level.arrivals.size()) - node.firstArrival;
}

DirectLight Tracer::sumDirectLight(const Level& level, const Node& node) const {
  return directLight(access_, node.hit, std::span(level.arrivals).subspan(node.firstArrival, node.arrivals),
                     std::span(level.visible).subspan(node.firstArrival, node.arrivals),
                     level.filters.empty() ? std::span<const WayFilter>()
                                           : std::span(level.filters).subspan(node.firstArrival, node.arrivals));
}

// Light of a ray from the light that arrived along the rays that leave its hit.
Light Tracer::finish(const Ray& ray, std::uint32_t depth, const Level& level, const Node& node) {
  const Hit& h = node.hit;
  if (node.step == Step::environment) {
    const Light sent = environmentLight(access_.scene.environment, ray.d);
    return parameters_.checkNumerics ? checked(ray, environmentHit(ray.d), depth, sent, {}) : sent;
  }
  if (node.step == Step::nothing) return unpolarized(dvec3(0));
  if (node.step == Step::interface || node.step == Step::facets) return finishInterface(ray, depth, level, node);
  const dvec3 medium = mediumTransmittance(ray, h);
  if (node.step == Step::emitter) return checked(ray, h, depth, scaled(emittedLight(h), medium), {});
  if (node.step == Step::diffuse)
    return checked(ray, h, depth, unpolarized(sumDirectLight(level, node).diffuse * medium), {});

  const pack::Material& m = *h.surface.material;
  const FrameRotation rotation = toSurface(h.d, f64::sDirection(h.d, glm::cross(h.face, m.axis)));
  const Light arriving = rotated(rotation, level.arrived[node.firstChild]);
  return checked(ray, h, depth, scaled(rotated(transposed(rotation), polarizingElementMatrix(m) * arriving), medium),
                 std::array<Light, 1>{arriving});
}

// Sums the outgoing light in the frame of the surface: diffuse light through the interface, the reflected mirror ray,
// the transmitted refracted ray. Then rotates it to the canonical frame of the ray.
Light Tracer::finishInterface(const Ray& ray, std::uint32_t depth, const Level& level, const Node& node) {
  const Hit& h = node.hit;
  const pack::Material& m = *h.surface.material;
  const dvec3 medium = mediumTransmittance(ray, h);
  const Interface interface = evaluateInterface(h.surface, h.c, node.refraction.n1, node.refraction.n2);
  const auto [diffuse, highlight] = sumDirectLight(level, node);
  const bool isClear = pack::isClear(m.kind);
  Light toCamera = isClear ? unpolarized(dvec3(0)) : interface.transmission * unpolarized(diffuse);
  const Light mirrored = unpolarized(highlight);
  const FrameRotation toRay = transposed(node.rotation);
  Light reflected{}, below{};  // that arrived from there
  if (node.step == Step::facets) {
    toCamera = rotated(toRay, toCamera + interface.reflection * mirrored);
    toCamera = scaled(toCamera + facetLight(level, node, reflected), medium);
    return checked(ray, h, depth, toCamera, std::array{unpolarized(diffuse), mirrored, reflected});
  }
  if (depth > 0) {
    reflected = rotated(toSurface(node.mirror, node.s), level.arrived[node.firstChild]);
    toCamera = toCamera + interface.reflection * (reflected + mirrored);
    if (isClear && !node.refraction.isTotal) {
      below = rotated(toSurface(node.refraction.direction, node.s), level.arrived[node.firstChild + 1]);
      toCamera = toCamera + interface.transmission * below;
    }
  }
  toCamera = scaled(rotated(toRay, toCamera), medium);
  if (!parameters_.checkNumerics) return toCamera;
  return checked(ray, h, depth, toCamera, std::array{unpolarized(diffuse), mirrored, reflected, below});
}

// Light that the facets of a rough surface reflect toward the camera, in the canonical frame of the ray. Each facet
// reflects in its own s-p frame.
Light Tracer::facetLight(const Level& level, const Node& node, Light& arrivedPart) const {
  const Hit& h = node.hit;
  Light sum = unpolarized(dvec3(0));
  for (std::uint32_t i = 0; i < node.facets; ++i) {
    const Facet& f = level.facets[node.firstFacet + i];
    const Light arriving = rotated(toSurface(f.mirror, f.s), level.arrived[node.firstChild + i]);
    arrivedPart = arrivedPart + scaled(arriving, dvec3(f.weight));
    const Interface interface = evaluateInterface(h.surface, f.c, node.refraction.n1, node.refraction.n2);
    sum = sum + scaled(rotated(transposed(toSurface(h.d, f.s)), interface.reflection * arriving), dvec3(f.weight));
  }
  return sum;
}

// Checks `sent` if --check-numerics asks for it. arriving: the light that arrives at the surface, each part in any
// frame; rounding adds up to 4 eps of it.
Light Tracer::checked(const Ray& ray, const Hit& h, std::uint32_t depth, const Light& sent,
                      std::span<const Light> arriving) {
  if (!parameters_.checkNumerics) return sent;
  constexpr double kBounce = 4 * std::numeric_limits<double>::epsilon();
  for (std::uint32_t c = 0; c < 3; ++c) {
    const dvec4& s = sent[c];
    double slack = kBounce * std::abs(s[0]);
    for (const Light& l : arriving) slack += std::max(excess(l[c]), 0.0) + kBounce * std::abs(l[c][0]);
    const bool finite = std::isfinite(s[0]) && std::isfinite(s[1]) && std::isfinite(s[2]) && std::isfinite(s[3]);
    const gpu::FaultKind kind = !finite             ? gpu::kNotFinite
                                : s[0] < -slack     ? gpu::kNegative
                                : excess(s) > slack ? gpu::kOverPolarized
                                                    : gpu::kNoFault;
    if (kind == gpu::kNoFault) continue;
    faults.note({kind, ray.pixelX, ray.pixelY, static_cast<int>(parameters_.depth - depth), h.materialIndex, c,
                 static_cast<float>(h.c), static_cast<float>(slack), h.position, h.d, h.normal, s},
                parameters_.width);
  }
  return sent;
}

}  // namespace malus::reference
