#include "bake/effects/query.h"

#include <algorithm>

#include <fmt/format.h>

#include "bake/effects/light_visibility.h"

namespace malus::bake {
using pack::Material;

EffectQuery::EffectQuery(const pack::Scene& queriedScene, const ImageRequest& queriedRequest)
    : scene(queriedScene), request(queriedRequest) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const pack::Mesh& mesh : scene.meshes) used[mesh.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) used_.push_back(&scene.materials[i]);
}

bool EffectQuery::any(const Predicate& predicate) const {
  return std::any_of(used_.begin(), used_.end(), [&](const Material* m) { return predicate(*m); });
}

std::string EffectQuery::names(const Predicate& predicate) const {
  std::vector<std::string_view> names;
  for (const Material* m : used_)
    if (predicate(*m)) names.emplace_back(m->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const PolarizingPaths& EffectQuery::paths() const {
  if (!paths_) paths_ = findPolarizingPaths(*this);
  return *paths_;
}

bool EffectQuery::isDiffuse() const { return any(isDiffuseMaterial); }

bool EffectQuery::hasHighlights() const {
  return reflects() && !scene.lights.empty() && any([](const Material& m) { return m.highlightStrength > 0; });
}

bool EffectQuery::isLitByPointLights() const { return !scene.lights.empty() && (isDiffuse() || hasHighlights()); }

bool EffectQuery::isLitByAreaLights() const {
  if (!litByAreaLights_) litByAreaLights_ = isDiffuse() && any(isAreaLight) && emittersSeeDiffuseSurfaces(scene);
  return *litByAreaLights_;
}

bool EffectQuery::isLitByEnvironment() const {
  return scene.environment.illuminates && hasEnvironment() && isDiffuse();
}

bool EffectQuery::filtersLight() const { return any(isThinAndTransmits) && isLit(); }

bool EffectQuery::lightsPolarized() const {
  if (!any([](const Material& m) { return pack::hasIndex(m.kind) && isDiffuseMaterial(m); })) return false;
  return filtersLight() || (isLitByEnvironment() && scene.environment.skyDegree > 0) ||
         (isLitByAreaLights() && any([](const Material& m) { return isAreaLight(m) && isPolarizedEmitter(m); }));
}

bool isAreaLight(const Material& m) { return pack::isEmitter(m.kind) && m.illuminates && isPositive(m.radiance); }

bool isThinAndTransmits(const Material& m) { return pack::transmits(m.kind) && !pack::hasInside(m.kind); }

bool isPolarizedEmitter(const Material& m) {
  return pack::isEmitter(m.kind) && m.polarization > 0 && isPositive(m.radiance);
}

bool isCoated(const Material& m) { return m.coating.thicknessNm > 0; }
bool hasClearCoat(const Material& m) { return m.clearCoat.factor > 0; }

bool hasDenserSide(const pack::Scene& scene, const Material& m) {
  if (hasClearCoat(m) && m.clearCoat.eta < m.outsideEta) return true;
  if (pack::hasInside(m.kind)) return m.eta.y != m.outsideEta;
  if (!pack::isDielectric(m.kind)) return false;
  double least = std::min({m.eta.x, m.eta.y, m.eta.z});
  if (m.maps.eta >= 0)
    for (const glm::vec3& texel : scene.textures[static_cast<std::size_t>(m.maps.eta)].texels)
      least = std::min(least, static_cast<double>(texel.y));
  return m.outsideEta > least;
}

}  // namespace malus::bake
