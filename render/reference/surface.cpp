#include "render/reference/surface.h"

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

}  // namespace

Surface surfaceAt(const pack::Scene& scene, std::uint32_t index, const dvec3& p) {
  const pack::Material& m = scene.materials[index];
  Surface s{&m, m.eta, m.k, m.albedo};
  const auto map = [&](std::int32_t texture) {
    const dvec3 from = p - m.maps.origin;
    return textureAt(scene.textures[static_cast<std::size_t>(texture)], glm::dot(from, m.maps.u),
                     glm::dot(from, m.maps.v));
  };
  if (m.maps.albedo >= 0) s.albedo *= map(m.maps.albedo);
  if (m.maps.eta >= 0) s.eta = map(m.maps.eta);
  if (m.maps.k >= 0) s.k = map(m.maps.k);
  return s;
}

Interface evaluateInterface(const Surface& surface, double c, double n1, double n2) {
  const pack::Material& m = *surface.material;
  Interface result;
  for (std::size_t i = 0; i < 3; ++i) {
    const int colour = static_cast<int>(i);
    const bool metal = pack::isConductor(m.kind);
    const double n3 = metal ? surface.eta[colour] : n2, k3 = metal ? surface.k[colour] : 0;
    if (m.coating.thicknessNm > 0) {
      const f64::Film film =
          f64::thinFilm(c, n1, m.coating.eta[colour], render::roundTripPhase(m.coating)[colour], n3, k3);
      result.reflection[i] =
          interfaceMatrix(film.reflected.rs, film.reflected.rp, film.reflected.xRe, film.reflected.xIm);
      result.transmission[i] = interfaceMatrix(film.through.rs, film.through.rp, film.through.xRe, film.through.xIm);
      result.meanTransmittance[colour] = 1 - (film.reflected.rs + film.reflected.rp) / 2;
      continue;
    }
    if (m.kind == pack::MaterialKind::thinGlass) {
      const f64::ThinGlass pane = f64::thinGlass(c, n1, n2, m.transmittanceParallel[colour]);
      const f64::Reflectance &back = pane.reflected, &through = pane.transmitted;
      result.reflection[i] = interfaceMatrix(back.rs, back.rp, back.xRe, back.xIm);
      result.transmission[i] = interfaceMatrix(through.rs, through.rp, through.xRe, through.xIm);
      result.meanTransmittance[colour] = (through.rs + through.rp) / 2;
      continue;
    }
    const f64::Reflectance r = metal ? f64::conductorReflectance(c, n1, n3, k3) : f64::dielectricReflectance(c, n1, n2);
    const double cross = metal ? 0 : f64::dielectricTransmittance(c, n1, n2).x;
    result.reflection[i] = interfaceMatrix(r.rs, r.rp, r.xRe, r.xIm);
    result.transmission[i] = interfaceMatrix(1 - r.rs, 1 - r.rp, cross, 0);
    result.meanTransmittance[colour] = 1 - (r.rs + r.rp) / 2;
  }
  return result;
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

dvec3 transmittanceOver(const dvec3& absorption, double distance) { return glm::exp(-absorption * distance); }

}  // namespace malus::reference
