#include "bake/effects/polarizing_paths.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "bake/effects/mutual_visibility.h"
#include "bake/effects/query.h"

namespace malus::bake {
using pack::Material;

namespace {

std::string findPhaseShifters(const EffectQuery& q) {
  std::vector<const char*> names;
  if (q.any([](const Material& m) { return pack::isConductor(m.kind); })) names.push_back("metal");
  if (q.reflects() && q.any([&](const Material& m) { return hasDenserSide(q.scene, m); }))
    names.push_back("total reflection");
  if (q.any([](const Material& m) {
        return pack::isPolarizingElement(m.kind) && m.retardanceDegrees != glm::dvec3(0.0);
      }))
    names.push_back("wave plates");
  if (q.any(isCoated)) names.push_back("thin films");
  return q.reflects() ? fmt::format("{}", fmt::join(names, ", ")) : "";
}

}  // namespace

PolarizingPaths findPolarizingPaths(const EffectQuery& q) {
  PolarizingPaths p;
  p.interfaces = q.names([](const Material& m) { return pack::isInterface(m.kind); });
  p.polarizedEmitters = q.names(isPolarizedEmitter);
  p.phaseShifters = findPhaseShifters(q);
  p.polarizedSky = q.scene.environment.skyDegree > 0 && q.hasEnvironment();
  p.diffuseExit = q.any(
      [](const Material& m) { return pack::isInterface(m.kind) && (isDiffuseMaterial(m) || isPositive(m.radiance)); });
  if (!p.interfaces.empty()) {
    p.mutuallyVisible = interfacesMutuallyVisible(q.scene);
    p.interactions = p.mutuallyVisible ? q.request.depth : std::min(q.request.depth, 1u);
  }
  // A path ends at a source, which may be polarized, or with light that leaves from below an interface. Behind
  // another interface that light counts only if the two can be on one path.
  const bool endDiattenuates = p.hasPolarizedSources() || (p.diffuseExit && (p.mutuallyVisible || p.interactions == 0));
  p.diattenuators = p.interactions + (endDiattenuates ? 1u : 0u);
  // Light that is polarized when it enters a diffuse layer meets two diattenuators before that layer.
  p.polarizedEntry = q.lightsPolarized();
  return p;
}

}  // namespace malus::bake
