#include "render/reference/renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "render/embree/embree.h"
#include "render/reference/depth_paths.h"
#include "render/reference/surface.h"
#include "render/scene/render_scene.h"
#include "shaders/optics/optics.h"

namespace malus::reference {

namespace {

using Clock = std::chrono::steady_clock;

double sinceMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Tracer {
  const pack::Scene& scene;
  const embree::Bvh& bvh;
  const std::vector<std::uint32_t>& sourceMeshes;     // per mesh of bvh
  const std::vector<dvec3>& hemisphereTransmittance;  // per material
  const render::RenderParameters& parameters;
  std::uint64_t rays = 0;
  std::uint32_t pixelX = 0, pixelY = 0;  // the current pixel
  render::Faults faults{};

  // A hit on the triangle that Embree returns, its position recomputed in double precision.
  struct Hit {
    dvec3 d, position, start, error, face, normal;
    double c, travelled;
    bool outside;
    Surface surface;
    std::uint32_t materialIndex;
  };

  bool intersect(const dvec3& origin, const dvec3& queryOrigin, const dvec3& d, Hit& hit) {
    ++rays;
    const embree::Intersection at = bvh.nearest(glm::vec3(queryOrigin), glm::vec3(d));
    if (at.mesh == embree::Intersection::kMiss) return false;
    const pack::Mesh& mesh = scene.meshes[sourceMeshes[at.mesh]];
    const glm::uvec3 t = mesh.triangles[at.triangle];
    const dvec3 p0(mesh.positions[t.x]), p1(mesh.positions[t.y]), p2(mesh.positions[t.z]);
    const dvec3 e1 = p1 - p0, e2 = p2 - p0, across = glm::cross(e1, e2);
    const double area2 = glm::length(across);
    hit.d = d;
    hit.materialIndex = mesh.material;
    hit.face = area2 > 0 ? across / area2 : -d;

    // Intersect the ray with the plane of the triangle; barycentric coordinates from signed areas.
    double b1 = at.b1, b2 = at.b2;
    const double slope = glm::dot(d, hit.face);
    if (area2 > 0 && slope != 0) {
      const dvec3 q = origin + d * (glm::dot(p0 - origin, hit.face) / slope);
      const double u = glm::dot(glm::cross(p0 - p2, q - p2), hit.face) / area2;
      const double v = glm::dot(glm::cross(p1 - p0, q - p0), hit.face) / area2;
      // At grazing incidence the single-precision hit is more accurate.
      if (std::abs(u - b1) < 1e-2 && std::abs(v - b2) < 1e-2) b1 = u, b2 = v;
    }
    const double b0 = 1 - b1 - b2;
    hit.position = f64::trianglePoint(p0, e1, e2, b1, b2);
    hit.travelled = glm::length(hit.position - origin);
    hit.surface = surfaceAt(scene, mesh.material, hit.position);
    // The next query is in single precision.
    const dvec3& o = mesh.origin;
    hit.error = f64::hitPointError(p0 - o, e1, e2, b1, b2, 0x1p-24) + f64::originError(o, 0x1p-24) +
                f64::intersectionError(p0, p1, p2, hit.position, 0x1p-24);
    hit.start = f64::insideTriangle(hit.position, p0, p1, p2, b0, b1, b2, across, 4 * f64::largestPart(hit.error));
    hit.outside = glm::dot(d, hit.face) < 0;
    const dvec3 interpolated = mesh.normals.empty() ? hit.face
                                                    : dvec3(mesh.normals[t.x]) * b0 + dvec3(mesh.normals[t.y]) * b1 +
                                                          dvec3(mesh.normals[t.z]) * b2;
    hit.normal = f64::shadingNormal(d, hit.face, glm::length(interpolated) > 0 ? interpolated : hit.face);
    if (!hit.outside) hit.face = -hit.face;
    hit.c = f64::clampUnit(-glm::dot(d, hit.normal));
    return true;
  }

  dvec3 queryAbove(const Hit& h) const { return f64::rayOrigin(h.start, h.error, h.face, 0x1p-24); }
  dvec3 queryBelow(const Hit& h) const { return f64::rayOrigin(h.start, h.error, -h.face, 0x1p-24); }

  dvec3 environment(const dvec3& d) const {
    const pack::Environment& e = scene.environment;
    if (e.size == 0) return e.radiance;
    double u, v;
    f64::octahedralFromDirection(d, u, v);
    const double x = u * e.size + 0.5, y = v * e.size + 0.5;
    const auto ix = std::min(static_cast<std::size_t>(x), std::size_t{e.size}),
               iy = std::min(static_cast<std::size_t>(y), std::size_t{e.size});
    const double fx = x - static_cast<double>(ix), fy = y - static_cast<double>(iy);
    const std::size_t row = e.size + 2, at = iy * row + ix;
    const auto texel = [&](std::size_t i) { return dvec3(e.texels[i]); };
    return (texel(at) * (1 - fx) + texel(at + 1) * fx) * (1 - fy) +
           (texel(at + row) * (1 - fx) + texel(at + row + 1) * fx) * fy;
  }

  dvec3 environmentIrradiance(const dvec3& n) const {
    dvec3 result;
    const auto& c = scene.environment.irradiance;
    for (int i = 0; i < 3; ++i)
      result[i] =
          f64::irradiancePolynomial(n, c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]);
    return result;
  }

  // Light from the environment along -d: S1 is perpendicular to the plane of d and the sun.
  Light environmentLight(const dvec3& d) const {
    const pack::Environment& e = scene.environment;
    if (!e.hasSun()) return unpolarized(environment(d));
    const double cosine = glm::dot(d, e.sun);
    const dvec3 radiance = environment(d) * (e.size == 0 ? f64::rayleighPhase(cosine) : 1.0);
    return rotated(glm::transpose(toSurface(d, f64::sDirection(d, e.sun))),
                   polarized(radiance, f64::rayleighDegree(cosine, e.skyDegree)));
  }

  // Light of the emitter at a hit along -d, as basic radiance.
  static Light emittedLight(const Hit& h) {
    const pack::Material& m = *h.surface.material;
    const dvec3 radiance = h.outside || m.twoSided ? m.radiance / (m.outsideEta * m.outsideEta) : dvec3(0);
    if (m.polarization == 0) return unpolarized(radiance);
    const dvec3 s = f64::sDirection(h.d, glm::cross(h.face, m.axis));
    return rotated(glm::transpose(toSurface(h.d, s)), polarized(radiance, m.polarization));
  }

  // Indices on this side and beyond, and the transmitted ray. Replaces a shading normal by that of the face if the ray
  // would not pass the face.
  struct Refraction {
    double n1, n2;
    dvec3 direction;
    bool isTotal;
  };
  static Refraction refractionAt(Hit& h) {
    const pack::Material& m = *h.surface.material;
    const bool isBody = pack::hasInside(m.kind), entersOutside = isBody && !h.outside;
    const double inside = h.surface.eta.y;
    Refraction r{entersOutside ? inside : m.outsideEta, entersOutside ? m.outsideEta : inside, h.d, false};
    const auto refract = [&] {
      r.direction = f64::refractedDirection(h.d, h.normal, h.c, r.n1, r.n2);
      r.isTotal = f64::refractionTerms(h.c, r.n1, r.n2).total;
    };
    if (!isBody) return r;
    refract();
    if (!r.isTotal && glm::dot(r.direction, h.face) >= 0) {
      h.normal = h.face;
      h.c = f64::clampUnit(-glm::dot(h.d, h.face));
      refract();
    }
    return r;
  }

  // Absorption of the medium on the side of the ray, in 1/m.
  static dvec3 absorptionAt(const Hit& h) {
    const pack::Material& m = *h.surface.material;
    return pack::hasInside(m.kind) && !h.outside ? m.absorption : m.outsideAbsorption;
  }

  // Whether no surface blocks the light. The ray starts outside the hit's error box and ends at the light; closer to
  // the face than twice the box it is parallel to the way from the hit to the light, so that it cannot meet the face.
  bool lightVisible(const Hit& h, const dvec3& toLight) {
    ++rays;
    const dvec3 origin = queryAbove(h), offset = origin - h.position, straight = toLight - offset;
    const dvec3 way = glm::dot(h.face, straight) <= glm::dot(h.face, offset) ? toLight : straight;
    const double length = glm::length(way);
    return bvh.visible(glm::vec3(origin), glm::vec3(way / length), static_cast<float>(length));
  }

  // Diffuse radiance below the interface, and highlight radiance along the mirror direction.
  void directLight(const Hit& h, std::uint32_t depth, const dvec3& mirror, dvec3& diffuse, dvec3& highlight) {
    const pack::Material& m = *h.surface.material;
    const dvec3& albedo = h.surface.albedo;
    diffuse = highlight = dvec3(0);
    const bool isDiffuse = albedo.x > 0 || albedo.y > 0 || albedo.z > 0,
               isGlossy = m.highlightStrength > 0 && depth > 0;
    if (!isDiffuse && !isGlossy) return;
    for (const pack::PointLight& light : scene.lights) {
      const dvec3 toLight = light.position - h.position;
      const double distance = glm::length(toLight);
      if (!(distance > 0)) continue;  // a light in the hit has no direction
      const dvec3 l = toLight / distance;
      const double c = glm::dot(h.normal, l);
      if (c <= 0 || glm::dot(h.face, l) <= 0) continue;
      const double lobe = isGlossy ? m.highlightStrength * f64::phongLobe(mirror, l, m.highlightExponent) : 0;
      if (!isDiffuse && lobe <= 0) continue;
      if (parameters.shadows && !lightVisible(h, toLight)) continue;
      const dvec3 arriving = light.intensity / (distance * distance) * transmittanceOver(absorptionAt(h), distance);
      const dvec3 entering =
          !pack::hasIndex(m.kind)
              ? dvec3(1)
              : evaluateInterface(h.surface, std::min(c, 1.0), m.outsideEta, h.surface.eta.y).meanTransmittance;
      if (isDiffuse) diffuse += f64::lambertRadiance(albedo, arriving * c, entering);
      highlight += arriving * lobe;
    }
    if (isDiffuse && scene.environment.ambientIrradiance > 0)
      diffuse += f64::lambertRadiance(albedo, environmentIrradiance(h.normal) * scene.environment.ambientIrradiance,
                                      hemisphereTransmittance[h.materialIndex]);
    const double basic = 1 / (m.outsideEta * m.outsideEta);
    diffuse *= basic;
    highlight *= basic;
  }

  // |(S1, S2, S3)| - S0.
  static double excess(const dvec4& s) { return glm::length(dvec3(s[1], s[2], s[3])) - s[0]; }

  // Checks `sent` if --check-numerics asks for it. arriving: the light that arrives at the surface, each part in any
  // frame; rounding adds up to 4 eps of it.
  Light checked(const Hit& h, std::uint32_t depth, const Light& sent, std::span<const Light> arriving) {
    if (!parameters.checkNumerics) return sent;
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
      faults.note({kind, pixelX, pixelY, static_cast<int>(parameters.depth - depth), h.materialIndex, c,
                   static_cast<float>(h.c), static_cast<float>(slack), h.position, h.d, h.normal, s},
                  parameters.width);
    }
    return sent;
  }

  // Light that the facets of a rough surface reflect toward the camera, in the canonical frame of the ray. Each facet
  // reflects in its own s-p frame.
  Light facetLight(const Hit& h, double n1, double n2, std::uint32_t depth, Light& arrivedPart) {
    const double alpha = h.surface.material->roughness;
    Light sum = unpolarized(dvec3(0));
    for (std::size_t i = 0; i < gpu::kFacets; ++i) {
      const glm::dvec2 point = render::facetPoint(i);
      const dvec3 normal = f64::facetNormal(-h.d, h.normal, alpha, point.x, point.y);
      const double c = f64::clampUnit(-glm::dot(h.d, normal));
      const dvec3 mirror = f64::mirrorDirection(h.d, normal, c);
      const double weight = f64::facetWeight(-h.d, mirror, h.normal, alpha) / gpu::kFacets;
      if (weight <= 0 || glm::dot(mirror, h.face) <= 0) continue;
      const dvec3 s = f64::sDirection(h.d, normal);
      const Light arriving = rotated(toSurface(mirror, s), trace(h.position, queryAbove(h), mirror, depth - 1, true));
      arrivedPart = arrivedPart + scaled(arriving, dvec3(weight));
      sum = sum + scaled(rotated(glm::transpose(toSurface(h.d, s)),
                                 evaluateInterface(h.surface, c, n1, n2).reflection * arriving),
                         dvec3(weight));
    }
    return sum;
  }

  // Light that arrives along -d, in the canonical frame of the ray, as basic radiance. behindRough: the path has met a
  // rough surface; further ones are treated as smooth.
  Light trace(const dvec3& origin, const dvec3& queryOrigin, const dvec3& d, std::uint32_t depth,
              bool behindRough = false) {
    Hit h{};
    h.d = d;
    h.materialIndex = gpu::kEnvironment;
    if (!intersect(origin, queryOrigin, d, h)) return checked(h, depth, environmentLight(d), {});
    const pack::Material& m = *h.surface.material;
    const dvec3 medium = transmittanceOver(absorptionAt(h), h.travelled);

    // Handle surfaces without an interface.
    if (pack::isEmitter(m.kind)) {
      return checked(h, depth, scaled(emittedLight(h), medium), {});
    }
    dvec3 diffuse, highlight;
    if (!pack::isInterface(m.kind)) {
      directLight(h, depth, h.normal, diffuse, highlight);
      return checked(h, depth, unpolarized(diffuse * medium), {});
    }

    // Handle polarizing elements: the ray continues straight on.
    if (pack::isPolarizingElement(m.kind)) {
      if (depth == 0) return unpolarized(dvec3(0));
      const dmat4 rotation = toSurface(d, f64::sDirection(d, glm::cross(h.face, m.axis)));
      const Light arriving = rotated(rotation, trace(h.position, queryBelow(h), d, depth - 1, behindRough));
      return checked(h, depth, scaled(rotated(glm::transpose(rotation), polarizingElementMatrix(m) * arriving), medium),
                     std::array<Light, 1>{arriving});
    }

    // Handle interfaces, from the index on this side to the index beyond.
    const bool clear = pack::isClear(m.kind);
    if (clear && depth == 0) return unpolarized(dvec3(0));
    const auto [n1, n2, refracted, total] = refractionAt(h);
    const Interface interface = evaluateInterface(h.surface, h.c, n1, n2);
    const dvec3 mirror = f64::mirrorDirection(d, h.normal, h.c);
    const dvec3 s = f64::sDirection(d, h.normal);  // the same for all three rays
    directLight(h, depth, mirror, diffuse, highlight);

    // Sum the outgoing light in the frame of the surface: diffuse light through the interface, the reflected mirror
    // ray, the transmitted refracted ray. Then rotate it to the canonical frame of the ray.
    Light toCamera = clear ? unpolarized(dvec3(0)) : interface.transmission * unpolarized(diffuse);
    std::array<Light, 4> parts = {unpolarized(diffuse), unpolarized(highlight), Light{}, Light{}};
    const dmat4 toRay = glm::transpose(toSurface(d, s));
    if (m.roughness > 0 && !behindRough && depth > 0) {
      toCamera = rotated(toRay, toCamera + interface.reflection * unpolarized(highlight));
      return checked(h, depth, scaled(toCamera + facetLight(h, n1, n2, depth, parts[2]), medium), parts);
    }
    if (depth > 0) {
      const Light arriving =
          rotated(toSurface(mirror, s), trace(h.position, queryAbove(h), mirror, depth - 1, behindRough));
      parts[2] = arriving;
      toCamera = toCamera + interface.reflection * (arriving + unpolarized(highlight));
      if (clear && !total) {
        const Light below =
            rotated(toSurface(refracted, s), trace(h.position, queryBelow(h), refracted, depth - 1, behindRough));
        toCamera = toCamera + interface.transmission * below;
        parts[3] = below;
      }
    }
    return checked(h, depth, scaled(rotated(toRay, toCamera), medium), parts);
  }
};

}  // namespace

struct Renderer::Impl {
  Impl(const pack::Scene& source, unsigned threadCount) : Impl(source, render::makeRenderScene(source), threadCount) {}

  Impl(const pack::Scene& source, render::RenderScene&& renderScene, unsigned threadCount)
      : scene(source),
        threads(threadCount),
        bvh(renderScene, threadCount),
        sourceMeshes(std::move(renderScene.sourceMeshes)) {
    for (const pack::Material& m : source.materials)
      hemisphereTransmittance.push_back(render::hemisphereTransmittance(m));
  }

  const pack::Scene& scene;
  unsigned threads;
  embree::Bvh bvh;
  std::vector<std::uint32_t> sourceMeshes;
  std::vector<dvec3> hemisphereTransmittance;  // per material
  double buildMs = 0;
};

Renderer::Renderer(const pack::Scene& scene, unsigned threads) {
  const auto start = Clock::now();
  impl_ = std::make_unique<Impl>(scene, threads);
  impl_->buildMs = sinceMs(start);
}

Renderer::~Renderer() = default;

std::string Renderer::device() const { return fmt::format("double precision on {}", embree::Bvh::version()); }

render::RenderResult Renderer::render(std::string_view /*method*/, const render::RenderParameters& parameters) {
  const pack::Scene& scene = impl_->scene;
  const auto start = Clock::now();
  render::RenderResult result;
  result.width = parameters.region.width;
  result.height = parameters.region.height;
  result.channels = render::kStokesChannels;
  result.pixels.resize(result.channels * result.width * result.height);
  result.device = device();
  const pack::Camera& camera = scene.camera;
  const double tanY = std::tan(camera.verticalFovDegrees / 360 * std::numbers::pi),
               tanX = tanY * parameters.width / parameters.height;
  const double toRadiance = camera.mediumEta * camera.mediumEta;
  std::atomic<std::uint64_t> rays{0};
  std::mutex merging;

  const auto row = [&](std::uint32_t y) {
    Tracer tracer{scene, impl_->bvh, impl_->sourceMeshes, impl_->hemisphereTransmittance, parameters};
    for (std::uint32_t x = 0; x < parameters.region.width; ++x) {
      tracer.pixelX = parameters.region.x + x;
      tracer.pixelY = parameters.region.y + y;
      Light sum = unpolarized(dvec3(0));
      for (std::uint32_t j = 0; j < parameters.samples; ++j)
        for (std::uint32_t i = 0; i < parameters.samples; ++i) {
          const double px = (parameters.region.x + x + (i + 0.5) / parameters.samples) / parameters.width;
          const double py = (parameters.region.y + y + (j + 0.5) / parameters.samples) / parameters.height;
          const dvec3 d = f64::cameraDirection(camera.right, camera.up, camera.forward, tanX, tanY, px, py);
          // The camera frame of this ray: x is the s direction of a surface whose normal is `up`.
          sum = sum + rotated(toSurface(d, f64::sDirection(d, camera.up)),
                              tracer.trace(camera.position, camera.position, d, parameters.depth));
        }
      float* out = result.pixels.data() + (std::size_t{y} * parameters.region.width + x) * result.channels;
      const double scale = toRadiance / (static_cast<double>(parameters.samples) * parameters.samples);
      for (std::size_t c = 0; c < 3; ++c) {
        const dvec4 s = sum[c] * scale;
        out[c] = static_cast<float>(s[0] * parameters.analyser[0] + s[1] * parameters.analyser[1] +
                                    s[2] * parameters.analyser[2] + s[3] * parameters.analyser[3]);
        for (std::size_t k = 0; k < 4; ++k) out[3 + 3 * k + c] = static_cast<float>(s[static_cast<int>(k)]);
      }
    }
    rays += tracer.rays;
    const std::scoped_lock lock(merging);
    result.faults.add(tracer.faults, parameters.width);
  };
  const auto traceAll = [&] { tbb::parallel_for(std::uint32_t{0}, parameters.region.height, row); };
  if (impl_->threads == 0)
    traceAll();
  else
    tbb::task_arena(static_cast<int>(impl_->threads)).execute(traceAll);

  result.cost.buildMs = impl_->buildMs;
  result.cost.traceMs = result.cost.wallMs = sinceMs(start);
  result.cost.rays = rays;
  return result;
}

bake::DepthProbe Renderer::probeDepth() {
  const auto start = Clock::now();
  constexpr std::uint32_t kSide = 32;
  const pack::Scene& scene = impl_->scene;
  const render::RenderParameters parameters = render::defaultParameters(scene);
  const std::uint32_t height = std::clamp(kSide * scene.height / scene.width, 1u, kSide);
  const double tanY = std::tan(scene.camera.verticalFovDegrees / 360 * std::numbers::pi),
               tanX = tanY * scene.width / scene.height;
  struct Row {
    std::vector<double> energy;
    std::vector<bool> darkBacks;
    std::uint64_t rays, unfollowed;
  };
  std::vector<Row> rows(height);
  tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
    Tracer tracer{scene, impl_->bvh, impl_->sourceMeshes, impl_->hemisphereTransmittance, parameters};
    DepthPaths paths(tracer);
    for (std::uint32_t x = 0; x < kSide; ++x)
      paths.followPixel(scene.camera.position,
                        f64::cameraDirection(scene.camera.right, scene.camera.up, scene.camera.forward, tanX, tanY,
                                             (x + 0.5) / kSide, (y + 0.5) / height));
    rows[y] = {paths.energy, paths.darkBacks, tracer.rays, paths.unfollowed};
  });

  // Add up in the order of the rows, so that the sums do not depend on the threads.
  bake::DepthProbe probe;
  std::vector<double> energy(rows[0].energy.size());
  std::vector<bool> darkBacks(scene.materials.size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < energy.size(); ++i) energy[i] += row.energy[i];
    for (std::size_t i = 0; i < darkBacks.size(); ++i) darkBacks[i] = darkBacks[i] || row.darkBacks[i];
    probe.rays += row.rays;
    probe.unfollowed += row.unfollowed;
  }
  probe.beyond = sharesBeyond(energy);
  for (std::uint32_t i = 0; i < darkBacks.size(); ++i)
    if (darkBacks[i] && scene.materials[i].radiance != dvec3(0.0)) probe.darkEmitters.push_back(i);
  probe.milliseconds = sinceMs(start);
  return probe;
}

render::RenderResult render(const pack::Scene& scene, const render::RenderParameters& parameters, unsigned threads) {
  return Renderer(scene, threads).render("", parameters);
}

}  // namespace malus::reference
