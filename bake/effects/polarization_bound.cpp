#include "bake/effects/polarization_bound.h"

#include <algorithm>
#include <cmath>

#include "bake/effects/mutual_sight.h"
#include "shaders/optics/optics.h"

namespace malus::bake {
using pack::MaterialKind;

namespace {

// Largest diattenuation of any interaction, and of diffuse light that leaves from below an interface.
struct Diattenuation {
  double interaction = 0, leaving = 0;
};
Diattenuation largest(const pack::Scene& scene, int colour) {
  Diattenuation result;
  const auto ratio = [](double a, double b) { return a + b > 0 ? std::abs(a - b) / (a + b) : 0; };
  for (const pack::Mesh& mesh : scene.meshes) {
    const pack::Material& m = scene.materials[mesh.material];
    if (m.kind == MaterialKind::lambert || m.kind == MaterialKind::emitter) continue;
    constexpr int kSteps = 2000;
    const auto look = [&](double n1, double n2, double k2, bool transmits) {
      for (int i = 0; i <= kSteps; ++i) {
        const double c = static_cast<double>(i) / kSteps;
        const f64::Reflectance r =
            k2 > 0 ? f64::conductorReflectance(c, n1, n2, k2) : f64::dielectricReflectance(c, n1, n2);
        result.interaction = std::max(result.interaction, ratio(r.rs, r.rp));
        if (transmits) result.interaction = std::max(result.interaction, ratio(1 - r.rs, 1 - r.rp));
        if (m.albedo[colour] > 0) result.leaving = std::max(result.leaving, ratio(1 - r.rs, 1 - r.rp));
      }
    };
    if (m.kind == MaterialKind::metal) {
      look(m.outsideEta, m.eta[colour], m.k[colour], false);
    } else {
      const bool glass = m.kind == MaterialKind::glass;
      look(m.outsideEta, m.eta.y, 0, glass);
      if (glass) look(m.eta.y, m.outsideEta, 0, true);
      // Between the steps lies Brewster's angle, where D is 1.
      if (m.eta.y != m.outsideEta) result.interaction = 1;
    }
  }
  return result;
}

}  // namespace

glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const PictureRequest& request) {
  const auto& a = request.analyser;
  const double filter = a[0] > 0 ? std::min(1.0, std::sqrt(a[1] * a[1] + a[2] * a[2] + a[3] * a[3]) / a[0]) : 0;
  const bool several = interfacesSeeEachOther(scene);
  glm::dvec3 bound(0.0);
  for (int colour = 0; colour < 3; ++colour) {
    const Diattenuation d = largest(scene, colour);
    double more = 1 + filter, less = 1 - filter;
    int elements = filter > 0 ? 1 : 0;
    const std::uint32_t interactions = several ? request.depth : std::min(request.depth, 1u);
    const auto add = [&](double diattenuation) {
      if (diattenuation <= 0) return;
      more *= 1 + diattenuation;
      less *= 1 - diattenuation;
      ++elements;
    };
    // Light that leaves from below an interface ends a path, behind other interfaces where they see each other; where
    // not, a path has one element: an interaction, or light that leaves.
    if (several) {
      for (std::uint32_t i = 0; i < interactions; ++i) add(d.interaction);
      add(d.leaving);
    } else {
      add(std::max(interactions > 0 ? d.interaction : 0, d.leaving));
    }
    if (elements > 1) bound[colour] = (more + less) / 2 - 1;
  }
  return bound;
}

}  // namespace malus::bake
