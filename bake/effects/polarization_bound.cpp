#include "bake/effects/polarization_bound.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "bake/effects/mutual_visibility.h"
#include "bake/effects/query.h"
#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

// Largest diattenuation of any interaction, and of diffuse light that leaves from below an interface; largest degree of
// polarization of a source.
struct Diattenuation {
  double interaction = 0, leaving = 0, source = 0;
};
Diattenuation largest(const pack::Scene& scene, int colour) {
  Diattenuation result;
  if (scene.environment.size > 0 || scene.environment.radiance[colour] > 0) result.source = scene.environment.skyDegree;
  const auto ratio = [](double a, double b) { return a + b > 0 ? std::abs(a - b) / (a + b) : 0; };
  for (const pack::Mesh& mesh : scene.meshes) {
    const pack::Material& m = scene.materials[mesh.material];
    if (pack::isEmitter(m.kind) && m.radiance[colour] > 0) result.source = std::max(result.source, m.polarization);
    if (!pack::isInterface(m.kind)) continue;
    if (pack::isPolarizingElement(m.kind)) {
      result.interaction =
          std::max(result.interaction, ratio(m.transmittanceParallel[colour], m.transmittanceCrossed[colour]));
      continue;
    }
    const bool leaves = m.albedo[colour] > 0 || m.radiance[colour] > 0 || m.meshMaps.albedo.isUsed();
    // Thin films and maps: their maximum is not bounded by samples.
    if (m.coating.thicknessNm > 0 || m.maps.eta >= 0 || m.meshMaps.eta.isUsed() || m.meshMaps.reflectance.isUsed()) {
      result.interaction = 1;
      if (leaves) result.leaving = 1;
      continue;
    }
    constexpr int kSteps = 2000;
    const auto addSamples = [&](double n1, double n2, double k2, bool transmits) {
      for (int i = 0; i <= kSteps; ++i) {
        const double c = static_cast<double>(i) / kSteps;
        const f64::Reflectance r =
            k2 > 0 ? f64::conductorReflectance(c, n1, n2, k2) : f64::dielectricReflectance(c, n1, n2);
        result.interaction = std::max(result.interaction, ratio(r.rs, r.rp));
        if (transmits) result.interaction = std::max(result.interaction, ratio(1 - r.rs, 1 - r.rp));
        if (leaves) result.leaving = std::max(result.leaving, ratio(1 - r.rs, 1 - r.rp));
      }
    };
    if (pack::isConductor(m.kind)) {
      addSamples(m.outsideEta, m.eta[colour], m.k[colour], false);
    } else {
      addSamples(m.outsideEta, m.eta.y, 0, pack::transmits(m.kind));
      if (pack::hasInside(m.kind)) addSamples(m.eta.y, m.outsideEta, 0, true);
      // At Brewster's angle, between two samples, D is 1.
      if (m.eta.y != m.outsideEta) result.interaction = 1;
    }
  }
  return result;
}

}  // namespace

glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const ImageRequest& request) {
  const auto& a = request.analyser;
  const double filter = a[0] > 0 ? std::min(1.0, std::sqrt(a[1] * a[1] + a[2] * a[2] + a[3] * a[3]) / a[0]) : 0;
  const bool several = interfacesMutuallyVisible(scene);
  const bool polarizedEntry = EffectQuery(scene, request).lightsPolarized();
  glm::dvec3 bound(0.0);
  for (int colour = 0; colour < 3; ++colour) {
    const Diattenuation d = largest(scene, colour);
    const auto worst = [&](std::initializer_list<std::pair<double, std::uint32_t>> elements) {
      double more = 1 + filter, less = 1 - filter;
      std::uint32_t count = filter > 0 ? 1 : 0;
      for (const auto& [diattenuation, times] : elements)
        for (std::uint32_t i = 0; i < times && diattenuation > 0; ++i) {
          more *= 1 + diattenuation;
          less *= 1 - diattenuation;
          ++count;
        }
      if (count > 1) bound[colour] = std::max(bound[colour], (more + less) / 2 - 1);
    };
    // A path ends with diffuse light from below an interface, or at a source. If interfaces are not mutually visible it
    // has one interaction, or diffuse light from below one.
    if (several) {
      worst({{d.interaction, request.depth}, {std::max(d.leaving, d.source), 1}});
    } else {
      worst({{d.leaving, 1}});
      worst({{d.interaction, std::min(request.depth, 1u)}, {d.source, 1}});
    }
    // Polarized light of lamps into a diffuse layer: its transmittance is between T_s and T_p.
    if (polarizedEntry) bound[colour] = (1 + bound[colour]) * (1 + d.leaving) - 1;
  }
  return bound;
}

}  // namespace malus::bake
