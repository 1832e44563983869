#include "render/reference/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render/scene/render_scene.h"

namespace malus::reference {

namespace {

// Bilinear lookup in a repeated texture; (0, 0) is the upper left corner.
dvec3 textureAt(const pack::Texture& t, double u, double v) {
  const double x = (u - std::floor(u)) * t.width - 0.5, y = (v - std::floor(v)) * t.height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  const auto texel = [&](double column, double row) {
    const auto wrapped = [](double at, std::uint32_t count) {
      const double n = count;
      return static_cast<std::size_t>(at < 0 ? at + n : at >= n ? at - n : at);
    };
    return dvec3(t.texels[wrapped(row, t.height) * t.width + wrapped(column, t.width)]);
  };
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

void applyMeshMaps(const pack::MeshMaps& maps, const MeshTextures& textures, const f64::TextureHit& at, Surface& s) {
  const auto apply = [&](const pack::MeshMap& map, dvec3& value) {
    if (map.isUsed()) value = textures.at(map, at);
  };
  apply(maps.albedo, s.albedo);
  apply(maps.eta, s.eta);
  apply(maps.k, s.k);
  apply(maps.radiance, s.radiance);
  apply(maps.transmittance, s.transmittance);
  if (maps.roughness.isUsed()) s.roughness = textures.at(maps.roughness, at).x;
  if (!maps.reflectance.isUsed()) return;
  const double tint = maps.metallic.isUsed() ? textures.at(maps.metallic, at).x : 1;
  const dvec3 reflectance = textures.at(maps.reflectance, at);
  for (int c = 0; c < 3; ++c) {
    const f64::ConductorIndex index =
        f64::conductorIndex(std::clamp(reflectance[c], f64::kLeastReflectance, f64::kMostReflectance), tint);
    s.eta[c] = index.eta;
    s.k[c] = index.k;
  }
}

}  // namespace

Surface plainSurface(const pack::Material& m, const dvec3& wavelengthsNm) {
  return {&m,          m.eta,
          m.k,         m.albedo,
          m.radiance,  m.transmittanceParallel,
          m.roughness, render::roundTripPhase(m.coating, wavelengthsNm)};
}

Surface surfaceAt(const Surface& plain, const pack::Scene& scene, const MeshTextures* textures, const dvec3& p,
                  const f64::TextureHit& at) {
  const pack::Material& m = *plain.material;
  Surface s = plain;
  const auto map = [&](std::int32_t texture) {
    const dvec3 from = p - m.maps.origin;
    return textureAt(scene.textures[static_cast<std::size_t>(texture)], glm::dot(from, m.maps.u),
                     glm::dot(from, m.maps.v));
  };
  if (m.maps.albedo >= 0) s.albedo *= map(m.maps.albedo);
  if (m.maps.eta >= 0) s.eta = map(m.maps.eta);
  if (m.maps.k >= 0) s.k = map(m.maps.k);
  if (textures != nullptr) applyMeshMaps(m.meshMaps, *textures, at, s);
  return s;
}

namespace {

InterfaceMatrix asMatrix(const f64::Reflectance& r) { return interfaceMatrix(r.rs, r.rp, r.xRe, r.xIm); }

f64::Film evaluateFilm(const Surface& surface, double c, double n1, double n2, int colour) {
  const pack::Coating& coating = surface.material->coating;
  const bool metal = pack::isConductor(surface.material->kind);
  return f64::thinFilm(c, n1, coating.eta[colour], surface.filmPhase[colour], metal ? surface.eta[colour] : n2,
                       metal ? surface.k[colour] : 0);
}

// Light that the interface of a share of the surface, or a clear coat on another share, changes.
bool isLayered(const pack::Material& m) { return m.specularFactor < 1 || m.clearCoat.factor > 0; }

// Without the layers.
Interface evaluateBase(const Surface& surface, double c, double n1, double n2) {
  const pack::Material& m = *surface.material;
  Interface result;
  const bool hasFilm = m.coating.thicknessNm > 0, isMetal = pack::isConductor(m.kind),
             isPane = m.kind == pack::MaterialKind::thinGlass;
  if (!hasFilm && !isMetal && !isPane) {  // the same for all colours
    const f64::RefractionTerms terms = f64::refractionTerms(c, n1, n2);
    const f64::Reflectance r = f64::reflectanceFromTerms(c, terms);
    result.reflection.fill(asMatrix(r));
    result.transmission.fill(interfaceMatrix(1 - r.rs, 1 - r.rp, f64::transmittanceFromTerms(c, terms).x, 0));
    return result;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const int colour = static_cast<int>(i);
    if (hasFilm) {
      const f64::Film film = evaluateFilm(surface, c, n1, n2, colour);
      result.reflection[i] = asMatrix(film.reflected);
      result.transmission[i] = interfaceMatrix(film.through.rs, film.through.rp, film.through.xRe, film.through.xIm);
    } else if (isPane) {
      const f64::ThinGlass pane = f64::thinGlass(c, n1, n2, surface.transmittance[colour]);
      result.reflection[i] = asMatrix(pane.reflected);
      result.transmission[i] = asMatrix(pane.transmitted);
    } else {
      const f64::Reflectance r = f64::conductorReflectance(c, n1, surface.eta[colour], surface.k[colour]);
      result.reflection[i] = asMatrix(r);
      result.transmission[i] = interfaceMatrix(1 - r.rs, 1 - r.rp, 0, 0);
    }
  }
  return result;
}

// Leaves the interface on a share of the surface.
void applySpecularFactor(const Surface& surface, double c, double n1, double n2, Interface& result) {
  const pack::Material& m = *surface.material;
  const f64::RefractionTerms terms = f64::refractionTerms(c, n1, n2);
  if (pack::isClear(m.kind) && terms.total) return;  // there is no refracted ray
  for (std::size_t i = 0; i < 3; ++i) {
    // The rest of a pane absorbs, and the rest of a metal lets unpolarized light of its diffuse layer pass.
    double open = 1;
    if (m.kind == pack::MaterialKind::thinGlass)
      open = f64::attenuation(f64::paneDepth(terms, surface.transmittance[static_cast<int>(i)]));
    result.reflection[i] = mix(result.reflection[i], {}, m.specularFactor);
    result.transmission[i] = mix(result.transmission[i], interfaceMatrix(open, open, open, 0), m.specularFactor);
  }
}

f64::ClearCoat evaluateClearCoat(const Surface& surface, double c, double n1, double n2, int colour) {
  const pack::Material& m = *surface.material;
  const double coat = m.clearCoat.eta, base = m.specularFactor;
  if (pack::isConductor(m.kind)) return f64::coatOnConductor(c, n1, coat, surface.eta[colour], surface.k[colour], base);
  const bool isEntering = n1 == m.outsideEta;
  return f64::coatOnDielectric(c, n1, coat, n2, isEntering ? 1 : base, isEntering ? base : 1);
}

void applyClearCoat(const Surface& surface, double c, double n1, double n2, Interface& result) {
  const pack::Material& m = *surface.material;
  for (std::size_t i = 0; i < 3; ++i) {
    f64::ClearCoat coat = evaluateClearCoat(surface, c, n1, n2, static_cast<int>(i));
    // Diffuse light of a layer below leaves with 1 - R.
    if (!pack::isClear(m.kind)) coat.transmitted = {1 - coat.reflected.rs, 1 - coat.reflected.rp, 0, 0};
    result.reflection[i] = mix(asMatrix(coat.reflected), result.reflection[i], m.clearCoat.factor);
    result.transmission[i] = mix(asMatrix(coat.transmitted), result.transmission[i], m.clearCoat.factor);
  }
}

}  // namespace

Interface evaluateInterface(const Surface& surface, double c, double n1, double n2) {
  const pack::Material& m = *surface.material;
  Interface result = evaluateBase(surface, c, n1, n2);
  if (m.specularFactor < 1) applySpecularFactor(surface, c, n1, n2, result);
  if (m.clearCoat.factor > 0) applyClearCoat(surface, c, n1, n2, result);
  if (pack::hasInside(m.kind) && surface.transmittance != dvec3(1))
    for (std::size_t i = 0; i < 3; ++i)
      result.transmission[i] = mix(result.transmission[i], {}, surface.transmittance[static_cast<int>(i)]);
  return result;
}

dvec3 meanTransmittance(const Surface& surface, double c, double n1, double n2) {
  const pack::Material& m = *surface.material;
  if (isLayered(m)) {
    const Mueller t = evaluateInterface(surface, c, n1, n2).transmission;
    return {t[0].a, t[1].a, t[2].a};
  }
  const auto mean = [](const f64::Reflectance& r) { return 1 - (r.rs + r.rp) / 2; };
  if (m.coating.thicknessNm > 0) {
    const auto ofColour = [&](int colour) { return mean(evaluateFilm(surface, c, n1, n2, colour).reflected); };
    return {ofColour(0), ofColour(1), ofColour(2)};
  }
  if (m.kind == pack::MaterialKind::thinGlass) {
    const auto ofColour = [&](int colour) {
      const f64::Reflectance t = f64::thinGlass(c, n1, n2, surface.transmittance[colour]).transmitted;
      return (t.rs + t.rp) / 2;
    };
    return {ofColour(0), ofColour(1), ofColour(2)};
  }
  if (!pack::isConductor(m.kind)) return dvec3(mean(f64::dielectricReflectance(c, n1, n2)));
  const auto ofColour = [&](int colour) {
    return mean(f64::conductorReflectance(c, n1, surface.eta[colour], surface.k[colour]));
  };
  return {ofColour(0), ofColour(1), ofColour(2)};
}

Mueller polarizingElementMatrix(const pack::Material& m) {
  Mueller result;
  for (std::size_t i = 0; i < 3; ++i) {
    const int colour = static_cast<int>(i);
    const double parallel = m.transmittanceParallel[colour], crossed = m.transmittanceCrossed[colour],
                 mean = std::sqrt(parallel * crossed),
                 retardance = m.retardanceDegrees[colour] * std::numbers::pi / 180;
    result[i] = interfaceMatrix(parallel, crossed, mean * std::cos(retardance), -mean * std::sin(retardance));
  }
  return result;
}

dvec3 transmittanceOver(const dvec3& absorption, double distance) {
  if (absorption == dvec3(0)) return dvec3(1);
  return glm::exp(-absorption * distance);
}

}  // namespace malus::reference
