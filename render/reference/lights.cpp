#include "render/reference/lights.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "render/reference/sampled_lights.h"

namespace malus::reference {

namespace {

dvec3 environmentIrradiance(const pack::Environment& e, const dvec3& n) {
  dvec3 result;
  const auto& c = e.irradiance;
  for (int i = 0; i < 3; ++i)
    result[i] =
        f64::irradiancePolynomial(n, c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]);
  return result;
}

bool isDiffuse(const Hit& h) {
  const dvec3& albedo = h.surface.albedo;
  return albedo.x > 0 || albedo.y > 0 || albedo.z > 0;
}

}  // namespace

dvec3 environmentRadiance(const pack::Environment& e, const dvec3& d) {
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

ShadowRay wayTo(const Hit& h, const dvec3& toLight) {
  const dvec3 offset = h.above - h.position, straight = toLight - offset;
  const dvec3 way = glm::dot(h.face, straight) <= glm::dot(h.face, offset) ? toLight : straight;
  const double length = glm::length(way);
  return {glm::vec3(h.above), glm::vec3(way / length), static_cast<float>(length)};
}

Light environmentLight(const pack::Environment& e, const dvec3& d) {
  if (!e.hasSun()) return unpolarized(environmentRadiance(e, d));
  const double cosine = glm::dot(d, e.sun);
  const dvec3 radiance = environmentRadiance(e, d) * (e.size == 0 ? f64::rayleighPhase(cosine) : 1.0);
  return rotated(transposed(toSurface(d, f64::sDirection(d, e.sun))),
                 polarized(radiance, f64::rayleighDegree(cosine, e.skyDegree)));
}

Light emittedLight(const Hit& h) {
  const pack::Material& m = *h.surface.material;
  const dvec3 radiance = h.outside || m.twoSided ? h.surface.radiance / (m.outsideEta * m.outsideEta) : dvec3(0);
  if (m.polarization == 0) return unpolarized(radiance);
  const dvec3 s = f64::sDirection(h.d, glm::cross(h.face, m.axis));
  return rotated(transposed(toSurface(h.d, s)), polarized(radiance, m.polarization));
}

void findArrivals(const SceneAccess& access, const Hit& h, bool hasHighlight, const dvec3& mirror, std::uint32_t path,
                  std::vector<Arrival>& arrivals, std::vector<ShadowRay>& ways) {
  const pack::Material& m = *h.surface.material;
  const bool diffuse = isDiffuse(h), glossy = m.highlightStrength > 0 && hasHighlight;
  if (diffuse) findSampledArrivals(access, h, path, arrivals, ways);
  if (access.scene.lights.empty() || (!diffuse && !glossy)) return;
  for (const pack::LightSource& light : access.scene.lights) {
    const bool isFar = light.kind == pack::LightKind::directional;
    const dvec3 toLight = isFar ? -light.direction * access.lightReach : light.position - h.position;
    const double distance = glm::length(toLight);
    if (!(distance > 0)) continue;  // a light in the hit has no direction
    const dvec3 l = toLight / distance;
    const double cosine = glm::dot(h.normal, l);
    if (cosine <= 0 || glm::dot(h.face, l) <= 0) continue;
    const double lobe = glossy ? m.highlightStrength * f64::phongLobe(mirror, l, m.highlightExponent) : 0;
    if (!diffuse && lobe <= 0) continue;
    const auto number = static_cast<std::size_t>(&light - access.scene.lights.data());
    const pack::SpotFalloff& falloff = access.falloffs[number];
    const double cone = std::clamp(-glm::dot(light.direction, l) * falloff.scale + falloff.offset, 0.0, 1.0);
    if (cone == 0) continue;
    arrivals.push_back({l, cosine, lobe, light.intensity * (isFar ? 1 : cone * cone / (distance * distance)),
                        isFar ? 0 : distance, l, 0, "light", number});
    ways.push_back(wayTo(h, toLight));
  }
}

namespace {

// Transmittance of the interface above a diffuse layer for unpolarized light at a cosine of incidence.
dvec3 enteringTransmittance(const Hit& h, double cosine) {
  const pack::Material& m = *h.surface.material;
  if (!pack::hasIndex(m.kind)) return dvec3(1);
  return meanTransmittance(h.surface, cosine, m.outsideEta, h.surface.eta.y);
}

// Irradiance behind that interface of light in the canonical frame of a ray toward the light: A_T S0 + B_T S1 in the
// plane of incidence.
dvec3 entering(const Hit& h, const Arrival& a, const Light& light) {
  const pack::Material& m = *h.surface.material;
  if (!pack::hasIndex(m.kind)) return {light[0][0], light[1][0], light[2][0]};
  const Interface interface = evaluateInterface(h.surface, std::min(a.cosine, 1.0), m.outsideEta, h.surface.eta.y);
  const Light below =
      interface.transmission * rotated(toSurface(a.direction, f64::sDirection(a.direction, h.normal)), light);
  return {below[0][0], below[1][0], below[2][0]};
}

// Light of a lamp in the canonical frame of a ray toward it.
Light lampLight(const Arrival& a, const dvec3& irradiance) {
  if (a.degree == 0) return unpolarized(irradiance);
  return rotated(transposed(toSurface(a.direction, f64::sDirection(a.direction, a.field))),
                 polarized(irradiance, a.degree));
}

}  // namespace

DirectLight directLight(const SceneAccess& access, const Hit& h, std::span<const Arrival> arrivals,
                        std::span<const std::uint8_t> visible, std::span<const WayFilter> filters) {
  const pack::Material& m = *h.surface.material;
  const pack::Environment& environment = access.scene.environment;
  const dvec3& albedo = h.surface.albedo;
  const bool diffuse = isDiffuse(h);
  DirectLight sum{dvec3(0), dvec3(0)};
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    if (visible[i] == 0) continue;
    const Arrival& a = arrivals[i];
    const dvec3 arriving = a.irradiance * transmittanceOver(absorptionAt(h), a.absorbedOver);
    if (filters.empty() && a.degree == 0) {
      if (diffuse)
        sum.diffuse +=
            f64::lambertRadiance(albedo, arriving * a.cosine, enteringTransmittance(h, std::min(a.cosine, 1.0)));
      sum.highlight += arriving * a.lobe;
      continue;
    }
    Light light = lampLight(a, arriving);
    if (!filters.empty()) light = filters[i] * light;
    if (diffuse) sum.diffuse += f64::lambertRadiance(albedo, entering(h, a, light) * a.cosine, dvec3(1));
    sum.highlight += dvec3(light[0][0], light[1][0], light[2][0]) * a.lobe;
  }
  if (diffuse && environment.ambientIrradiance > 0 && !environment.illuminates)
    sum.diffuse +=
        f64::lambertRadiance(albedo, environmentIrradiance(environment, h.normal) * environment.ambientIrradiance,
                             access.hemisphereTransmittance[h.materialIndex]);
  const double basic = 1 / (m.outsideEta * m.outsideEta);
  sum.diffuse += h.surface.radiance;  // of the layer itself
  return {sum.diffuse * basic, sum.highlight * basic};
}

}  // namespace malus::reference
